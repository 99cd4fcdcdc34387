// Meshes, and nodes that carry them, cameras and lights.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/scene/curves/stand_in.h"
#include "core/scene/field/stand_in.h"
#include "core/scene/gltf_write/document.h"
#include "core/scene/mitsuba/mesh_files.h"
#include "core/scene/shapes/fine_meshes.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab::gltf_write {
namespace {

using nlohmann::json;

constexpr int kFloat = 5126, kUint = 5125;

json matrixOf(const glm::dmat4& m) {
  json numbers = json::array();
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) numbers.push_back(m[column][row]);
  return numbers;
}

// An accessor of packed vectors of floats or whole numbers.
template <class V>
size_t accessorOf(const std::vector<V>& values, const char* type, int component, Output& output) {
  const size_t offset = output.bytes.size(), bytes = values.size() * sizeof(V);
  output.bytes.append(reinterpret_cast<const char*>(values.data()), bytes);
  const size_t view =
      output.add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
  const size_t perValue = component == kUint ? sizeof(V) / sizeof(uint32_t) : 1;
  return output.add("accessors", {{"bufferView", view},
                                  {"componentType", component},
                                  {"count", values.size() * perValue},
                                  {"type", type}});
}

json attributesOf(const MeshGeometry& mesh, Output& output) {
  json attributes;
  const size_t positions = accessorOf(mesh.positions, "VEC3", kFloat, output);
  glm::vec3 low(mesh.positions.at(0)), high(low);
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  output.json["accessors"][positions]["min"] = {low.x, low.y, low.z};
  output.json["accessors"][positions]["max"] = {high.x, high.y, high.z};
  attributes["POSITION"] = positions;
  if (!mesh.normals.empty())
    attributes["NORMAL"] = accessorOf(mesh.normals, "VEC3", kFloat, output);
  if (!mesh.tangents.empty())
    attributes["TANGENT"] = accessorOf(mesh.tangents, "VEC4", kFloat, output);
  if (!mesh.colors.empty()) attributes["COLOR_0"] = accessorOf(mesh.colors, "VEC4", kFloat, output);
  for (size_t i = 0; i < mesh.uvs.size(); ++i)
    if (!mesh.uvs[i].empty())
      attributes[fmt::format("TEXCOORD_{}", i)] = accessorOf(mesh.uvs[i], "VEC2", kFloat, output);
  return attributes;
}

// Shapes of a kind that were written.
struct Written {
  size_t shapes = 0, triangles = 0;
};

// Kinds whose triangles are the surface itself.
bool isMadeOfTriangles(const std::string& kind) {
  return kind == "rectangle" || kind == "cube" || kind == "plane";
}

MeshGeometry meshOf(const ShapeGeometry& shape) {
  MeshGeometry mesh = fineMesh(shape);
  const std::string& kind = shape.info->name;
  if (kind == "curves") mesh = tubesOf(shape.words, true);
  if (kind == "implicit" || kind == "sdf") addFieldNormals(fieldProgram(shape.words), mesh);
  mitsuba::addTangents(mesh);  // a shape's bitangent is at the left of u
  return mesh;
}

void addInstances(const Scene& scene, Output& output) {
  std::vector<json> primitives(scene.geometries.size());
  std::map<std::pair<uint32_t, uint32_t>, size_t> meshes;
  std::map<std::string, Written> written;  // by kind
  for (const MeshInstance& instance : scene.instances) {
    const MeshGeometry& geometry = scene.geometries.at(instance.geometry);
    json& primitive = primitives.at(instance.geometry);
    if (primitive.is_null() && geometry.shape != nullptr) {
      const MeshGeometry fine = meshOf(*geometry.shape);
      Written& ofKind = written[geometry.shape->info->name];
      ++ofKind.shapes;
      ofKind.triangles += fine.triangles.size();
      primitive = {{"attributes", attributesOf(fine, output)},
                   {"indices", accessorOf(fine.triangles, "SCALAR", kUint, output)}};
    } else if (primitive.is_null()) {
      primitive = {{"attributes", attributesOf(geometry, output)},
                   {"indices", accessorOf(geometry.triangles, "SCALAR", kUint, output)}};
    }
    const auto [mesh, isNew] = meshes.try_emplace({instance.geometry, instance.material});
    if (isNew) {
      json own = primitive;
      own["material"] = instance.material;
      mesh->second = output.add("meshes", {{"name", geometry.name}, {"primitives", {own}}});
    }
    json node = {{"name", instance.name}, {"mesh", mesh->second}};
    if (instance.objectToWorld != glm::dmat4(1.0))
      node["matrix"] = matrixOf(instance.objectToWorld);
    output.add("nodes", node);
  }
  for (const auto& [kind, count] : written)
    if (!isMadeOfTriangles(kind))
      output.notes.push_back(
          fmt::format("{}: shapes of kind '{}', which glTF does not have, are written as triangles "
                      "({} for {} of "
                      "them)",
                      output.file.string(), kind, count.triangles, count.shapes));
}

