#include "core/scene/mitsuba/optical_constants.h"

#include <algorithm>

#include "core/scene/closure_info.h"

namespace restlab::mitsuba {
namespace {

struct NamedIndex {
  const char* name;
  double index;
};

// At 589 nm, gases and liquids at room temperature.
constexpr NamedIndex kIndices[] = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.333},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.47},      {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.575},       {"diamond", 2.419}};

}  // namespace

double indexOfRefraction(const std::string& name) {
  for (const NamedIndex& known : kIndices)
    if (name == known.name) return known.index;
  return 0.0;
}

std::vector<std::string> indexNames() {
  std::vector<std::string> names;
  for (const NamedIndex& known : kIndices) names.emplace_back(known.name);
  return names;
}

std::vector<std::string> metalNames() {
  std::vector<std::string> names = findClosure("conductor")->parameters.at(0).choices;
  names.erase(std::remove(names.begin(), names.end(), "none"), names.end());
  return names;
}

std::string metalOf(const std::string& name) {
  const std::string element = name.substr(0, name.find('_'));
  for (const std::string& known : metalNames())
    if (known == element) return known;
  return "";
}

}  // namespace restlab::mitsuba
