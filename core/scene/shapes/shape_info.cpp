#include "core/scene/shapes/shape_info.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace restlab {

// Each is defined in the file of its kind.
#define RL_SHAPE(name, kind, feature, make) ShapeInfo make();
#include "shapes/registry.inl"
#undef RL_SHAPE

namespace {

std::vector<ShapeInfo> declaredShapes() {
  std::vector<ShapeInfo> all;
  const auto add = [&](const char* name, uint32_t kind, rl::FeatureMask feature, ShapeInfo info) {
    info.name = name;
    info.kind = kind;
    info.feature = feature;
    all.push_back(std::move(info));
  };
#define RL_SHAPE(name, kind, feature, make) add(#name, rl::kind, rl::feature, make());
#include "shapes/registry.inl"
#undef RL_SHAPE
  return all;
}

}  // namespace

const std::vector<ShapeInfo>& shapeRegistry() {
  static const std::vector<ShapeInfo> kAll = declaredShapes();
  return kAll;
}

const ShapeInfo* findShape(const std::string& name) {
  const std::vector<ShapeInfo>& all = shapeRegistry();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const ShapeInfo& info) { return info.name == name; });
  return found == all.end() ? nullptr : &*found;
}

const std::vector<NamedShape>& namedShapes() {
  static const std::vector<NamedShape> kAll = [] {
    std::vector<NamedShape> all;
    for (const ShapeInfo& info : shapeRegistry()) {
      std::vector<float> values;
      for (const ShapeParameter& p : info.parameters) values.push_back(float(p.fallback));
      if (!info.read) all.push_back({info.name, {&info, values}});
      for (const ShapeExample& example : info.examples)
        all.push_back({example.name, {&info, example.values, example.words}});
    }
    return all;
  }();
  return kAll;
}

MeshGeometry makeShape(ShapeGeometry shape, const std::string& name) {
  MeshGeometry mesh = shape.info->standIn(shape);
  mesh.name = name;
  mesh.shape = std::make_shared<const ShapeGeometry>(std::move(shape));
  return mesh;
}

std::vector<glm::uvec4> shapeWords(const ShapeGeometry& shape) {
  const size_t first = (shape.values.size() + 3) / 4;
  std::vector<glm::uvec4> words(first + (shape.words.size() + 3) / 4, glm::uvec4(0u));
  for (size_t i = 0; i < shape.values.size(); ++i)
    words[i / 4][int(i % 4)] = std::bit_cast<uint32_t>(shape.values[i]);
  for (size_t i = 0; i < shape.words.size(); ++i) words[first + i / 4][int(i % 4)] = shape.words[i];
  return words;
}

MeshGeometry turnedGrid(uint32_t columns, uint32_t rows,
                        const std::function<glm::vec3(float u, float v)>& at) {
  MeshGeometry mesh;
  for (uint32_t y = 0; y <= rows; ++y) {
    for (uint32_t x = 0; x < columns; ++x)
      mesh.positions.push_back(at(float(x) / float(columns), float(y) / float(rows)));
  }
  const auto corner = [&](uint32_t x, uint32_t y) { return y * columns + x % columns; };
  // A pole is many vertices in one place.
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    const glm::vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
    if (p != q && q != r && r != p) mesh.triangles.emplace_back(a, b, c);
  };
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < columns; ++x) {
      add(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1));
      add(corner(x, y), corner(x + 1, y + 1), corner(x, y + 1));
    }
  }
  return mesh;
}

void addDisk(MeshGeometry& mesh, float z, bool isFromBelow, uint32_t segments) {
  const auto centre = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(0.0f, 0.0f, z);
  for (uint32_t i = 0; i < segments; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / segments;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  for (uint32_t i = 0; i < segments; ++i) {
    const uint32_t a = centre + 1 + i, b = centre + 1 + (i + 1) % segments;
    if (isFromBelow) {
      mesh.triangles.emplace_back(centre, b, a);
    } else {
      mesh.triangles.emplace_back(centre, a, b);
    }
  }
}

}  // namespace restlab
