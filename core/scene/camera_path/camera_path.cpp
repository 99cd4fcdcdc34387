#include "core/scene/camera_path/camera_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/base/error.h"

namespace restlab {

namespace {

// The sine of the angle between view and vertical below which no upright camera is defined.
constexpr double kVertical = 1e-6;

// Right, up, back: orthonormal, derived as kernels do from a matrix that may be scaled.
glm::dmat3 basisOf(const SceneCamera& camera) {
  const glm::dvec3 back = glm::normalize(glm::dvec3(camera.cameraToWorld[2]));
  const glm::dvec3 up =
      glm::normalize(glm::cross(back, glm::normalize(glm::dvec3(camera.cameraToWorld[0]))));
  return glm::dmat3(glm::cross(up, back), up, back);
}

glm::dmat4 matrixOf(const glm::dmat3& basis, const glm::dvec3& positionW) {
  glm::dmat4 matrix(basis);
  matrix[3] = glm::dvec4(positionW, 1.0);
  return matrix;
}

// Turns the camera about an axis through a point. Multiples of 360 degrees return identical bits.
SceneCamera turned(const SceneCamera& camera, const glm::dvec3& pointW, const glm::dvec3& axisW,
                   double degrees) {
  const double angle = std::fmod(degrees, 360.0);
  if (angle == 0.0) return camera;
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), glm::radians(angle), axisW));
  SceneCamera result = camera;
  for (int column = 0; column < 3; ++column) {
    result.cameraToWorld[column] = glm::dvec4(turn * glm::dvec3(camera.cameraToWorld[column]), 0.0);
  }
  result.cameraToWorld[3] = glm::dvec4(pointW + turn * (positionOf(camera) - pointW), 1.0);
  return result;
}

SceneCamera walked(const SceneCamera& camera, double metres) {
  if (metres == 0.0) return camera;
  SceneCamera result = camera;
  result.cameraToWorld[3] = glm::dvec4(positionOf(camera) - basisOf(camera)[2] * metres, 1.0);
  return result;
}

// Makes an upright camera with the other properties of `like`. `place` starts the error text.
SceneCamera lookingAt(const SceneCamera& like, const glm::dvec3& positionW,
                      const glm::dvec3& targetW, const glm::dvec3& upW, const std::string& place) {
  const glm::dvec3 view = positionW - targetW;
  const double distance = glm::length(view);
  if (!(distance > 0.0)) failUsage(fmt::format("{}: the camera stands in its target", place));
  const glm::dvec3 back = view / distance, side = glm::cross(upW, back);
  if (!(glm::length(side) > kVertical)) {
    failUsage(
        fmt::format("{}: the camera looks straight {} at its target, where upright means nothing; "
                    "move it aside, or give a camera",
                    place, glm::dot(back, upW) > 0.0 ? "down" : "up"));
  }
  const glm::dvec3 right = glm::normalize(side);
  SceneCamera camera = like;
  camera.cameraToWorld = matrixOf(glm::dmat3(right, glm::cross(back, right), back), positionW);
  return camera;
}

SceneCamera named(const Scene& scene, const std::string& name, const std::string& place) {
  try {
    return scene.cameras.at(findCamera(scene, name));
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", place, error.what()));
  }
}

SceneCamera keyCamera(const CameraKeyframe& key, const Scene& scene, const SceneCamera& start,
                      const glm::dvec3& upW) {
  SceneCamera camera = key.camera.empty()
                           ? lookingAt(start, key.positionW, key.targetW, upW, key.place)
                           : named(scene, key.camera, key.place);
  if (key.yfov && camera.kind == rl::RL_CAMERA_ORTHOGRAPHIC) {
    failUsage(fmt::format("{}: an orthographic camera has no field of view", key.place));
  }
  if (key.yfov) camera.yfov = *key.yfov;
  camera.name = start.name;
  camera.aspect = start.aspect;
  return camera;
}

void resolveKeyframes(CameraMotion& motion, const Scene& scene) {
  CameraPath& path = motion.path;
  if (path.keyframes.empty()) failUsage(path.place + ": the camera path has no keyframe");
  for (size_t i = 0; i < path.keyframes.size(); ++i) {
    CameraKeyframe& key = path.keyframes[i];
    if (key.place.empty()) key.place = fmt::format("keyframe {}", i);
    if (i > 0 && key.frame <= path.keyframes[i - 1].frame) {
      failUsage(fmt::format("{}: the keyframe of frame {} comes after that of frame {}", key.place,
                            key.frame, path.keyframes[i - 1].frame));
    }
    motion.keyCameras.push_back(keyCamera(key, scene, motion.start, motion.upW));
    if (motion.keyCameras[i].kind != motion.keyCameras[0].kind) {
      failUsage(fmt::format("{}: one path has perspective and orthographic cameras", key.place));
    }
  }
}

