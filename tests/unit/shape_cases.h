// Every kind of shape beside triangles, with its examples, and helpers of their tests. Nothing here
// names a kind: a kind of the registry is under test at once.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/scene/builtin/builder.h"
#include "core/scene/shapes/shape_info.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {

struct ShapeCase {
  std::string name;
  const ShapeInfo* info;
  ShapeGeometry shape;
  bool isClosed;

  std::array<glm::vec3, 2> box() const { return info->box(shape); }
  float size() const {
    const std::array<glm::vec3, 2> b = box();
    return std::max({b[1].x - b[0].x, b[1].y - b[0].y, b[1].z - b[0].z});
  }
  glm::vec3 inBox(Inputs& inputs) const {
    const std::array<glm::vec3, 2> b = box();
    const float x = inputs.uniform(), y = inputs.uniform();
    return glm::mix(b[0], b[1], glm::vec3(x, y, inputs.uniform()));
  }
  // A point that is well inside of a closed shape; of others one near the middle.
  glm::vec3 anyInside() const {
    const std::array<glm::vec3, 2> b = box();
    if (!isClosed) return glm::mix(b[0], b[1], glm::vec3(0.55f, 0.6f, 0.5f));
    Inputs inputs(99);
    for (float margin = 0.1f; margin > 1e-4f; margin *= 0.5f) {
      for (int i = 0; i < 500; ++i) {
        const glm::vec3 p = inBox(inputs);
        bool isDeep = true;
        for (int k = 0; k < 20; ++k)
          isDeep =
              isDeep && info->isInside(shape, glm::dvec3(p + margin * size() * inputs.direction()));
        if (isDeep) return p;
      }
    }
    throw std::logic_error(name + ": no point is inside");
  }
};

inline std::vector<ShapeCase> shapeCases() {
  std::vector<ShapeCase> cases;
  for (const NamedShape& named : namedShapes())
    cases.push_back(
        {named.name, named.shape.info, named.shape, named.shape.info->isClosed(named.shape)});
  return cases;
}

inline const ShapeCase& shapeNamed(const std::string& name) {
  static const std::vector<ShapeCase> all = shapeCases();
  for (const ShapeCase& one : all)
    if (one.name == name) return one;
  throw std::logic_error(name);
}

// A context with the parameters of one shape, in its own space.
struct LocalShape {
  explicit LocalShape(const ShapeCase& of) : LocalShape(of.shape) {}
  explicit LocalShape(const ShapeGeometry& of) : words(shapeWords(of)) {
    shape.kind = of.info->kind;
    shape.firstWord = 0;
    d.scene.shapeWords.data = words.data();
  }
  std::vector<glm::uvec4> words;
  rl::Shape shape{};
  Dialect<> d;
};

inline rl::SurfaceId idOf(const rl::Hit& hit) { return {0, hit.primitive, hit.bary}; }

inline rl::Ray rayOf(const glm::vec3& origin, const glm::vec3& dir) {
  return {origin, 0.0f, dir, 3e38f};
}

// Returns whether an id names a point: a ray against the normal there finds the part and the place.
inline bool isPoint(LocalShape& local, const rl::SurfaceId& id, const rl::ShapePoint& p) {
  rl::Hit hit{};
  rl::Ray ray = rayOf(p.posL + 1e-3f * p.normalL, -p.normalL);
  ray.tMax = 2e-3f;
  if (!local.d->shapeIntersect(local.shape, ray, hit) || hit.primitive != id.primitive)
    return false;
  const glm::vec3 found = local.d->shapePoint(local.shape, idOf(hit)).posL;
  return glm::distance(found, p.posL) < 1e-3f * std::max(1.0f, glm::length(p.posL));
}

// Calls visit(part, x, y, point, area) for each of n x n cells of the coordinates of each part
// whose middle is a point; areas are those of the shape's own space. Kinds with draws have at most
// 8 parts.
template <class Visit>
void forEachCell(LocalShape& local, int n, const Visit& visit) {
  for (uint32_t part = 0; part < 8; ++part) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const auto at = [&](double dx, double dy) -> rl::SurfaceId {
          return {0, part, {float((x + dx) / n), float((y + dy) / n)}};
        };
        const auto posOf = [&](double dx, double dy) {
          return glm::dvec3(local.d->shapePoint(local.shape, at(dx, dy)).posL);
        };
        const rl::ShapePoint middle = local.d->shapePoint(local.shape, at(0.5, 0.5));
        if (!isPoint(local, at(0.5, 0.5), middle)) continue;
        const glm::dvec3 du = posOf(0.9, 0.5) - posOf(0.1, 0.5);
        const glm::dvec3 dv = posOf(0.5, 0.9) - posOf(0.5, 0.1);
        visit(part, x, y, middle, glm::length(glm::cross(du, dv)) / 0.64);
      }
    }
  }
}

// A shape in a scene of its own.
inline std::shared_ptr<const CompiledScene> placedShape(const ShapeCase& of,
                                                        const glm::dmat4& toWorld,
                                                        float emission = 0.0f) {
  builtin::SceneBuilder builder("shape");
  rl::Material material = builtin::lambert(glm::vec3(0.5f));
  material.emission = glm::vec3(emission);
  const uint32_t id = builder.addMaterial("grey", material);
  builder.place("it", builder.addGeometry(makeShape(of.shape, "it")), id, toWorld);
  return CompiledScene::build(builder.finish());
}

}  // namespace restlab::unit
