#include "core/scene/scene_file/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "core/base/error.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab {

namespace {

const ShapeInfo& readKind(const ConfigTable& table) {
  std::vector<std::string> names;
  for (const ShapeInfo& info : shapeRegistry()) names.push_back(info.name);
  if (!table.has("kind"))
    table.fail("", fmt::format("[[shape]] has no 'kind': one of {}", fmt::join(names, ", ")));
  return *findShape(table.getChoice("kind", names[0], names));
}

// Scales, then turns about an axis, then moves.
glm::dmat4 readTransform(const ConfigTable& table) {
  constexpr double kMost = 1e9, kLeastScale = 1e-9;
  const bool isUniform = !table.has("scale") || table.getTexts("scale").size() == 1;
  const std::vector<double> scale = table.getNumbers(
      "scale", {1.0, 1.0, 1.0}, isUniform && table.has("scale") ? 1 : 3, -kMost, kMost);
  const glm::dvec3 factors =
      scale.size() == 1 ? glm::dvec3(scale[0]) : glm::dvec3(scale[0], scale[1], scale[2]);
  const glm::dvec3 size = glm::abs(factors);
  if (std::min({size.x, size.y, size.z}) < kLeastScale)
    table.fail("scale", fmt::format("'scale' is below {:g} along an axis", kLeastScale));
  const std::vector<double> turn =
      table.getNumbers("rotate", {0.0, 0.0, 1.0, 0.0}, 4, -kMost, kMost);
  const glm::dvec3 axis(turn[0], turn[1], turn[2]);
  if (!(glm::length(axis) > 0.0))
    table.fail("rotate", "'rotate' is an axis and degrees, [x, y, z, degrees]: the axis is 0");
  const std::vector<double> place =
      table.getNumbers("translate", {0.0, 0.0, 0.0}, 3, -kMost, kMost);
  const glm::dmat4 one(1.0);
  return glm::translate(one, glm::dvec3(place[0], place[1], place[2])) *
         glm::rotate(one, glm::radians(turn[3]), glm::normalize(axis)) * glm::scale(one, factors);
}

SceneMaterial readMaterial(const ConfigTable& table, const std::vector<Scattering>& materials,
                           const Scene& scene, const std::string& name) {
  SceneMaterial material{name, builtin::lambert(glm::vec3(0.5f))};
  material.data.flags = 0;
  if (!table.has("material")) return material;
  const std::string wanted = table.getString("material", "");
  std::vector<std::string> names;
  for (const Scattering& s : materials) {
    names.push_back(s.name);
    if (s.name != wanted) continue;
    scatterAs(s, material);
    return material;
  }
  for (const SceneMaterial& there : scene.materials) {
    names.push_back(there.name);
    if (there.name == wanted && !there.isPart) return there;
  }
  table.fail("material", fmt::format("no [[material]] and no material of the scene is named '{}'{}",
                                     wanted, didYouMean(wanted, names)));
}

}  // namespace

void addShape(const ConfigTable& table, const std::vector<Scattering>& materials, Scene& scene) {
  const ShapeInfo& info = readKind(table);
  const std::string name =
      table.getString("name", fmt::format("{} {}", info.name, scene.instances.size()));
  ShapeGeometry shape{&info, {}};
  for (const ShapeParameter& p : info.parameters)
    shape.values.push_back(p.isWhole ? float(table.getInteger(p.name, int64_t(p.fallback),
                                                              int64_t(p.lo), int64_t(p.hi)))
                                     : float(table.getNumber(p.name, p.fallback, p.lo, p.hi)));
  const glm::dmat4 toWorld = readTransform(table);
  std::optional<MeshGeometry> mesh;
  if (info.readMesh) mesh = info.readMesh(table, {toWorld, scene.cameras});
  if (info.read && !mesh) info.read(table, shape);
  SceneMaterial material = readMaterial(table, materials, scene, name);
  constexpr double kBrightest = 1e12;
  if (table.has("emission")) {
    const bool isGrey = table.getTexts("emission").size() == 1;
    const std::vector<double> e =
        table.getNumbers("emission", {0.0}, isGrey ? 1 : 3, 0.0, kBrightest);
    material.data.emission = isGrey ? glm::vec3(float(e[0])) : glm::vec3(e[0], e[1], e[2]);
  }
  if (table.getBool("double_sided", (material.data.flags & rl::RL_MATERIAL_DOUBLE_SIDED) != 0)) {
    material.data.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
  } else {
    material.data.flags &= ~rl::RL_MATERIAL_DOUBLE_SIDED;
  }
  table.finish();
  MeshInstance instance;
  instance.name = name;
  instance.geometry = static_cast<uint32_t>(scene.geometries.size());
  instance.material = static_cast<uint32_t>(scene.materials.size());
  instance.objectToWorld = toWorld;
  if (mesh) mesh->name = name;
  scene.geometries.push_back(mesh ? std::move(*mesh) : makeShape(std::move(shape), name));
  scene.materials.push_back(std::move(material));
  scene.instances.push_back(std::move(instance));
}

}  // namespace restlab
