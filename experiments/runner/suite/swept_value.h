// A value of a swept key, which names a point or a method of a suite.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace restlab {

struct SweptValue {
  std::string key;   // without "method.NAME."
  std::string text;  // TOML, without the quotes of strings
};

// Returns the value if it is a finite number.
std::optional<double> numberOf(const SweptValue& value);

// Returns the unit of a setting or parameter; "" if it has none, or is a count of what it names.
std::string unitOfKey(const std::string& key);
// Lists the keys that have one.
std::vector<std::string> keysWithUnits();

}  // namespace restlab
