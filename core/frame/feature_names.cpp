#include "core/frame/feature_names.h"

#include <array>

#include "core/dialect/features.h"
#include "core/scene/closure_info.h"

namespace restlab {

namespace {

// Kinds of closures follow.
const std::array<const char*, 17> kFeatureNames = {
    "area_lights",       "punctual_lights", "environment", "glossy",
    "transmission",      "volume",          "textures",    "normal_maps",
    "emissive_textures", "vertex_colors",   "alpha",       "instances",
    "smooth_normals",    "multiscatter",    "ambient",     "scattering",
    "light_tree"};

static_assert(((1u << kFeatureNames.size()) - 1u) ==
              (rl::RL_FEATURE_ALL & ~rl::RL_FEATURE_CLOSURES));

}  // namespace

std::string featureNames(uint32_t mask) {
  std::string text;
  for (uint32_t i = 0; i < rl::RL_FEATURE_BITS; ++i) {
    if ((mask & (1u << i)) == 0) continue;
    if (!text.empty()) text += '+';
    text += i < kFeatureNames.size() ? kFeatureNames[i]
                                     : closureRegistry()[i - kFeatureNames.size()].name;
  }
  return text.empty() ? "none" : text;
}

}  // namespace restlab