// Interpolates between two keyframes, at `t` in (0, 1).
SceneCamera between(const CameraMotion& motion, size_t first, double t, uint32_t frame) {
  const CameraKeyframe &keyA = motion.path.keyframes[first],
                       &keyB = motion.path.keyframes[first + 1];
  const SceneCamera &a = motion.keyCameras[first], &b = motion.keyCameras[first + 1];
  SceneCamera camera = a;
  camera.yfov = glm::mix(a.yfov, b.yfov, t);
  camera.xmag = glm::mix(a.xmag, b.xmag, t);
  camera.ymag = glm::mix(a.ymag, b.ymag, t);
  camera.shift = glm::mix(a.shift, b.shift, t);
  const glm::dvec3 positionW = glm::mix(positionOf(a), positionOf(b), t);
  if (keyA.camera.empty() && keyB.camera.empty()) {
    return lookingAt(camera, positionW, glm::mix(keyA.targetW, keyB.targetW, t), motion.upW,
                     fmt::format("{}: at frame {}, before this keyframe", keyB.place, frame));
  }
  const glm::dquat turn =
      glm::slerp(glm::quat_cast(basisOf(a)), glm::quat_cast(basisOf(b)), t);  // the shorter way
  camera.cameraToWorld = matrixOf(glm::mat3_cast(glm::normalize(turn)), positionW);
  return camera;
}

SceneCamera keyframed(const CameraMotion& motion, uint32_t frame) {
  const std::vector<CameraKeyframe>& keys = motion.path.keyframes;
  const auto after = std::upper_bound(
      keys.begin(), keys.end(), frame,
      [](uint32_t wanted, const CameraKeyframe& key) { return wanted < key.frame; });
  if (after == keys.begin()) return motion.keyCameras.front();
  const size_t first = size_t(after - keys.begin()) - 1;
  if (after == keys.end() || keys[first].frame == frame) return motion.keyCameras[first];
  const double t = double(frame - keys[first].frame) / double(after->frame - keys[first].frame);
  return between(motion, first, t, frame);
}

glm::dvec3 axisOf(CameraAxis about, const SceneCamera& camera) {
  switch (about) {
    case CameraAxis::scene:
      return sceneUp(camera);
    case CameraAxis::camera:
      return basisOf(camera)[1];
    case CameraAxis::x:
      return {1.0, 0.0, 0.0};
    case CameraAxis::y:
      return {0.0, 1.0, 0.0};
    case CameraAxis::z:
      return {0.0, 0.0, 1.0};
  }
  return {0.0, 1.0, 0.0};
}

}  // namespace

glm::dvec3 sceneUp(const SceneCamera& camera) {
  constexpr double kCosFarOff = 0.5, kCosNear = 0.70710678118654752;  // 60 and 45 degrees
  const glm::dvec3 up = basisOf(camera)[1];
  if (up.y >= kCosFarOff) return {0.0, 1.0, 0.0};
  return up.z > kCosNear ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
}

CameraMotion resolveCameraPath(const CameraPath& path, const Scene& scene, uint32_t camera) {
  CameraMotion motion;
  motion.path = path;
  motion.start = scene.cameras.at(camera);
  if (motion.path.place.empty()) motion.path.place = "camera path";
  motion.upW = axisOf(path.about, motion.start);
  const bool cutsByAngle = path.kind == CameraPathKind::cut && path.cutCamera.empty();
  if (path.kind == CameraPathKind::orbit || cutsByAngle) {
    motion.targetW = path.targetW ? *path.targetW : pointLookedAt(scene, motion.start);
  }
  if (path.kind == CameraPathKind::cut) {
    motion.afterCut = cutsByAngle
                          ? turned(motion.start, motion.targetW, motion.upW, path.cutDegrees)
                          : named(scene, path.cutCamera, motion.path.place);
    motion.afterCut.name = motion.start.name;
    motion.afterCut.aspect = motion.start.aspect;
  }
  if (path.kind == CameraPathKind::keyframes) resolveKeyframes(motion, scene);
  return motion;
}

SceneCamera cameraAt(const CameraMotion& motion, uint32_t frame) {
  const CameraPath& path = motion.path;
  const SceneCamera& start = motion.start;
  switch (path.kind) {
    case CameraPathKind::still:
      return start;
    case CameraPathKind::orbit:
      return turned(start, motion.targetW, motion.upW, path.degreesPerFrame * frame);
    case CameraPathKind::dolly:
      return walked(start, path.metresPerFrame * frame);
    case CameraPathKind::pan:
      return turned(start, positionOf(start), motion.upW, path.degreesPerFrame * frame);
    case CameraPathKind::cut:
      return frame < path.cutFrame ? start : motion.afterCut;
    case CameraPathKind::back:
      return frame >= path.leaveFrame && frame < path.cutFrame
                 ? turned(start, positionOf(start), motion.upW, path.cutDegrees)
                 : start;
    case CameraPathKind::keyframes:
      return keyframed(motion, frame);
  }
  return start;
}

std::optional<uint32_t> firstStillFrame(const CameraPath& path) {
  if (path.kind == CameraPathKind::still) return 0;
  if (path.kind == CameraPathKind::cut || path.kind == CameraPathKind::back) return path.cutFrame;
  return std::nullopt;
}

}  // namespace restlab
