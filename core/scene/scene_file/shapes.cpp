#include "core/scene/scene_file/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/scene_file/meshes.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab {

namespace {

const ShapeInfo& readKind(const ConfigTable& table) {
  std::vector<std::string> names;
  for (const ShapeInfo& info : shapeRegistry()) names.push_back(info.name);
  if (!table.has("kind"))
    table.fail("", fmt::format("[[shape]] has no 'kind' and no 'file' of a mesh; kinds: {}",
                               fmt::join(names, ", ")));
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

// Reads what a surface sends out, and from which sides.
void readEmission(const ConfigTable& table, SceneMaterial& material) {
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
}

// Where the shape and its instances stand.
ShapePlace placesOf(const ConfigTable& table, const std::vector<SceneCamera>& cameras) {
  const glm::dmat4 own = readTransform(table);
  ShapePlace place{{}, cameras};
  for (const ConfigTable& one : table.getTables("instances"))
    place.toWorld.push_back(readTransform(one) * own);
  if (place.toWorld.empty()) place.toWorld.push_back(own);
  return place;
}

MeshGeometry readShape(const ConfigTable& table, const std::filesystem::path& folder,
                       Scene& scene) {
  const ShapeInfo& info = readKind(table);
  if (table.has("file") && !info.readsFile)
    table.fail("kind", "'kind' beside 'file': a shape or a mesh, one of them");
  ShapeGeometry shape{&info, {}};
  for (const ShapeParameter& p : info.parameters)
    shape.values.push_back(p.isWhole ? float(table.getInteger(p.name, int64_t(p.fallback),
                                                              int64_t(p.lo), int64_t(p.hi)))
                                     : float(table.getNumber(p.name, p.fallback, p.lo, p.hi)));
  if (info.readMesh) {
    if (std::optional<MeshGeometry> mesh = info.readMesh(table, placesOf(table, scene.cameras))) {
      mesh->name = info.name;
      return std::move(*mesh);
    }
  }
  const auto files = [&](const std::string& name, const std::string& place, uint64_t mostBytes) {
    return readNamedFile(name, place, mostBytes, folder, scene);
  };
  if (info.read) info.read(table, files, shape);
  return makeShape(std::move(shape), info.name);
}

MeshGeometry readGeometry(const ConfigTable& table, const std::filesystem::path& folder,
                          Scene& scene) {
  if (table.has("kind") || !table.has("file")) return readShape(table, folder, scene);
  MeshGeometry mesh = readMeshFile(table, folder, scene);
  readNormals(table, mesh);
  mesh.name = std::filesystem::path(table.getString("file", "")).stem().string();
  return mesh;
}

}  // namespace

void addShape(const ConfigTable& table, const std::filesystem::path& folder,
              const std::vector<Scattering>& materials, Scene& scene) {
  MeshGeometry geometry = readGeometry(table, folder, scene);
  const std::string name =
      table.getString("name", fmt::format("{} {}", geometry.name, scene.instances.size()));
  geometry.name = name;
  MeshInstance instance;
  instance.name = name;
  instance.geometry = static_cast<uint32_t>(scene.geometries.size());
  instance.objectToWorld = readTransform(table);
  SceneMaterial material = readMaterial(table, materials, scene, name);
  readEmission(table, material);
  instance.material = static_cast<uint32_t>(scene.materials.size());
  const std::vector<ConfigTable> places = table.getTables("instances");
  table.finish();
  scene.geometries.push_back(std::move(geometry));
  scene.materials.push_back(material);
  if (places.empty()) scene.instances.push_back(instance);
  for (size_t i = 0; i < places.size(); ++i) {
    const ConfigTable& place = places[i];
    MeshInstance one = instance;
    one.name = place.getString("name", fmt::format("{} {}", name, i));
    one.objectToWorld = readTransform(place) * instance.objectToWorld;
    if (place.has("material") || place.has("emission") || place.has("double_sided")) {
      SceneMaterial own =
          place.has("material") ? readMaterial(place, materials, scene, one.name) : material;
      readEmission(place, own);
      one.material = static_cast<uint32_t>(scene.materials.size());
      scene.materials.push_back(std::move(own));
    }
    place.finish();
    scene.instances.push_back(std::move(one));
  }
}

}  // namespace restlab
