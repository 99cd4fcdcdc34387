// Parameters of `local`, and what its presets make of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/frame/part.h"
#include "integrators/local/local.h"

namespace restlab {

struct LocalSettings {
  std::string preset = "none";
  uint32_t model = rl::RL_LOCAL_CLOSURE;
  uint32_t shading = rl::RL_LOCAL_PER_PIXEL;
  uint32_t divisions = 0;
  bool directLight = true;
  uint32_t shadows = rl::RL_LOCAL_SHADOW_RAYS;
  uint32_t occlusion = 0;
  uint32_t reflections = 0;
  uint32_t combine = rl::RL_LOCAL_MODULATE;
  uint32_t lightSamples = 1;
  uint32_t occlusionRays = 1;
  double occlusionRadius = 0.0;
  double ambient = 0.0;
  double ambientShare = 0.0;
  double highlight = 0.4;
  double highlightPower = 20.0;
  uint32_t mapSquares = 24;
  uint32_t mapSize = 512;
  double mapBias = 1.0;
  uint32_t mapFilter = 1;
  bool hasOwnRadius = false;  // the radius of occlusion follows the scene where it is 0

  bool hasLamps() const { return directLight || ambientShare > 0.0; }
};

std::vector<ParameterInfo> localParameters();
// Resolved parameters, with what the preset sets.
LocalSettings localSettings(const ParameterMap& parameters);
// PartInfo::reasonUnused.
std::string whyLocalUnused(const std::string& name, const ParameterMap& parameters);

}  // namespace restlab
