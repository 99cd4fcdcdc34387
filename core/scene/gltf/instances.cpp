#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/scene/gltf/accessor.h"
#include "core/scene/gltf/objects.h"
#include "core/scene/linear_map.h"

namespace restlab::gltf {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
// Limit on instances: shared accessors let a small file ask for any number.
constexpr size_t kMaxInstances = size_t(1) << 24;

bool isMirrored(const glm::dmat3& regular) { return glm::determinant(regular) < 0.0; }

// Returns the transform to draw a mesh with; nullopt if less than a plane remains. A flattening
// transform keeps a trace of thickness, on the side that a very small scale in place of 0 would
// give; CompiledScene increases the thickness to what float32 resolves.
std::optional<glm::dmat4> drawable(const glm::dmat4& toWorld, bool mirrored) {
  const glm::dmat3 linear(toWorld);
  if (regularity(linear) > kSmallestRegularity) return toWorld;
  const Flatness flatness = flatnessOf(linear);
  if (!(flatness.inPlane > 0.0)) return std::nullopt;
  constexpr double kTrace = 0.1 * kSmallestRegularity;
  glm::dmat3 thick = withStretch(linear, flatness, kTrace * flatness.inPlane);
  if ((glm::determinant(thick) < 0.0) != mirrored)
    thick = withStretch(linear, flatness, -kTrace * flatness.inPlane);
  glm::dmat4 drawn(thick);
  drawn[3] = toWorld[3];
  return drawn;
}

// Transforms of EXT_mesh_gpu_instancing, relative to the node.
class InstanceTransforms {
 public:
  InstanceTransforms(const tinygltf::Model& model, const tinygltf::Value& extension,
                     const std::string& place, Report& report)
      : model_(model), place_(place + ".attributes."), report_(report) {
    const tinygltf::Value& attributes = extension.Get("attributes");
    for (const std::string& name : attributes.Keys()) {
      const int accessor = attributes.Get(name).GetNumberAsInt();
      if (name == "TRANSLATION") {
        open(translation_, name, accessor, TINYGLTF_TYPE_VEC3);
      } else if (name == "ROTATION") {
        open(rotation_, name, accessor, TINYGLTF_TYPE_VEC4);
      } else if (name == "SCALE") {
        open(scale_, name, accessor, TINYGLTF_TYPE_VEC3);
      } else if (name.empty() || name[0] != '_') {
        report_.warn("unknown attribute", place_ + name,
                     "unknown attribute, not read; TRANSLATION, ROTATION or SCALE expected");
      }
    }
  }

  size_t count() const { return count_.value_or(0); }

  // Transform of instance `i`. With `isRegular`, scales of 0 are read as 1.
  glm::dmat4 transform(size_t i, bool isRegular) const {
    glm::dvec4 rotation(0, 0, 0, 1);
    if (rotation_) {
      rotation = read(*rotation_, i);
      const double length = glm::length(rotation);
      if (!(length > 1e-6)) {
        report_.fail(place_ + "ROTATION",
                     fmt::format("the quaternion of instance {} has no length", i));
      }
      constexpr double kTolerance = 0.02;  // rounding of 8-bit quaternions
      if (std::abs(length - 1.0) > kTolerance) {
        report_.warn("rotation length", place_ + "ROTATION",
                     fmt::format("the quaternion of instance {} has length {:g}; it is normalised",
                                 i, length));
      }
    }
    const glm::dvec3 scale = scale_ ? glm::dvec3(read(*scale_, i)) : glm::dvec3(1.0);
    return composeTransform(translation_ ? glm::dvec3(read(*translation_, i)) : glm::dvec3(0.0),
                            rotation, isRegular ? regularScale(scale) : scale);
  }

 private:
  void open(std::optional<AccessorReader>& reader, const std::string& name, int accessorIndex,
            int type) {
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<size_t>(accessorIndex)];
    const bool isFloat = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    const bool isQuantized = type == TINYGLTF_TYPE_VEC4 && accessor.normalized &&
                             (accessor.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
                              accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT);
    if (accessor.type != type || !(isFloat || isQuantized)) {
      report_.fail(
          place_ + name,
          fmt::format("accessors[{}] is {}; {} expected", accessorIndex, formatOf(accessor),
                      type == TINYGLTF_TYPE_VEC4 ? "{VEC4, FLOAT or normalized BYTE or SHORT}"
                                                 : "{VEC3, FLOAT}"));
    }
    if (count_ && *count_ != accessor.count) {
      report_.fail(place_ + name,
                   fmt::format("accessors[{}] has {} elements; {} expected as in the "
                               "other attributes",
                               accessorIndex, accessor.count, *count_));
    }
    count_ = accessor.count;
    reader.emplace(model_, accessorIndex);
    for (size_t i = 0; i < reader->count(); ++i) {
      for (int c = 0; c < reader->components(); ++c) {
        if (std::isfinite(reader->number(i, c))) continue;
        report_.fail(place_ + name, fmt::format("component {} of instance {} is {}; finite numbers "
                                                "expected",
                                                c, i, reader->number(i, c)));
      }
    }
  }