// The axes of a camera without scale. A mirrored one stands below a node that mirrors.
void addCamera(const SceneCamera& camera, json& roots, Output& output) {
  json own = {{"name", camera.name}};
  if (camera.kind == rl::RL_CAMERA_PERSPECTIVE) {
    const double least = camera.znear > 0.0 ? camera.znear : 1e-6;
    own["type"] = "perspective";
    own["perspective"] = {{"yfov", camera.yfov}, {"znear", least}};
    if (camera.aspect > 0.0) own["perspective"]["aspectRatio"] = camera.aspect;
  } else {
    own["type"] = "orthographic";
    own["orthographic"] = {
        {"xmag", camera.xmag}, {"ymag", camera.ymag}, {"znear", 0.0}, {"zfar", 1e6}};
  }
  if (camera.film.x > 0 && camera.film.y > 0)
    own["extras"]["restlab"]["film"] = {camera.film.x, camera.film.y};
  if (camera.shift != glm::dvec2(0.0))
    output.notes.push_back(
        fmt::format("{}: the shift of camera '{}' is left out: glTF's films are "
                    "centred",
                    output.file.string(), camera.name));
  glm::dmat4 matrix = camera.cameraToWorld;
  for (int axis = 0; axis < 3; ++axis) matrix[axis] = glm::normalize(matrix[axis]);
  json node = {{"name", camera.name}, {"camera", output.add("cameras", own)}};
  if (!camera.isMirrored) {
    node["matrix"] = matrixOf(matrix);
    roots.push_back(output.add("nodes", node));
    return;
  }
  matrix[0] = -matrix[0];
  glm::dmat4 mirror(1.0);
  mirror[0].x = -1.0;
  node["matrix"] = matrixOf(mirror * matrix);
  const size_t child = output.add("nodes", node);
  roots.push_back(output.add("nodes", {{"scale", {-1.0, 1.0, 1.0}}, {"children", {child}}}));
}

void addLight(const PunctualLight& light, json& lights, Output& output) {
  const double most = std::max({light.intensity.x, light.intensity.y, light.intensity.z, 1e-30f});
  json own = {
      {"name", light.name},
      {"type", light.kind == rl::RL_LIGHT_POINT  ? "point"
               : light.kind == rl::RL_LIGHT_SPOT ? "spot"
                                                 : "directional"},
      {"intensity", most},
      {"color", {light.intensity.x / most, light.intensity.y / most, light.intensity.z / most}}};
  if (light.kind == rl::RL_LIGHT_SPOT)
    own["spot"] = {{"innerConeAngle", light.innerConeAngle},
                   {"outerConeAngle", light.outerConeAngle}};
  if (light.attenuation != glm::vec3(0.0f, 0.0f, 1.0f))
    output.notes.push_back(fmt::format("{}: the attenuation of light '{}' is left out",
                                       output.file.string(), light.name));
  lights.push_back(own);
  const glm::dvec3 z = -light.dirW;
  const glm::dvec3 helper = std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(helper, z));
  const glm::dmat4 matrix(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0),
                          glm::dvec4(light.posW, 1.0));
  output.add("nodes", {{"name", light.name},
                       {"matrix", matrixOf(matrix)},
                       {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}});
}

}  // namespace

void addNodes(const Scene& scene, Output& output) {
  json lights = json::array(), roots = json::array(), cameras = json::array();
  addInstances(scene, output);
  for (const PunctualLight& light : scene.lights) addLight(light, lights, output);
  const size_t plain = output.json.contains("nodes") ? output.json["nodes"].size() : 0;
  for (size_t i = 0; i < plain; ++i) roots.push_back(i);
  for (const SceneCamera& camera : scene.cameras) addCamera(camera, roots, output);
  if (!lights.empty()) {
    output.json["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    output.extensions.insert("KHR_lights_punctual");
  }
  output.json["scenes"] = {{{"nodes", roots}}};
  if (scene.maxBounces)
    output.json["scenes"][0]["extras"]["restlab"]["max_bounces"] = *scene.maxBounces;
  output.json["scene"] = 0;
}

}  // namespace restlab::gltf_write
