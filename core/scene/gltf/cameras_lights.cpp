#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/scene/gltf/json.h"
#include "core/scene/gltf/objects.h"

namespace restlab::gltf {
namespace {

constexpr uint64_t kMostBounces = 1024, kMostFilm = uint64_t{1} << 20;

// `extras.restlab.KEY` of an object; nullptr: it has none.
const nlohmann::json* ownProperty(const nlohmann::json& object, const char* key) {
  const nlohmann::json* at = &object;
  for (const char* name : {"extras", "restlab", key}) {
    const auto found = at->is_object() ? at->find(name) : at->end();
    if (found == at->end()) return nullptr;
    at = &*found;
  }
  return at;
}

bool isWholeUpTo(const nlohmann::json& value, uint64_t least, uint64_t most) {
  return value.is_number_unsigned() && value.get<uint64_t>() >= least &&
         value.get<uint64_t>() <= most;
}

SceneCamera importCamera(const tinygltf::Model& model, int index, Report& report) {
  const tinygltf::Camera& source = model.cameras[static_cast<size_t>(index)];
  const std::string place = fmt::format("cameras[{}].{}", index, source.type);
  SceneCamera camera;
  double znear = 0.0, zfar = 0.0;
  if (source.type == "perspective") {
    camera.kind = rl::RL_CAMERA_PERSPECTIVE;
    camera.yfov = source.perspective.yfov;
    camera.aspect = source.perspective.aspectRatio;
    if (!(camera.yfov < glm::pi<double>())) {
      report.fail(
          place + ".yfov",
          fmt::format("{:g} is out of range; less than pi expected (radians)", camera.yfov));
    }
    znear = source.perspective.znear;
    zfar = source.perspective.zfar;
  } else {
    camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
    camera.xmag = std::abs(source.orthographic.xmag);
    camera.ymag = std::abs(source.orthographic.ymag);
    if (camera.xmag == 0.0 || camera.ymag == 0.0) {
      report.fail(place, fmt::format("xmag is {:g} and ymag is {:g}; half extents other than 0 "
                                     "expected",
                                     camera.xmag, camera.ymag));
    }
    if (source.orthographic.xmag < 0.0 || source.orthographic.ymag < 0.0) {
      report.warn("negative magnification", place, "xmag or ymag is negative; its size is used");
    }
    camera.aspect = camera.xmag / camera.ymag;
    znear = source.orthographic.znear;
    zfar = source.orthographic.zfar;
  }
  camera.znear = std::max(znear, 0.0);
  // A path tracer has no clipping planes, but senseless ones deserve a warning.
  if (zfar != 0.0 && zfar <= znear) {
    report.warn("clipping planes", place,
                fmt::format("zfar {:g} is not beyond znear {:g}; neither is used", zfar, znear));
  }
  return camera;
}

void warnOfScale(const PlacedNode& placed, const tinygltf::Model& model, const std::string& what,
                 Report& report) {
  if (placed.isOwnScalePositive) return;
  report.warn(
      "scale of " + what, placeOfNode(model, placed.node),
      fmt::format("carries a {}, and its scale, or that of a node above it, is 0 or mirrors; "
                  "the {} is drawn without its node's own scale, and with 1 for any other "
                  "scale of 0",
                  what, what));
}

// Computes the camera's right-handed axes, and whether the image is mirrored left to right: a
// camera and objects below the same mirrored node give the image without the mirror.
void placeCamera(SceneCamera& camera, const PlacedNode& placed) {
  glm::dmat3 axes = carriedAxes(placed);
  camera.isMirrored = glm::determinant(axes) < 0.0;
  if (camera.isMirrored) axes[0] = -axes[0];
  for (int axis = 0; axis < 3; ++axis) camera.cameraToWorld[axis] = glm::dvec4(axes[axis], 0.0);
  camera.cameraToWorld[3] = placed.toWorld[3];
}

PunctualLight importLight(const tinygltf::Light& source, const std::string& place, Report& report) {
  PunctualLight light;
  light.kind = source.type == "point"  ? rl::RL_LIGHT_POINT
               : source.type == "spot" ? rl::RL_LIGHT_SPOT
                                       : rl::RL_LIGHT_DIRECTIONAL;
  const glm::dvec3 color = source.color.size() == 3
                               ? glm::dvec3(source.color[0], source.color[1], source.color[2])
                               : glm::dvec3(1.0);
  light.intensity = glm::vec3(color * source.intensity);
  for (int c = 0; c < 3; ++c) {
    if (!std::isfinite(light.intensity[c])) {
      report.fail(place, "color x intensity is too large for a 32-bit float");
    }
  }
  if (light.kind != rl::RL_LIGHT_SPOT) return light;
  double inner = source.spot.innerConeAngle;
  const double outer = source.spot.outerConeAngle;
  if (outer <= 0.0) report.fail(place + ".spot.outerConeAngle", "is 0; a cone angle expected");
  if (inner > outer) {
    report.fail(place + ".spot",
                fmt::format("innerConeAngle {:g} exceeds outerConeAngle {:g}", inner, outer));
  }
  // Keep a minimum width for the falloff between the angles.
  constexpr double kWidest = 0.999;
  if (inner > kWidest * outer) {
    report.warn("spot edge", place + ".spot.innerConeAngle",
                fmt::format("{:g} leaves no edge; {:g} is used", inner, kWidest * outer));
    inner = kWidest * outer;
  }
  light.innerConeAngle = static_cast<float>(inner);
  light.outerConeAngle = static_cast<float>(outer);
  return light;
}

}  // namespace

std::optional<uint32_t> readBounces(const nlohmann::json& document, const Report& report) {
  const nlohmann::json& scenes = arrayOf(document, "scenes");
  const uint64_t drawn = sizeOf(document, "scene", 0);
  if (drawn >= scenes.size()) return {};
  const nlohmann::json* value = ownProperty(scenes[drawn], "max_bounces");
  if (value == nullptr) return {};
  if (!isWholeUpTo(*value, 0, kMostBounces))
    report.fail(fmt::format("scenes[{}].extras.restlab.max_bounces", drawn),
                fmt::format("is {}; a whole number from 0 to {} expected",
                            value->is_number() ? value->dump() : typeName(*value), kMostBounces));
  return value->get<uint32_t>();
}

std::vector<glm::uvec2> readFilms(const nlohmann::json& document, const Report& report) {
  std::vector<glm::uvec2> films;
  for (const nlohmann::json& camera : arrayOf(document, "cameras")) {
    films.emplace_back(0u);
    const nlohmann::json* value = ownProperty(camera, "film");
    if (value == nullptr) continue;
    const bool isSize = value->is_array() && value->size() == 2 &&
                        isWholeUpTo((*value)[0], 1, kMostFilm) &&
                        isWholeUpTo((*value)[1], 1, kMostFilm);
    if (!isSize)
      report.fail(
          fmt::format("cameras[{}].extras.restlab.film", films.size() - 1),
          fmt::format("is not [width, height]; whole numbers of pixels from 1 to {} expected",
                      kMostFilm));
    films.back() = {(*value)[0].get<uint32_t>(), (*value)[1].get<uint32_t>()};
  }
  return films;
}

void addCameras(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes,
                const std::vector<glm::uvec2>& films, Scene& scene, Report& report) {
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = model.nodes[placed.node];
    if (node.camera < 0) continue;
    SceneCamera camera = importCamera(model, node.camera, report);
    camera.film = films.at(static_cast<size_t>(node.camera));
    warnOfScale(placed, model, "camera", report);
    const std::string& cameraName = model.cameras[static_cast<size_t>(node.camera)].name;
    camera.name = !cameraName.empty()  ? cameraName
                  : !node.name.empty() ? node.name
                                       : fmt::format("camera{}", scene.cameras.size());
    placeCamera(camera, placed);
    scene.cameras.push_back(std::move(camera));
  }
  for (size_t i = 0; i < model.cameras.size(); ++i) {
    importCamera(model, static_cast<int>(i), report);  // also checks unused cameras
  }
}

