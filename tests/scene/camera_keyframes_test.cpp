// Keyframes: exact at their frames, continuous in between, with errors for keyframes that cannot be
// interpolated.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/scene/camera_path/camera_path.h"
#include "tests/scene/camera_checks.h"

namespace restlab {

namespace {

Scene scene() {
  Scene scene;
  scene.name = "nothing";
  scene.cameras = {cameraAtPoint("start", {0, 1, 5}, {0, 1, 0}),
                   cameraAtPoint("rolled", {4, 2, -3}, {1, 0, 0}, {0.5, 1, 0.1}),
                   cameraAtPoint("flat", {9, 9, 9}, {0, 0, 0})};
  scene.cameras[1].yfov = 1.1;
  scene.cameras[2].kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  scene.cameras[2].xmag = 3.0;
  scene.cameras[2].ymag = 2.0;
  SceneCamera wide = cameraAtPoint("wide", {9, 9, 7}, {0, 0, 0});
  wide.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  wide.xmag = 6.0;
  wide.ymag = 4.0;
  scene.cameras.push_back(wide);
  return scene;
}

CameraKeyframe key(uint32_t frame, const glm::dvec3& eye, const glm::dvec3& target) {
  CameraKeyframe result;
  result.frame = frame;
  result.positionW = eye;
  result.targetW = target;
  return result;
}

CameraKeyframe key(uint32_t frame, const char* camera) {
  CameraKeyframe result;
  result.frame = frame;
  result.camera = camera;
  return result;
}

CameraMotion motionOf(std::vector<CameraKeyframe> keys, uint32_t start = 0) {
  CameraPath path;
  path.kind = CameraPathKind::keyframes;
  path.keyframes = std::move(keys);
  return resolveCameraPath(path, scene(), start);
}

TEST(CameraKeyframes, AreMetExactly) {
  const CameraMotion motion = motionOf(
      {key(5, {1, 2, 3}, {0, 1, 0}), key(8, "rolled"), key(1000, {-4, 0.5, 2}, {7, 7, 7})});
  const SceneCamera first = cameraAt(motion, 5), middle = cameraAt(motion, 8),
                    last = cameraAt(motion, 1000);
  EXPECT_EQ(positionOf(first), glm::dvec3(1, 2, 3));
  EXPECT_LT(glm::distance(forward(first), glm::normalize(glm::dvec3(-1, -1, -3))), 1e-15);
  EXPECT_EQ(first.cameraToWorld[0].y, 0.0) << "upright";
  EXPECT_GT(first.cameraToWorld[1].y, 0.0) << "and not upside down";
  EXPECT_EQ(first.yfov, 0.7) << "of the camera that the path starts with";
  EXPECT_EQ(middle.cameraToWorld, scene().cameras[1].cameraToWorld);
  EXPECT_EQ(middle.yfov, 1.1);
  EXPECT_EQ(middle.name, "start");
  EXPECT_EQ(positionOf(last), glm::dvec3(-4, 0.5, 2));
  // The camera stands still before the first and after the last keyframe.
  for (const uint32_t frame : {0u, 4u}) {
    EXPECT_EQ(cameraAt(motion, frame).cameraToWorld, first.cameraToWorld);
  }
  for (const uint32_t frame : {1001u, 4000000000u}) {
    EXPECT_EQ(cameraAt(motion, frame).cameraToWorld, last.cameraToWorld);
  }
}

TEST(CameraKeyframes, OneIsAStillCamera) {
  const CameraMotion motion = motionOf({key(7, "rolled")});
  for (const uint32_t frame : {0u, 7u, 20u}) {
    EXPECT_EQ(cameraAt(motion, frame).cameraToWorld, scene().cameras[1].cameraToWorld);
  }
}

TEST(CameraKeyframes, PositionsAndFieldsOfViewAreLinear) {
  CameraKeyframe narrow = key(20, {8, 2, -2}, {0, 0, 0});
  narrow.yfov = 0.3;
  const CameraMotion motion = motionOf({key(10, {2, 0, 3}, {0, 0, 0}), narrow, key(40, "rolled")});
  const SceneCamera quarter = cameraAt(motion, 12);
  EXPECT_LT(glm::distance(positionOf(quarter), {3.2, 0.4, 2.0}), 1e-12);
  EXPECT_NEAR(quarter.yfov, 0.62, 1e-12);
  EXPECT_LT(glm::distance(positionOf(cameraAt(motion, 30)), {6, 2, -2.5}), 1e-12);
  EXPECT_NEAR(cameraAt(motion, 30).yfov, 0.7, 1e-12);
}

TEST(CameraKeyframes, ASharedTargetStaysInTheMiddle) {
  const glm::dvec3 target(0.5, 1.25, -2.0);
  const CameraMotion motion = motionOf(
      {key(0, {5, 1, 5}, target), key(100, {-5, 3, 4}, target), key(150, {1, 6, 1}, target)});
  for (uint32_t frame = 0; frame <= 150; ++frame) {
    const SceneCamera camera = cameraAt(motion, frame);
    expectOrthonormal(camera);
    EXPECT_LT(glm::distance(forward(camera), glm::normalize(target - positionOf(camera))), 1e-14);
    EXPECT_NEAR(camera.cameraToWorld[0].y, 0.0, 1e-15) << "upright";
  }
}

TEST(CameraKeyframes, TargetsAreLinear) {
  const CameraMotion motion =
      motionOf({key(0, {5, 1, 5}, {0, 1, 0}), key(4, {5, 1, 5}, {4, 1, 2})});
  EXPECT_LT(glm::distance(forward(cameraAt(motion, 1)), glm::normalize(glm::dvec3(-4, 0, -4.5))),
            1e-14);
}

// The step between two frames is a small part of the whole way: no jump at a keyframe or anywhere
// else.
TEST(CameraKeyframes, AreContinuous) {
  const CameraMotion motion =
      motionOf({key(1000, {1, 2, 3}, {0, 1, 0}), key(3000, "rolled"), key(4000, "start"),
                key(6000, {-4, 0.5, 2}, {7, 7, 7}), key(9000, {-4, 5, 2}, {0, 1, 0})});
  for (uint32_t frame = 900; frame < 9100; ++frame) {
    const SceneCamera a = cameraAt(motion, frame), b = cameraAt(motion, frame + 1);
    expectOrthonormal(b);
    for (int column = 0; column < 4; ++column) {
      ASSERT_LT(glm::distance(a.cameraToWorld[column], b.cameraToWorld[column]), 0.012) << frame;
    }
    ASSERT_LT(std::abs(a.yfov - b.yfov), 1e-3) << frame;
  }
}

TEST(CameraKeyframes, TurnEvenlyAndTheShorterWay) {
  Scene turning = scene();
  // 160 degrees to the left and 170 to the right of -Z: 30 degrees apart, across +Z.
  const auto lookingTo = [](const char* name, double degrees) {
    const double angle = glm::radians(degrees);
    return cameraAtPoint(name, {0, 1, 0}, {-std::sin(angle), 1, -std::cos(angle)});
  };
  turning.cameras = {lookingTo("start", 160.0), lookingTo("end", -170.0)};
  CameraPath path;
  path.kind = CameraPathKind::keyframes;
  path.keyframes = {key(0, "start"), key(30, "end")};
  const CameraMotion motion = resolveCameraPath(path, turning, 0);
  for (uint32_t frame = 0; frame <= 30; ++frame) {
    const glm::dvec3 wanted = forward(lookingTo("", 160.0 + frame));
    EXPECT_LT(glm::distance(forward(cameraAt(motion, frame)), wanted), 1e-12) << frame;
  }
}

TEST(CameraKeyframes, OrthographicExtentsAreLinear) {
  const CameraMotion motion = motionOf({key(0, "flat"), key(10, "wide")}, 2);
  const SceneCamera camera = cameraAt(motion, 5);
  EXPECT_EQ(camera.kind, rl::RL_CAMERA_ORTHOGRAPHIC);
  EXPECT_NEAR(camera.xmag, 4.5, 1e-12);
  EXPECT_NEAR(camera.ymag, 3.0, 1e-12);
}

std::string messageOf(const std::vector<CameraKeyframe>& keys, uint32_t frame = 0,
                      uint32_t start = 0) {
  try {
    cameraAt(motionOf(keys, start), frame);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badUsage);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

TEST(CameraKeyframes, WhatCannotBeIsSaid) {
  EXPECT_EQ(messageOf({}), "camera path: the camera path has no keyframe");
  EXPECT_EQ(messageOf({key(5, "start"), key(5, "rolled")}),
            "keyframe 1: the keyframe of frame 5 comes after that of frame 5");
  EXPECT_EQ(messageOf({key(5, "start"), key(9, "flat")}),
            "keyframe 1: one path has perspective and orthographic cameras");
  EXPECT_EQ(messageOf({key(0, {1, 2, 3}, {1, 2, 3})}),
            "keyframe 0: the camera stands in its target");
  const std::string down = messageOf({key(0, {1, 2, 3}, {1, 0, 3})});
  EXPECT_EQ(down.rfind("keyframe 0: the camera looks straight down at its target", 0), 0u) << down;
  EXPECT_NE(messageOf({key(0, {1, 2, 3}, {1, 8, 3})}).find("straight up"), std::string::npos);
  CameraKeyframe placed = key(0, "rollled");
  placed.place = "suite.toml:9:3";
  EXPECT_EQ(messageOf({placed}).rfind("suite.toml:9:3: camera 'rollled'", 0), 0u);
  CameraKeyframe flat = key(0, "flat");
  flat.yfov = 0.5;
  EXPECT_EQ(messageOf({flat}), "keyframe 0: an orthographic camera has no field of view");
}

TEST(CameraKeyframes, ATargetThatIsWalkedThroughIsSaid) {
  const std::vector<CameraKeyframe> keys = {key(0, {0, 1, 2}, {0, 1, 0}),
                                            key(4, {0, 1, -2}, {0, 1, 0})};
  EXPECT_EQ(cameraAt(motionOf(keys), 1).cameraToWorld[3].z, 1.0);
  EXPECT_EQ(messageOf(keys, 2),
            "keyframe 1: at frame 2, before this keyframe: the camera stands in its target");
}

}  // namespace

}  // namespace restlab
