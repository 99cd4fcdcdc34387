#include "core/scene/gltf/rules.h"

#include <fmt/format.h>

#include <set>

#include "core/scene/gltf/json.h"
#include "core/scene/gltf/meshopt.h"

namespace restlab::gltf {
namespace {

using nlohmann::json;

void checkBufferViews(const json& document, Report& report) {
  const json& buffers = arrayOf(document, "buffers");
  const json& views = arrayOf(document, "bufferViews");
  for (size_t i = 0; i < views.size(); ++i) {
    const std::string place = fmt::format("bufferViews[{}]", i);
    const uint64_t buffer = views[i].at("buffer").get<uint64_t>();
    const uint64_t available = buffers[buffer].at("byteLength").get<uint64_t>();
    const uint64_t offset = sizeOf(views[i], "byteOffset", 0);
    const uint64_t length = views[i].at("byteLength").get<uint64_t>();
    if (offset > available || length > available - offset) {
      report.fail(place, fmt::format("bytes {} to {} reach beyond buffers[{}], which has {}",
                                     offset, offset + length, buffer, byteCount(available)));
    }
    if (!views[i].contains("byteStride")) continue;
    const uint64_t stride = sizeOf(views[i], "byteStride", 0);
    if (stride % 4 != 0) {
      report.fail(place + ".byteStride",
                  fmt::format("{} is not valid; a multiple of 4 expected", stride));
    }
    constexpr uint64_t kElementArrayBuffer = 34963;
    if (sizeOf(views[i], "target", 0) == kElementArrayBuffer) {
      report.warn("stride", place + ".byteStride",
                  "given for indices; only vertex data may have it");
    }
    if (stride > length) {
      report.warn("stride", place + ".byteStride",
                  fmt::format("{} exceeds the view's {} bytes", stride, length));
    }
  }
}

void checkAccessorOffsets(const json& document, Report& report) {
  const json& accessors = arrayOf(document, "accessors");
  for (size_t i = 0; i < accessors.size(); ++i) {
    if (accessors[i].contains("byteOffset") && !accessors[i].contains("bufferView")) {
      report.fail(fmt::format("accessors[{}].byteOffset", i), "given without a bufferView");
    }
  }
}

// Returns the accessors that meshes and instances use.
std::set<uint64_t> drawnAccessors(const json& document) {
  std::set<uint64_t> drawn;
  const auto addAll = [&](const json& attributes) {
    for (const json& accessor : attributes) drawn.insert(accessor.get<uint64_t>());
  };
  for (const json& mesh : arrayOf(document, "meshes")) {
    for (const json& primitive : mesh.at("primitives")) {
      addAll(primitive.at("attributes"));
      if (primitive.contains("indices")) drawn.insert(primitive.at("indices").get<uint64_t>());
    }
  }
  const json::json_pointer instances("/extensions/EXT_mesh_gpu_instancing/attributes");
  for (const json& node : arrayOf(document, "nodes")) {
    if (node.contains(instances)) addAll(node.at(instances));
  }
  return drawn;
}

// Checks accessors with count 0: exporters leave some behind, mostly of animations.
void checkEmptyAccessors(const json& document, Report& report) {
  const json& accessors = arrayOf(document, "accessors");
  std::set<uint64_t> drawn;
  for (size_t i = 0; i < accessors.size(); ++i) {
    if (accessors[i].at("count").get<uint64_t>() != 0) continue;
    if (drawn.empty()) drawn = drawnAccessors(document);
    const std::string place = fmt::format("accessors[{}].count", i);
    if (drawn.contains(i)) report.fail(place, "0; at least 1 expected");
    report.warn("empty accessor", place, "is 0; nothing imported reads it");
  }
}

// Fails on indices without a buffer view, which are all zero, where no compressed mesh replaces
// them.
void checkIndexAccessors(const json& document, Report& report) {
  const json& meshes = arrayOf(document, "meshes");
  const json& accessors = arrayOf(document, "accessors");
  for (size_t m = 0; m < meshes.size(); ++m) {
    const json& primitives = meshes[m].at("primitives");
    for (size_t p = 0; p < primitives.size(); ++p) {
      const auto indices = primitives[p].find("indices");
      if (indices == primitives[p].end()) continue;
      const uint64_t accessor = indices->get<uint64_t>();
      if (accessors[accessor].contains("bufferView")) continue;
      const auto extensions = primitives[p].find("extensions");
      if (extensions != primitives[p].end() && extensions->contains("KHR_draco_mesh_compression"))
        continue;
      report.fail(fmt::format("meshes[{}].primitives[{}].indices", m, p),
                  fmt::format("accessors[{}] has no bufferView", accessor));
    }
  }
}

void checkImages(const json& document, Report& report) {
  const json& images = arrayOf(document, "images");
  for (size_t i = 0; i < images.size(); ++i) {
    const bool hasUri = images[i].contains("uri"), hasView = images[i].contains("bufferView");
    if (hasUri != hasView) continue;
    report.fail(fmt::format("images[{}]", i), hasUri
                                                  ? "has both uri and bufferView; one expected"
                                                  : "has neither uri nor bufferView; one expected");
  }
}

void checkNodes(const json& document, Report& report) {
  const json& nodes = arrayOf(document, "nodes");
  for (size_t i = 0; i < nodes.size(); ++i) {
    for (const char* key : {"skin", "weights"}) {
      if (!nodes[i].contains(key) || nodes[i].contains("mesh")) continue;
      report.warn("node without mesh", fmt::format("nodes[{}].{}", i, key),
                  "has no meaning without a mesh");
    }
    if (!nodes[i].contains("matrix")) continue;
    for (const char* key : {"translation", "rotation", "scale"}) {
      if (!nodes[i].contains(key)) continue;
      report.warn("matrix and TRS", fmt::format("nodes[{}].{}", i, key),
                  "is not read: the node has a matrix, too");
    }
  }
}

void checkCameras(const json& document, Report& report) {
  const json& cameras = arrayOf(document, "cameras");
  for (size_t i = 0; i < cameras.size(); ++i) {
    const std::string type = cameras[i].at("type");
    const char* other = type == "perspective" ? "orthographic" : "perspective";
    const std::string place = fmt::format("cameras[{}]", i);
    if (!cameras[i].contains(type)) {
      report.fail(place, fmt::format("is of type '{}', but '{}' is missing", type, type));
    }
    if (cameras[i].contains(other)) {
      report.fail(place, "has both 'perspective' and 'orthographic'; one expected");
    }
  }
}

void checkLights(const json& document, Report& report) {
  const json& extensions = document.contains("extensions") ? document.at("extensions") : json();
  if (!extensions.contains("KHR_lights_punctual")) return;
  const json& lights = extensions.at("KHR_lights_punctual").at("lights");
  for (size_t i = 0; i < lights.size(); ++i) {
    const std::string place = fmt::format("extensions.KHR_lights_punctual.lights[{}]", i);
    const bool isSpot = lights[i].at("type") == "spot";
    if (isSpot && !lights[i].contains("spot")) {
      report.fail(place, "is of type 'spot', but 'spot' is missing");
    }
    if (!isSpot && lights[i].contains("spot")) {
      report.warn("spot of another light", place + ".spot",
                  "has no meaning for this type of light");
    }
    if (lights[i].contains("range")) {
      report.warn("light range", place + ".range",
                  "is not read: light falls off with the square of the distance only");
    }
  }
}

bool isNonEmptyArray(const json& document, const char* key) {
  const auto it = document.find(key);
  return it != document.end() && it->is_array() && !it->empty();
}

}  // namespace

void checkRules(const json& document, Report& report) {
  checkBufferViews(document, report);
  checkMeshopt(document, report);
  checkAccessorOffsets(document, report);
  checkEmptyAccessors(document, report);
  checkIndexAccessors(document, report);
  checkImages(document, report);
  checkNodes(document, report);
  checkCameras(document, report);
  checkLights(document, report);
}

void warnNotImported(const json& document, Report& report) {
  if (isNonEmptyArray(document, "animations")) {
    report.warn("animations", "animations", "are not read; the scene is drawn in its rest pose");
  }
  if (isNonEmptyArray(document, "skins")) {
    report.warn("skins", "skins", "are not read; skinned meshes are drawn where their nodes stand");
  }
  const json& meshes = arrayOf(document, "meshes");
  for (size_t m = 0; m < meshes.size(); ++m) {
    const json& primitives = meshes[m].at("primitives");
    for (size_t p = 0; p < primitives.size(); ++p) {
      if (!primitives[p].contains("targets")) continue;
      report.warn("morph targets", fmt::format("meshes[{}].primitives[{}].targets", m, p),
                  "morph targets are not read; the mesh is drawn with all weights 0");
      m = meshes.size() - 1;  // one line is enough
      break;
    }
  }
  const size_t scenes = arrayOf(document, "scenes").size();
  if (scenes > 1) {
    report.warn(
        "scenes", "scenes",
        fmt::format("{} scenes; only scenes[{}] is drawn", scenes, sizeOf(document, "scene", 0)));
  }
  for (size_t i = 0; i < scenes; ++i) {
    const json& scene = arrayOf(document, "scenes")[i];
    const auto extras = scene.find("extras");
    if (extras == scene.end() || !extras->is_object() || !extras->contains("environment")) continue;
    report.warn("environment in extras", fmt::format("scenes[{}].extras.environment", i),
                "is not read; an environment map is given when rendering");
  }
}

}  // namespace restlab::gltf
