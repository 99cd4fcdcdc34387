#include "experiments/runner/suite/swept_value.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace restlab {

std::optional<double> numberOf(const SweptValue& value) {
  std::string digits = value.text;
  digits.erase(std::remove(digits.begin(), digits.end(), '_'), digits.end());  // TOML: 1_000
  if (digits.empty()) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(digits.c_str(), &end);
  if (*end != '\0' || !std::isfinite(number)) return std::nullopt;
  return number;
}

namespace {

const std::map<std::string, std::string>& keyUnits() {
  static const std::map<std::string, std::string> units = {{"accumulate_cap", "frames"},
                                                           {"connect_footprint", "%"},
                                                           {"confidence_cap", "frames"},
                                                           {"element_size", "metres"},
                                                           {"entry_cap", "samples"},
                                                           {"firefly_radius", "pixels"},
                                                           {"height", "pixels"},
                                                           {"memory_mib", "MiB"},
                                                           {"moving_confidence_cap", "frames"},
                                                           {"occlusion_radius", "metres"},
                                                           {"radiance_cap", "samples"},
                                                           {"radiance_pixels", "pixels"},
                                                           {"shadow_map_filter", "texels"},
                                                           {"shadow_map_size", "texels"},
                                                           {"spatial_radius", "pixels"},
                                                           {"surflet_pixels", "pixels"},
                                                           {"svgf_cap", "frames"},
                                                           {"voxel_pixels", "pixels"},
                                                           {"warmup_frames", "frames"},
                                                           {"width", "pixels"},
                                                           {"young_frames", "frames"}};
  return units;
}

}  // namespace

std::string unitOfKey(const std::string& key) {
  const auto found = keyUnits().find(key);
  return found == keyUnits().end() ? "" : found->second;
}

std::vector<std::string> keysWithUnits() {
  std::vector<std::string> keys;
  for (const auto& [key, unit] : keyUnits()) keys.push_back(key);
  return keys;
}

}  // namespace restlab
