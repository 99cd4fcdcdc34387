#include "core/scene/mitsuba/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string_view>
#include <utility>

#include "core/base/error.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/mitsuba/curves.h"
#include "core/scene/mitsuba/emitters.h"
#include "core/scene/mitsuba/mesh_files.h"
#include "core/scene/shapes/fine_meshes.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab::mitsuba {
namespace {

constexpr uint64_t kMostMeshBytes = uint64_t(1) << 36;
constexpr size_t kMostInstances = 1u << 24;

// The shape of that name, of those that Mitsuba has; a cylinder is open, as Mitsuba's.
std::optional<ShapeGeometry> analyticShape(const std::string& type) {
  constexpr std::array<std::string_view, 5> kTypes{"rectangle", "disk", "sphere", "cylinder",
                                                   "cube"};
  if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) return {};
  const ShapeInfo* info = findShape(type);
  return ShapeGeometry{info, std::vector<float>(info->parameters.size(), 0.0f)};
}

// Squares are exact as triangles.
bool isCurved(const std::string& type) { return type != "rectangle" && type != "cube"; }

bool isMeshFile(const std::string& type) {
  return type == "obj" || type == "ply" || type == "serialized";
}

void flipRows(MeshGeometry& mesh) {
  for (glm::vec2& uv : mesh.uvs[0]) uv.y = 1.0f - uv.y;
}

// Axes whose Z is along a direction.
glm::dmat4 frameAlong(const glm::dvec3& z) {
  const glm::dvec3 helper = std::abs(z.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(helper, z));
  return glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0),
                    glm::dvec4(0, 0, 0, 1));
}

}  // namespace

// The shape's own transform, with centre and radius, or both ends, where the plugin has them.
glm::dmat4 Shapes::placed(const Element& element, Parameters& p) {
  glm::dmat4 own(1.0);
  if (element.type == "sphere") {
    const glm::dvec3 centre = p.vector("center", glm::dvec3(0.0));
    const double radius = p.number("radius", 1.0, 1e-30, 1e30);
    own = glm::scale(glm::translate(own, centre), glm::dvec3(radius));
  } else if (element.type == "cylinder") {
    const glm::dvec3 p0 = p.vector("p0", glm::dvec3(0.0)), p1 = p.vector("p1", {0.0, 0.0, 1.0});
    const double radius = p.number("radius", 1.0, 1e-30, 1e30), length = glm::length(p1 - p0);
    if (!(length > 0.0)) p.fail("p1", "the ends of the cylinder are at one point");
    own = glm::scale(glm::translate(own, p0) * frameAlong((p1 - p0) / length),
                     glm::dvec3(radius, radius, length));
  }
  return p.transform("to_world") * own;
}

MeshGeometry Shapes::readMesh(const Element& element, const MeshKey& key) {
  const auto& [source, index, hasFaceNormals, isFlipped, flipsRows, hasTangents] = key;
  MeshGeometry mesh;
  if (const auto shape = analyticShape(element.type)) {
    if (isCurved(element.type) && !isFlipped) return makeShape(*shape, element.type);
    mesh = fineMesh(*shape);
  } else {
    if (lastFile_ != source) {
      lastBytes_.clear();
      lastBytes_ = context_.files.read(source, element.place, kMostMeshBytes);
      lastFile_ = source;
    }
    mesh = element.type == "obj"   ? readObj(lastBytes_, source, context_.report)
           : element.type == "ply" ? readPly(lastBytes_, source, context_.report)
                                   : readSerialized(lastBytes_, index, source, context_.report);
    mesh.name = std::filesystem::path(source).filename().string();
    if (flipsRows) flipRows(mesh);
  }
  if (hasFaceNormals) mesh.normals.clear();
  completeNormals(mesh);  // also turns faces to where given normals point
  if (isFlipped) mesh = builtin::insideOut(std::move(mesh));
  if (hasTangents) addTangents(mesh);
  if (hasFaceNormals) mesh.normals.clear();
  return mesh;
}

uint32_t Shapes::curvesOf(const Element& element, Parameters& p, glm::dmat4& toWorld) {
  const glm::dmat4 pointsToWorld = p.transform("to_world");
  const std::string name = p.text("filename", "");
  if (!p.has("filename"))
    p.fail("filename", fmt::format("shape '{}' has no 'filename'", element.type));
  const std::string source = context_.files.find(name, p.place()).string();
  std::string key = element.type + " " + source;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) key += fmt::format(" {}", pointsToWorld[column][row]);
  auto known = curves_.find(key);
  if (known == curves_.end()) {
    const Bytes bytes = context_.files.read(source, element.place, kMostMeshBytes);
    glm::dvec3 centre;
    context_.scene.geometries.push_back(
        readCurves(bytes, source, element.type, pointsToWorld, centre));
    known =
        curves_.emplace(key, Curves{uint32_t(context_.scene.geometries.size() - 1), centre}).first;
  }
  toWorld = glm::translate(glm::dmat4(1.0), known->second.centre);
  return known->second.geometry;
}

