// Materials with the layers of glTF's extensions, as the importer hands them on.
#pragma once

#include "core/scene/scene.h"

namespace restlab::unit {

struct Layers {
  float coat = 0.0f, coatRoughness = 0.0f;
  glm::vec3 sheen{0.0f};
  float sheenRoughness = 0.5f;
  float anisotropy = 0.0f, rotation = 0.0f;
  float film = 0.0f, thickness = 400.0f, filmIor = 1.3f;
  float passing = 0.0f;
  glm::vec3 passingColor{1.0f};
  float dispersion = 0.0f;
};

SceneMaterial layered(const rl::Material& base, const Layers& layers);

}  // namespace restlab::unit
