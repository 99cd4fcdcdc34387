#include "core/scene/gltf/attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/gltf/accessor.h"

namespace restlab::gltf {
namespace {

// Upper bound on the length error of unit vectors stored in 8 bits.
constexpr float kUnitTolerance = 0.02f;

enum class Semantic { position, normal, tangent, texcoord, color, notRead, unknown };

// "TEXCOORD_2" -> texcoord, set 2.
struct Attribute {
  Semantic semantic = Semantic::unknown;
  uint32_t set = 0;
};

Attribute parseAttribute(const std::string& name) {
  if (name == "POSITION") return {Semantic::position};
  if (name == "NORMAL") return {Semantic::normal};
  if (name == "TANGENT") return {Semantic::tangent};
  if (!name.empty() && name[0] == '_') return {Semantic::notRead};
  const size_t underscore = name.rfind('_');
  if (underscore == std::string::npos || underscore + 1 == name.size() ||
      name.size() - underscore > 4 ||
      name.find_first_not_of("0123456789", underscore + 1) != std::string::npos ||
      (name[underscore + 1] == '0' && underscore + 2 != name.size())) {
    return {};
  }
  const std::string stem = name.substr(0, underscore);
  const uint32_t set = static_cast<uint32_t>(std::stoul(name.substr(underscore + 1)));
  if (stem == "TEXCOORD") {
    return {set < rl::RL_MAX_UV_SETS ? Semantic::texcoord : Semantic::notRead, set};
  }
  if (stem == "COLOR") return {set == 0 ? Semantic::color : Semantic::notRead, set};
  if (stem == "JOINTS" || stem == "WEIGHTS") return {Semantic::notRead, set};
  return {};
}

bool isRead(Semantic semantic) {
  return semantic != Semantic::notRead && semantic != Semantic::unknown;
}

struct FormatCheck {
  bool allowed = false;
  bool needsQuantization = false;  // only KHR_mesh_quantization allows it
  const char* expected = "";
};

FormatCheck checkFormat(const tinygltf::Accessor& accessor, Semantic semantic) {
  const bool isFloat = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  const bool isWide = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  const bool isSigned = accessor.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
                        accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT;
  const bool isNormalizedUnsigned = !isFloat && !isWide && !isSigned && accessor.normalized;
  switch (semantic) {
    case Semantic::position:
      return {accessor.type == TINYGLTF_TYPE_VEC3 && !isWide, !isFloat, "{VEC3, FLOAT}"};
    case Semantic::normal:
      return {accessor.type == TINYGLTF_TYPE_VEC3 && (isFloat || (isSigned && accessor.normalized)),
              !isFloat, "{VEC3, FLOAT}"};
    case Semantic::tangent:
      return {accessor.type == TINYGLTF_TYPE_VEC4 && (isFloat || (isSigned && accessor.normalized)),
              !isFloat, "{VEC4, FLOAT}"};
    case Semantic::texcoord:
      return {accessor.type == TINYGLTF_TYPE_VEC2 && !isWide, !isFloat && !isNormalizedUnsigned,
              "{VEC2, FLOAT or normalized UNSIGNED_BYTE or UNSIGNED_SHORT}"};
    case Semantic::color:
      return {(accessor.type == TINYGLTF_TYPE_VEC3 || accessor.type == TINYGLTF_TYPE_VEC4) &&
                  (isFloat || isNormalizedUnsigned),
              false, "{VEC3 or VEC4, FLOAT or normalized UNSIGNED_BYTE or UNSIGNED_SHORT}"};
    default:
      return {true, false, ""};
  }
}

glm::vec3 normalOf(const MeshGeometry& geometry, uint32_t vertex) {
  glm::dvec3 sum(0.0);  // weighted by area
  for (const glm::uvec3& t : geometry.triangles) {
    if (t.x != vertex && t.y != vertex && t.z != vertex) continue;
    const glm::dvec3 a = geometry.positions[t.x], b = geometry.positions[t.y],
                     c = geometry.positions[t.z];
    sum += glm::cross(b - a, c - a);
  }
  const double length = glm::length(sum);
  return length > 0.0 ? glm::vec3(sum / length) : glm::vec3(0, 0, 1);
}

void readNormals(const AccessorReader& reader, const std::vector<uint32_t>& used,
                 const std::string& place, MeshGeometry& geometry, Report& report) {
  geometry.normals.resize(used.size());
  size_t zero = 0, notUnit = 0;
  for (size_t i = 0; i < used.size(); ++i) {
    const glm::dvec3 n(reader.number(used[i], 0), reader.number(used[i], 1),
                       reader.number(used[i], 2));
    const double length = glm::length(n);
    if (length < 1e-6) {
      // Zero normals are rare: searching all triangles for each is affordable, up to a limit.
      constexpr size_t kLookedAt = 1000;
      geometry.normals[i] =
          ++zero <= kLookedAt ? normalOf(geometry, static_cast<uint32_t>(i)) : glm::vec3(0, 0, 1);
      continue;
    }
    if (std::abs(length - 1.0) > kUnitTolerance) ++notUnit;
    geometry.normals[i] = glm::vec3(n / length);
  }
  if (zero == used.size() || zero > 1000) {
    report.warn("zero normals", place,
                fmt::format("{} of {} normals have no length; the primitive is "
                            "drawn flat",
                            zero, used.size()));
    geometry.normals.clear();
    return;
  }
  if (zero > 0) {
    report.warn("zero normals", place,
                fmt::format("{} of {} normals have no length; they take the direction of the "
                            "triangles around them",
                            zero, used.size()));
  }
  if (notUnit > 0) {
    report.warn("normal lengths", place,
                fmt::format("{} of {} normals are not of unit length; they "
                            "are normalised",
                            notUnit, used.size()));
  }
}

void readTangents(const AccessorReader& reader, const std::vector<uint32_t>& used,
                  const std::string& place, MeshGeometry& geometry, Report& report) {
  geometry.tangents.resize(used.size());
  size_t badSign = 0;
  for (size_t i = 0; i < used.size(); ++i) {
    const glm::dvec3 t(reader.number(used[i], 0), reader.number(used[i], 1),
                       reader.number(used[i], 2));
    const float w = reader.number(used[i], 3);
    const double length = glm::length(t);
    if (length < 1e-6) {
      report.warn(
          "zero tangents", place,
          fmt::format("vertex {} has no tangent direction; the tangents of this primitive are "
                      "derived from its UVs",
                      used[i]));
      geometry.tangents.clear();
      return;
    }
    if (std::abs(std::abs(w) - 1.0f) > kUnitTolerance) ++badSign;
    geometry.tangents[i] = glm::vec4(glm::vec3(t / length), w < 0.0f ? -1.0f : 1.0f);
  }
  if (badSign > 0) {
    report.warn("tangent signs", place,
                fmt::format("{} of {} handedness values are neither 1 nor -1; "
                            "their sign is used",
                            badSign, used.size()));
  }
}

void readColors(const AccessorReader& reader, const std::vector<uint32_t>& used,
                const std::string& place, MeshGeometry& geometry, Report& report) {
  geometry.colors.resize(used.size());
  size_t outside = 0;
  for (size_t i = 0; i < used.size(); ++i) {
    glm::vec4 color(1.0f);
    for (int c = 0; c < reader.components(); ++c) color[c] = reader.number(used[i], c);
    const glm::vec4 clamped = glm::clamp(color, 0.0f, 1.0f);
    if (clamped != color) ++outside;
    geometry.colors[i] = clamped;
  }
  if (outside > 0) {
    report.warn("colour range", place,
                fmt::format("{} of {} colours are outside 0 to 1; they are "
                            "clamped",
                            outside, used.size()));
  }
}

}  // namespace

void checkAttributes(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                     const std::string& place, Report& report) {
  const int position = primitive.attributes.at("POSITION");
  const size_t vertexCount = model.accessors[static_cast<size_t>(position)].count;
  const bool quantization = std::find(model.extensionsUsed.begin(), model.extensionsUsed.end(),
                                      "KHR_mesh_quantization") != model.extensionsUsed.end();
  for (const auto& [name, accessorIndex] : primitive.attributes) {
    const tinygltf::Accessor& accessor = model.accessors[static_cast<size_t>(accessorIndex)];
    const Attribute attribute = parseAttribute(name);
    const std::string at = place + ".attributes." + name;
    if (accessor.count != vertexCount) {
      report.fail(at, fmt::format("accessors[{}] has {} elements, but POSITION has {}",
                                  accessorIndex, accessor.count, vertexCount));
    }
    if (attribute.semantic == Semantic::unknown) {
      report.warn("unknown attribute", at,
                  "unknown attribute, not read" +
                      didYouMean(name, {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1",
                                        "TEXCOORD_2", "TEXCOORD_3", "COLOR_0"}));
    } else if (attribute.semantic == Semantic::notRead && name.rfind("COLOR", 0) == 0) {
      report.warn("unread colours", at, "is not read; only COLOR_0 is");
    } else if (attribute.semantic == Semantic::notRead && name.rfind("TEXCOORD", 0) == 0) {
      report.warn("unread UVs", at,
                  fmt::format("is not read; only TEXCOORD_0 to _{} are", rl::RL_MAX_UV_SETS - 1));
    }
    if (!isRead(attribute.semantic)) continue;
    const FormatCheck format = checkFormat(accessor, attribute.semantic);
    if (!format.allowed) {
      report.fail(at, fmt::format("accessors[{}] is {}; {} expected", accessorIndex,
                                  formatOf(accessor), format.expected));
    }
    if (format.needsQuantization && !quantization) {
      report.warn("quantization", at,
                  fmt::format("is {}, which needs KHR_mesh_quantization", formatOf(accessor)));
    }
    if (accessor.bufferView < 0 && !accessor.sparse.isSparse) {
      if (primitive.extensions.count("KHR_draco_mesh_compression")) {
        report.fail(at,
                    fmt::format("accessors[{}] has no bufferView; KHR_draco_mesh_compression is "
                                "not supported",
                                accessorIndex));
      }
      report.warn("accessor without data", at,
                  fmt::format("accessors[{}] has neither bufferView nor sparse values: all zero",
                              accessorIndex));
    }
  }
}

void checkFinite(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                 const std::string& place, std::vector<bool>& finite, Report& report) {
  for (const auto& [name, accessorIndex] : primitive.attributes) {
    const size_t index = static_cast<size_t>(accessorIndex);
    if (!isRead(parseAttribute(name).semantic) || finite[index]) continue;
    const AccessorReader reader(model, accessorIndex);
    if (reader.componentType() == TINYGLTF_COMPONENT_TYPE_FLOAT) {
      for (size_t i = 0; i < reader.count(); ++i) {
        for (int c = 0; c < reader.components(); ++c) {
          if (std::isfinite(reader.number(i, c))) continue;
          report.fail(place + ".attributes." + name,
                      fmt::format("component {} of vertex {} is {}; finite numbers expected",
                                  std::string(1, "xyzw"[c]), i, reader.number(i, c)));
        }
      }
    }
    finite[index] = true;
  }
}

void readAttributes(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                    const std::vector<uint32_t>& used, const std::string& place,
                    MeshGeometry& geometry, Report& report) {
  const AccessorReader positions(model, primitive.attributes.at("POSITION"));
  geometry.positions.resize(used.size());
  for (size_t i = 0; i < used.size(); ++i) {
    geometry.positions[i] = {positions.number(used[i], 0), positions.number(used[i], 1),
                             positions.number(used[i], 2)};
  }
  for (const auto& [name, accessorIndex] : primitive.attributes) {
    const Attribute attribute = parseAttribute(name);
    const std::string at = place + ".attributes." + name;
    if (!isRead(attribute.semantic)) continue;
    const AccessorReader reader(model, accessorIndex);
    switch (attribute.semantic) {
      case Semantic::normal:
        readNormals(reader, used, at, geometry, report);
        break;
      case Semantic::tangent:
        readTangents(reader, used, at, geometry, report);
        break;
      case Semantic::color:
        readColors(reader, used, at, geometry, report);
        break;
      case Semantic::texcoord: {
        std::vector<glm::vec2>& uvs = geometry.uvs[attribute.set];
        uvs.resize(used.size());
        for (size_t i = 0; i < used.size(); ++i) {
          uvs[i] = {reader.number(used[i], 0), reader.number(used[i], 1)};
        }
        break;
      }
      default:
        break;
    }
  }
  // glTF specification: without normals the primitive is flat, and its tangents are ignored.
  if (geometry.normals.empty()) geometry.tangents.clear();
}

}  // namespace restlab::gltf
