// Values of Python and of the library, converted both ways.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/frame/part.h"

namespace restlab::python {

// Returns dicts, lists, numbers and texts; null becomes None.
pybind11::object objectOf(const nlohmann::ordered_json& json);
pybind11::object objectOf(const ParameterValue& value);

// Returns a flag, number or text, also of numpy's scalars and of whatever has __index__ or
// __float__. `name` begins the error: Error (badUsage) for any other type, and for whole numbers of
// more than 64 bits.
ParameterValue valueOf(const pybind11::handle& object, const std::string& name);

// Returns a name, or an index as its digits. Throws Error (badUsage) naming `name`.
std::string nameOrIndexOf(const pybind11::handle& object, const std::string& name);

// Returns the text, or the path of an os.PathLike. Throws Error (badUsage) naming `name`.
std::string textOf(const pybind11::handle& object, const std::string& name);

// Returns a text that Python can hold, whatever bytes a file name has.
pybind11::str strOf(const std::string& text);
pybind11::list listOf(const std::vector<std::string>& texts);
pybind11::dict dictOf(const std::map<std::string, std::string>& words);

}  // namespace restlab::python
