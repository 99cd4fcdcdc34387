// References of scripts.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

#include "experiments/runner/reference/reference.h"

namespace restlab::python {

// A reference as a script wants it, besides the picture.
struct ReferenceWish {
  std::optional<uint64_t> spp;
  std::optional<double> targetRelmse, timeLimitS;
  std::string integrator = "path";
  std::string file;  // "": none is written
  bool isAnew = false;
};

// Renders the reference from the progress in the user's cache, as `restlab reference` does, and
// writes the file. Releases the interpreter's lock. Throws Error; KeyboardInterrupt where it was
// interrupted, and the progress is kept.
std::shared_ptr<const Reference> obtain(const PreparedScene& prepared, ReferenceConfig config,
                                        const ReferenceWish& wish);

// Returns a Reference of Python, or makes one of an array. `name` begins errors.
std::shared_ptr<const Reference> referenceOf(const pybind11::handle& object,
                                             const std::string& name);

}  // namespace restlab::python
