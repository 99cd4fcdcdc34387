// A material by its kind and settings, as `restlab bsdf` is given one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/backend/bsdf_probe.h"
#include "core/scene/scene_file/scene_file.h"

namespace restlab {

struct TestedMaterial {
  Scattering scattering;
  SceneMaterial material;
  Scene inputs;  // images, tables and other materials that it names
};

// settings: KEY=VALUE each; files are relative to the working directory. A mixture may name every
// kind, with its defaults; without settings it is half `conductor`, half `diffuse`. A table without
// a file is that of `conductor`. Throws Error (badUsage, badInput).
TestedMaterial testedMaterial(const std::string& kind, const std::vector<std::string>& settings);

// A table of the material's BRDF. Throws Error (badUsage) for one that no table of reflection
// holds: with mirrors, transmission or a tangent.
ClosureTable tabulated(const TestedMaterial& tested, TableAngles angles, const glm::uvec3& sizes);

}  // namespace restlab
