#include "core/frame/feature_names.h"

#include <array>

#include "core/dialect/features.h"
#include "core/scene/closure_info.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab {

namespace {

// Kinds of closures and shapes follow.
const std::array<const char*, 23> kFeatureNames = {"area_lights",
                                                   "punctual_lights",
                                                   "environment",
                                                   "glossy",
                                                   "transmission",
                                                   "volume",
                                                   "textures",
                                                   "normal_maps",
                                                   "emissive_textures",
                                                   "vertex_colors",
                                                   "alpha",
                                                   "instances",
                                                   "smooth_normals",
                                                   "multiscatter",
                                                   "ambient",
                                                   "scattering",
                                                   "light_tree",
                                                   "clearcoat",
                                                   "sheen",
                                                   "anisotropy",
                                                   "iridescence",
                                                   "diffuse_transmission",
                                                   "dispersion"};

static_assert(((rl::FeatureMask{1} << kFeatureNames.size()) - 1u) ==
              (rl::RL_FEATURE_ALL & ~(rl::RL_FEATURE_CLOSURES | rl::RL_FEATURE_SHAPES)));

}  // namespace

std::string featureNames(rl::FeatureMask mask) {
  std::string text;
  const auto add = [&](rl::FeatureMask bit, const std::string& name) {
    if ((mask & bit) == 0) return;
    if (!text.empty()) text += '+';
    text += name;
  };
  for (size_t i = 0; i < kFeatureNames.size(); ++i) add(rl::FeatureMask{1} << i, kFeatureNames[i]);
  for (const ClosureInfo& closure : closureRegistry()) add(closure.feature, closure.name);
  for (const ShapeInfo& shape : shapeRegistry()) add(shape.feature, shape.name);
  return text.empty() ? "none" : text;
}

}  // namespace restlab
