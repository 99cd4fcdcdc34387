// The light table: every emitter with its selection probability. Lamps, suns and the sky get equal
// shares, if present; within each kind the probability is proportional to power.
#pragma once

#include <string>
#include <vector>

#include "core/dialect/types.h"
#include "core/scene/scene.h"

namespace restlab {

struct LightTable {
  // Includes lights that are off (core/scene/compiled/light_factor.h), with probability 0:
  // reservoirs identify lights by index.
  std::vector<rl::Light> lights;
  std::vector<rl::AliasEntry> alias;  // one per light; empty if none shines
  size_t lamps = 0;                   // triangles, points and spots, also those that are off
  float lampShare = 0.0f;      // probability that `alias` gives one of them; 1: nothing else shines
  uint32_t firstPunctual = 0;  // in `lights`
  std::vector<uint32_t> punctual;      // index in Scene::lights of each from there on
  std::vector<glm::vec3> environment;  // scaled radiance
  std::vector<rl::AliasEntry> environmentAlias;
  uint32_t environmentLight = rl::RL_INVALID;
  size_t emissiveTriangles = 0;  // with positive area and power
  size_t foundByScattering = 0;  // shapes without draws that emit: not in the table
};

// Flattened buffers that emissive triangles are read from.
struct LightTableInput {
  const Scene& scene;
  const std::vector<glm::vec3>& positions;
  const std::vector<glm::vec2>& uvs;
  const std::vector<glm::uvec3>& triangles;
  const std::vector<rl::Geometry>& geometries;
  const glm::dvec3& origin;
};

// Sets firstLight of emitting instances; adds a warning for emitters of zero area.
LightTable buildLightTable(const LightTableInput& in, std::vector<rl::Instance>& instances,
                           std::vector<std::string>& warnings);

}  // namespace restlab