uint32_t Shapes::meshOf(const Element& element, Parameters& p, bool hasTangents,
                        glm::dmat4& toWorld) {
  const std::string& type = element.type;
  toWorld = placed(element, p);
  const bool isFlipped = p.boolean("flip_normals", false);
  bool hasFaceNormals = false, flipsRows = false;
  size_t index = 0;
  std::string source = type;
  if (isMeshFile(type)) {
    hasFaceNormals = p.boolean("face_normals", false);
    if (type != "serialized") flipsRows = p.boolean("flip_tex_coords", type == "obj");
    if (type == "serialized") index = size_t(p.integer("shape_index", 0, 0, 1 << 30));
    const std::string name = p.text("filename", "");
    if (!p.has("filename")) p.fail("filename", fmt::format("shape '{}' has no 'filename'", type));
    source = context_.files.find(name, p.place()).string();
    p.ignore({"max_smooth_angle", "collapse", "srgb"});
  }
  const bool isRound = analyticShape(type) && isCurved(type);
  if (isRound && isFlipped && !std::exchange(saysCurved_, true))
    context_.report.note("curved shapes", element.place,
                         "spheres, disks and cylinders with flip_normals are meshes of 128 "
                         "segments with exact normals");
  const MeshKey key(source, index, hasFaceNormals, isFlipped, flipsRows, hasTangents);
  if (const auto known = meshes_.find(key); known != meshes_.end()) return known->second;
  context_.scene.geometries.push_back(readMesh(element, key));
  return meshes_[key] = uint32_t(context_.scene.geometries.size() - 1);
}

void Shapes::addShape(const Element& element, const glm::dmat4& groupToWorld,
                      const std::string& name) {
  const bool isCurves = isCurveFile(element.type);
  if (!analyticShape(element.type) && !isMeshFile(element.type) && !isCurves) {
    const std::string text = fmt::format(
        "shape '{}' is unknown; one of obj, ply, serialized, rectangle, disk, sphere, cylinder, "
        "cube, bsplinecurve, linearcurve, shapegroup, instance expected",
        element.type);
    if (!context_.allowsUnknown) context_.report.fail(element.place, text);
    context_.report.warn("unknown shape", element.place, text + "; it is left out");
    return;
  }
  if (++shapes_ > kMostInstances)
    context_.report.fail(element.place, fmt::format("more than {} shapes", kMostInstances));
  Parameters p(element, context_);
  const std::vector<const Element*> bsdfs = p.plugins("bsdf"), emitters = p.plugins("emitter");
  if (bsdfs.size() > 1 || emitters.size() > 1)
    p.fail("", "a shape has more than one bsdf or emitter");
  for (const char* tag : {"medium", "subsurface"}) {
    if (p.plugins(tag).empty()) continue;
    const std::string text = fmt::format("<{}> of a shape is not read", tag);
    if (!context_.allowsUnknown) context_.report.fail(element.place, text);
    context_.report.warn("medium", element.place, text + "; the shape is drawn without");
  }
  std::optional<TexturedColor> emission;
  if (!emitters.empty()) emission = areaEmission(*emitters[0], context_, textures_);
  const Bsdfs::Surface surface =
      bsdfs_.surfaceOf(bsdfs.empty() ? nullptr : bsdfs[0], emission, name);
  glm::dmat4 toWorld(1.0);
  const uint32_t mesh =
      isCurves ? curvesOf(element, p, toWorld) : meshOf(element, p, surface.hasTangents, toWorld);
  p.finish();
  if (surface.isNull && !emission) return;  // light passes as if nothing were there
  if (context_.scene.geometries[mesh].triangles.empty()) {
    context_.report.warn("no triangles", element.place, "holds no triangle and is not drawn");
    return;
  }
  toWorld = groupToWorld * toWorld;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!(std::abs(toWorld[column][row]) <= 3e38))
        context_.report.fail(element.place, "its transform to the world is not finite");
  if (context_.scene.geometries[mesh].shape != nullptr) {
    constexpr double kLeast = 1e-9, kMost = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      const double size = glm::length(glm::dvec3(toWorld[axis]));
      if (size < kLeast || size > kMost)
        context_.report.fail(element.place,
                             fmt::format("its size along an axis is {:g}; {:g} to {:g} expected",
                                         size, kLeast, kMost));
    }
  }
  uint32_t material = surface.material;
  if (surface.hasHeights) {
    const MeshGeometry& geometry = context_.scene.geometries[mesh];
    const UvScale scale = uvScaleOf(geometry.shape ? fineMesh(*geometry.shape) : geometry, toWorld);
    material = bsdfs_.withHeights(material, scale, element.place);
  }
  context_.scene.instances.push_back({oneLine(name), mesh, material, toWorld});
}

void Shapes::addInstances(const Element& element) {
  Parameters p(element, context_);
  const glm::dmat4 toWorld = p.transform("to_world");
  const std::vector<const Element*> groups = p.plugins("shape");
  if (groups.size() != 1 || groups[0]->type != "shapegroup")
    p.fail("", "an instance names one shapegroup: <ref id=\"...\"/> expected");
  p.finish();
  Parameters group(*groups[0], context_);
  const std::vector<const Element*> shapes = group.plugins("shape");
  group.finish();
  for (size_t i = 0; i < shapes.size(); ++i) {
    if (shapes[i]->type == "instance" || shapes[i]->type == "shapegroup")
      context_.report.fail(shapes[i]->place, "a shapegroup holds shapes, and no other groups");
    const std::string name = element.id.empty() ? groups[0]->id : element.id;
    addShape(*shapes[i], toWorld, shapes.size() == 1 ? name : fmt::format("{}[{}]", name, i));
  }
}

void Shapes::add(const Element& element) {
  if (element.type == "shapegroup") return;  // drawn by its instances
  if (element.type == "instance") return addInstances(element);
  const std::string name = element.id.empty()
                               ? fmt::format("{} {}", element.type, context_.scene.instances.size())
                               : element.id;
  addShape(element, glm::dmat4(1.0), name);
}

}  // namespace restlab::mitsuba