  static glm::dvec3 regularScale(glm::dvec3 scale) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(scale[axis]) > kSmallestScale)) scale[axis] = 1.0;
    return scale;
  }

  static glm::dvec4 read(const AccessorReader& reader, size_t i) {
    glm::dvec4 value(0.0);
    for (int c = 0; c < reader.components(); ++c) value[c] = reader.number(i, c);
    return value;
  }

  const tinygltf::Model& model_;
  std::string place_;
  Report& report_;
  std::optional<AccessorReader> translation_, rotation_, scale_;
  std::optional<size_t> count_;
};

class InstanceAdder {
 public:
  InstanceAdder(const tinygltf::Model& model, MeshImporter& meshes, Scene& scene, Report& report)
      : model_(model), meshes_(meshes), scene_(scene), report_(report) {}

  void add(const PlacedNode& placed) {
    const tinygltf::Node& node = model_.nodes[placed.node];
    if (node.mesh < 0) return;
    const tinygltf::Mesh& mesh = model_.meshes[static_cast<size_t>(node.mesh)];
    const std::vector<MeshImporter::Part>& parts = meshes_.parts(static_cast<size_t>(node.mesh));
    const std::string name = !node.name.empty()   ? node.name
                             : !mesh.name.empty() ? mesh.name
                                                  : fmt::format("nodes[{}]", placed.node);
    const auto instancing = node.extensions.find(kInstancing);
    if (instancing == node.extensions.end()) {
      addParts(parts, name, placed.toWorld, isMirrored(placed.regular),
               placeOfNode(model_, placed.node));
      return;
    }
    const std::string place = fmt::format("nodes[{}].extensions.{}", placed.node, kInstancing);
    const InstanceTransforms transforms(model_, instancing->second, place, report_);
    if (transforms.count() == 0) {
      report_.fail(place, "has no TRANSLATION, ROTATION or SCALE; at least one expected");
    }
    report_.takeMemory(place, fmt::format("{} instances", transforms.count()),
                       transforms.count() * parts.size() * sizeof(MeshInstance));
    for (size_t i = 0; i < transforms.count(); ++i) {
      const glm::dmat4 own = transforms.transform(i, false);
      const glm::dmat3 regular = placed.regular * glm::dmat3(transforms.transform(i, true));
      addParts(parts, fmt::format("{}[{}]", name, i), placed.toWorld * own, isMirrored(regular),
               place);
    }
  }

 private:
  void addParts(const std::vector<MeshImporter::Part>& parts, const std::string& name,
                const glm::dmat4& toWorld, bool mirrored, const std::string& place) {
    if (parts.empty()) return;
    const std::optional<glm::dmat4> drawn = drawable(toWorld, mirrored);
    if (!drawn) {
      report_.warn("degenerate transform", place,
                   fmt::format("its transform to the world leaves a line or a point of '{}', which "
                               "has no area; it is not drawn",
                               name));
      return;
    }
    if (*drawn != toWorld) {
      report_.warn(
          "plate", place,
          fmt::format("its transform to the world flattens '{}'; it is drawn as a plate", name));
    }
    if (scene_.instances.size() + parts.size() > kMaxInstances) {
      report_.fail(place, fmt::format("more than {} mesh instances in the scene", kMaxInstances));
    }
    for (const MeshImporter::Part& part : parts) {
      scene_.instances.push_back({name, part.geometry, part.material, *drawn});
    }
  }

  const tinygltf::Model& model_;
  MeshImporter& meshes_;
  Scene& scene_;
  Report& report_;
};

}  // namespace

void addMeshInstances(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                      MeshImporter& meshes, Scene& scene, Report& report) {
  InstanceAdder adder(model, meshes, scene, report);
  for (const PlacedNode& placed : nodes) adder.add(placed);
}

}  // namespace restlab::gltf
