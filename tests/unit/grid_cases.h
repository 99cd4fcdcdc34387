// Grids of samples for tests, and trees that name them.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include "core/scene/field/grid.h"
#include "core/scene/field/solid.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {

inline SampledGrid sampledGrid(const glm::ivec3& samples, const glm::dvec3& low,
                               const glm::dvec3& high,
                               const std::function<double(const glm::dvec3&)>& at) {
  SampledGrid grid{samples, low, high, {}};
  for (int z = 0; z < samples.z; ++z)
    for (int y = 0; y < samples.y; ++y)
      for (int x = 0; x < samples.x; ++x)
        grid.values.push_back(static_cast<float>(
            at(glm::mix(low, high, glm::dvec3(x, y, z) / glm::dvec3(samples - 1)))));
  return grid;
}

// Distances to a sphere about the origin.
inline SampledGrid sphereGrid(int samples, double reach, double radius) {
  return sampledGrid(glm::ivec3(samples), glm::dvec3(-reach), glm::dvec3(reach),
                     [=](const glm::dvec3& p) { return glm::length(p) - radius; });
}

// Numbers without any relation, above 0 on the faces of the box.
inline SampledGrid noiseGrid(int samples, uint64_t seed) {
  Inputs inputs(seed);
  return sampledGrid(glm::ivec3(samples), glm::dvec3(-1.0), glm::dvec3(1.0),
                     [&](const glm::dvec3& p) {
                       const double v = inputs.uniform(-1.0f, 1.0f);
                       const glm::dvec3 far = glm::abs(p);
                       return std::max({far.x, far.y, far.z}) > 0.99 ? 0.1 + std::abs(v) : v;
                     });
}

// The program of a tree in which the names stand for these grids.
inline FieldProgram solidOfGrids(const std::string& text,
                                 const std::map<std::string, SampledGrid>& grids,
                                 const std::optional<std::array<glm::vec3, 2>>& box = {}) {
  return readSolid(text, box, [&](const std::string& name) { return FieldGrid(grids.at(name)); });
}

}  // namespace restlab::unit