void addLights(const tinygltf::Model& model, const std::vector<PlacedNode>& nodes, Scene& scene,
               Report& report) {
  const auto placeOf = [](size_t i) {
    return fmt::format("extensions.KHR_lights_punctual.lights[{}]", i);
  };
  std::vector<PunctualLight> lights;
  for (size_t i = 0; i < model.lights.size(); ++i)
    lights.push_back(importLight(model.lights[i], placeOf(i), report));
  std::vector<bool> isCarried(lights.size(), false);
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = model.nodes[placed.node];
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end()) continue;
    const size_t index = static_cast<size_t>(extension->second.Get("light").GetNumberAsInt());
    PunctualLight light = lights[index];
    isCarried[index] = true;
    const std::string& name = model.lights[index].name;
    light.name = !name.empty()        ? name
                 : !node.name.empty() ? node.name
                                      : fmt::format("light{}", scene.lights.size());
    light.posW = glm::dvec3(placed.toWorld[3]);
    if (light.kind != rl::RL_LIGHT_POINT) {
      warnOfScale(placed, model, "light", report);
      const glm::dvec3 forward = -carriedAxes(placed)[2];
      light.dirW = forward / glm::length(forward);
    }
    scene.lights.push_back(std::move(light));
  }
  for (size_t i = 0; i < lights.size(); ++i)
    if (!isCarried[i]) report.warn("unused light", placeOf(i), "no node of the scene carries it");
}

}  // namespace restlab::gltf
