// Camera paths as TOML tables.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/base/config.h"
#include "core/scene/camera_path/camera_path.h"

namespace restlab {

namespace {

constexpr int64_t kMaxFrame = int64_t(1) << 31;
constexpr double kMaxMetres = 1e9;

// Order: that of CameraPathKind.
const std::vector<std::string> kKinds = {"still", "orbit", "dolly",    "pan",
                                         "cut",   "back",  "keyframes"};

const std::vector<std::string> kAxes = {"scene", "camera", "world", "x", "y", "z"};

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

void require(const ConfigTable& table, const std::string& what, const std::string& key) {
  if (!table.has(key)) table.fail("", fmt::format("{} needs '{}'", what, key));
}

glm::dvec3 getPoint(const ConfigTable& table, const std::string& key) {
  const std::vector<double> numbers = table.getNumbers(key, {}, 3, -kMaxMetres, kMaxMetres);
  return {numbers[0], numbers[1], numbers[2]};
}

uint32_t getFrame(const ConfigTable& table, const std::string& what) {
  require(table, what, "frame");
  return uint32_t(table.getInteger("frame", 0, 0, kMaxFrame));
}

void readCut(const ConfigTable& table, CameraPath& path) {
  path.cutFrame = getFrame(table, "a camera path of the kind 'cut'");
  const bool toCamera = table.has("camera"), byAngle = table.has("degrees");
  if (toCamera == byAngle) {
    table.fail(toCamera ? "degrees" : "",
               "a cut needs either 'camera' or 'degrees' (of an orbit), and not both");
  }
  if (toCamera && table.has("target")) {
    table.fail("target", "a cut to another camera has no 'target'");
  }
  if (toCamera) path.cutCamera = readCameraName(table);
  path.cutDegrees = table.getNumber("degrees", 0.0, -360.0, 360.0);
}

CameraKeyframe readKeyframe(const ConfigTable& table) {
  CameraKeyframe key;
  key.place = table.place();
  key.frame = getFrame(table, "a keyframe");
  const bool ofCamera = table.has("camera");
  if (ofCamera == (table.has("position") || table.has("target"))) {
    table.fail(ofCamera ? "camera" : "",
               "a keyframe needs either 'camera' or 'position' and 'target', and not both");
  }
  if (ofCamera) {
    key.camera = readCameraName(table);
  } else {
    for (const char* point : {"position", "target"}) {
      require(table, "a keyframe without 'camera'", point);
    }
    key.positionW = getPoint(table, "position");
    key.targetW = getPoint(table, "target");
  }
  if (table.has("yfov_degrees")) {
    key.yfov = radians(table.getNumber("yfov_degrees", 0.0, 0.01, 179.0));
  }
  table.finish();
  return key;
}

}  // namespace

std::string readCameraName(const ConfigTable& table) {
  const std::vector<std::string> texts = table.getTexts("camera");
  const bool isIndex = texts.size() == 1 && !texts[0].empty() &&
                       texts[0].find_first_not_of("0123456789") == std::string::npos;
  if (isIndex) return texts[0];
  std::string name = table.getString("camera", "");
  if (name.empty()) table.fail("camera", "'camera' is empty");
  return name;
}

CameraPath parseCameraPath(const ConfigTable& table) {
  CameraPath path;
  path.place = table.place();
  if (!table.has("kind")) {
    table.fail("", fmt::format("a camera path needs a 'kind' ({})", fmt::join(kKinds, ", ")));
  }
  const std::string kind = table.getChoice("kind", "", kKinds);
  path.kind = CameraPathKind(std::find(kKinds.begin(), kKinds.end(), kind) - kKinds.begin());
  const std::string what = fmt::format("a camera path of the kind '{}'", kind);
  const bool isOrbit = path.kind == CameraPathKind::orbit;
  if (isOrbit || path.kind == CameraPathKind::pan) {
    require(table, what, "degrees_per_frame");
    path.degreesPerFrame = table.getNumber("degrees_per_frame", 0.0, -180.0, 180.0);
  }
  if (path.kind == CameraPathKind::dolly) {
    require(table, what, "metres_per_frame");
    path.metresPerFrame = table.getNumber("metres_per_frame", 0.0, -kMaxMetres, kMaxMetres);
  }
  const bool walks = path.kind == CameraPathKind::still || path.kind == CameraPathKind::dolly;
  const bool isCutToCamera = path.kind == CameraPathKind::cut && table.has("camera");
  if (table.has("about") && (walks || isCutToCamera)) {
    table.fail("about", isCutToCamera ? "a cut to another camera turns about nothing"
                                      : what + " turns about nothing");
  }
  if (!walks) {
    // "world" is glTF's up and the oldest of these names.
    const std::string about = table.getChoice("about", "scene", kAxes);
    path.about = about == "scene"    ? CameraAxis::scene
                 : about == "camera" ? CameraAxis::camera
                 : about == "x"      ? CameraAxis::x
                 : about == "z"      ? CameraAxis::z
                                     : CameraAxis::y;
  }
  if (path.kind == CameraPathKind::cut) readCut(table, path);
  if (path.kind == CameraPathKind::back) {
    path.cutFrame = getFrame(table, what);
    path.cutDegrees = table.getNumber("degrees", 180.0, -360.0, 360.0);
    path.leaveFrame = uint32_t(table.getInteger("leave", 0, 0, kMaxFrame));
    if (path.leaveFrame >= std::max(path.cutFrame, 1u)) {
      table.fail("leave", fmt::format("'leave' is {}: the camera must leave before it comes back, "
                                      "in frame {}",
                                      path.leaveFrame, path.cutFrame));
    }
  }
  if ((isOrbit || path.kind == CameraPathKind::cut) && table.has("target")) {
    path.targetW = getPoint(table, "target");
  }
  if (path.kind == CameraPathKind::keyframes) {
    for (const ConfigTable& key : table.getTables("keyframe")) {
      path.keyframes.push_back(readKeyframe(key));
      const size_t count = path.keyframes.size();
      if (count > 1 && path.keyframes[count - 1].frame <= path.keyframes[count - 2].frame) {
        key.fail("frame",
                 fmt::format("frame {} comes after frame {}: keyframes stand in the order "
                             "of their frames",
                             path.keyframes[count - 1].frame, path.keyframes[count - 2].frame));
      }
    }
    if (path.keyframes.empty()) table.fail("", what + " needs [[keyframe]]");
  }
  table.finish();
  return path;
}

}  // namespace restlab
