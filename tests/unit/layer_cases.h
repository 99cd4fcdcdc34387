// Materials with the layers of glTF's extensions, as the shipped surfaceLoad() makes them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/compiled/compiled_scene.h"
#include "core/shading/bsdf.h"
#include "tests/unit/bsdf_cases.h"
#include "tests/unit/layered.h"

namespace restlab::unit {

struct LayerCase {
  std::string name;
  rl::Bsdf bsdf;
  std::shared_ptr<const CompiledScene> scene;  // with the table of the sheen
};

LayerCase layerCase(const std::string& name, const SceneMaterial& material, bool isFront = true);
// Each layer over each kind of base, alone and together; delta lobes only where asked for.
std::vector<LayerCase> continuousLayers();
std::vector<LayerCase> deltaLayers();

}  // namespace restlab::unit
