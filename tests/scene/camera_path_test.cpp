// Camera paths: positions, invariants, and no error that accumulates over frames.
#include "core/scene/camera_path/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/base/error.h"
#include "tests/scene/camera_checks.h"

namespace restlab {

namespace {

constexpr double kTiny = 1e-12;

glm::dvec3 up(const SceneCamera& camera) {
  return glm::normalize(glm::dvec3(camera.cameraToWorld[1]));
}

// Upright cameras, a rolled one, and one that looks almost straight down.
const std::vector<SceneCamera> kCameras = {
    cameraAtPoint("start", {0, 0, 5}, {0, 0, 0}),
    cameraAtPoint("start", {1, 2, 3}, {-4, 0.5, 7}),
    cameraAtPoint("start", {-3, 8, 2}, {1, -1, 0}, {0.4, 1, -0.2}),
    cameraAtPoint("start", {100, 1000, -20}, {100, 0, -20.1}),
};

// A floor at y = 0, `camera`, and two more cameras.
Scene sceneWith(const SceneCamera& camera) {
  Scene scene;
  scene.name = "floor";
  MeshGeometry quad;
  quad.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  quad.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.geometries = {quad};
  MeshInstance floor;
  floor.objectToWorld = glm::scale(glm::dmat4(1.0), glm::dvec3(50.0, 1.0, 50.0));
  scene.instances = {floor};
  SceneCamera other = cameraAtPoint("start", {7, 1, 7}, {0, 2, 0});
  other.name = "other";
  other.yfov = 1.1;
  other.aspect = 2.0;
  SceneCamera flat = other;
  flat.name = "flat";
  flat.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  scene.cameras = {camera, other, flat};
  return scene;
}

CameraMotion motionOf(const CameraPath& path, const SceneCamera& camera = kCameras[1]) {
  return resolveCameraPath(path, sceneWith(camera), 0);
}

CameraPath pathOf(CameraPathKind kind, double perFrame = 0.0) {
  CameraPath path;
  path.kind = kind;
  path.degreesPerFrame = path.metresPerFrame = perFrame;
  return path;
}

TEST(CameraPath, StillIsTheCamera) {
  const CameraMotion motion = motionOf(pathOf(CameraPathKind::still));
  for (const uint32_t frame : {0u, 1u, 4000000000u}) {
    EXPECT_EQ(cameraAt(motion, frame).cameraToWorld, kCameras[1].cameraToWorld);
  }
}

TEST(CameraPath, OrbitKeepsWhatIsOnItsAxisWhereItIs) {
  const glm::dvec3 target(-2.0, 1.5, 0.25);
  for (const SceneCamera& start : kCameras) {
    CameraPath path = pathOf(CameraPathKind::orbit, 0.7);
    path.targetW = target;
    const CameraMotion motion = motionOf(path, start);
    const glm::dvec3 seen = glm::inverse(start.cameraToWorld) * glm::dvec4(target, 1.0);
    const double distance = glm::distance(positionOf(start), target);
    for (uint32_t frame = 0; frame < 3000; frame += 7) {
      const SceneCamera camera = cameraAt(motion, frame);
      expectOrthonormal(camera);
      EXPECT_NEAR(glm::distance(positionOf(camera), target), distance, kTiny * distance);
      EXPECT_NEAR(positionOf(camera).y, positionOf(start).y, kTiny * distance);
      const glm::dvec3 sees = glm::inverse(camera.cameraToWorld) * glm::dvec4(target, 1.0);
      EXPECT_LT(glm::distance(sees, seen), 1e-9 * distance);
    }
  }
}

TEST(CameraPath, OrbitGoesAnticlockwiseSeenFromAbove) {
  CameraPath path = pathOf(CameraPathKind::orbit, 30.0);
  path.targetW = glm::dvec3(0.0);
  const SceneCamera camera = cameraAt(motionOf(path, kCameras[0]), 3);
  EXPECT_LT(glm::distance(positionOf(camera), {5, 0, 0}), kTiny);
  EXPECT_LT(glm::distance(forward(camera), {-1, 0, 0}), kTiny);
  EXPECT_LT(glm::distance(up(camera), {0, 1, 0}), kTiny);
}

TEST(CameraPath, NothingDrifts) {
  // 0.1 is not a binary fraction: sums of it are off by 1e-10 after a million frames.
  for (const CameraPathKind kind : {CameraPathKind::orbit, CameraPathKind::pan}) {
    CameraPath path = pathOf(kind, 0.1);
    path.targetW = glm::dvec3(3, 2, 1);
    const CameraMotion motion = motionOf(path, kCameras[2]);
    for (const uint32_t frame : {0u, 3600u, 36000000u}) {
      EXPECT_EQ(cameraAt(motion, frame).cameraToWorld, kCameras[2].cameraToWorld) << frame;
    }
    const SceneCamera early = cameraAt(motion, 17), late = cameraAt(motion, 17 + 3600 * 300);
    for (int column = 0; column < 4; ++column) {
      EXPECT_LT(glm::distance(early.cameraToWorld[column], late.cameraToWorld[column]), 1e-9);
    }
  }
}

TEST(CameraPath, DollyWalksAlongTheView) {
  for (const SceneCamera& start : kCameras) {
    SceneCamera scaled = start;
    for (int column = 0; column < 3; ++column) scaled.cameraToWorld[column] *= 3.0;
    for (const double metres : {0.25, -0.5}) {
      for (const SceneCamera& camera : {start, scaled}) {
        const CameraMotion motion = motionOf(pathOf(CameraPathKind::dolly, metres), camera);
        EXPECT_EQ(cameraAt(motion, 0).cameraToWorld, camera.cameraToWorld);
        const SceneCamera moved = cameraAt(motion, 40);
        EXPECT_LT(
            glm::distance(positionOf(moved), positionOf(start) + forward(start) * 40.0 * metres),
            1e-10);
        EXPECT_EQ(glm::dmat3(moved.cameraToWorld), glm::dmat3(camera.cameraToWorld));
      }
    }
  }
}

TEST(CameraPath, PanTurnsOnTheSpot) {
  for (const SceneCamera& start : kCameras) {
    CameraPath path = pathOf(CameraPathKind::pan, 1.3);
    for (const bool aboutCameraUp : {false, true}) {
      path.about = aboutCameraUp ? CameraAxis::camera : CameraAxis::y;
      const CameraMotion motion = motionOf(path, start);
      const glm::dvec3 axis = aboutCameraUp ? up(start) : glm::dvec3(0, 1, 0);
      for (uint32_t frame = 1; frame < 400; frame += 9) {
        const SceneCamera camera = cameraAt(motion, frame);
        expectOrthonormal(camera);
        EXPECT_EQ(positionOf(camera), positionOf(start));
        EXPECT_NEAR(glm::dot(forward(camera), axis), glm::dot(forward(start), axis), kTiny);
        EXPECT_NEAR(glm::dot(up(camera), axis), glm::dot(up(start), axis), kTiny);
      }
    }
  }
  // A turn to the left goes from -Z to -X.
  const SceneCamera left = cameraAt(motionOf(pathOf(CameraPathKind::pan, 45.0), kCameras[0]), 2);
  EXPECT_LT(glm::distance(forward(left), {-1, 0, 0}), kTiny);
}

// Only the cameras of a scene show that its up is +Z: turns are about +Z, without roll.
TEST(CameraPath, TurnsAboutTheUpOfTheScene) {
  const SceneCamera start = cameraAtPoint("start", {4, -3, 1.5}, {0, 0, 1}, {0, 0, 1});
  EXPECT_EQ(sceneUp(start), glm::dvec3(0, 0, 1));
  for (const SceneCamera& camera : kCameras) EXPECT_EQ(sceneUp(camera), glm::dvec3(0, 1, 0));
  CameraPath back = pathOf(CameraPathKind::back);
  back.cutFrame = 8;
  back.cutDegrees = 130.0;
  CameraPath orbit = pathOf(CameraPathKind::orbit, 7.0);
  orbit.targetW = glm::dvec3(0, 0, 1);
  for (const CameraPath& path : {orbit, pathOf(CameraPathKind::pan, 7.0), back}) {
    const SceneCamera camera = cameraAt(motionOf(path, start), 5);
    EXPECT_NE(forward(camera), forward(start));
    EXPECT_NEAR(forward(camera).z, forward(start).z, kTiny) << "the horizon stays level";
    EXPECT_NEAR(up(camera).z, up(start).z, kTiny);
    EXPECT_NEAR(positionOf(camera).z, positionOf(start).z, kTiny);
    CameraPath aboutY = path;
    aboutY.about = CameraAxis::y;
    const SceneCamera other = cameraAt(motionOf(aboutY, start), 5);
    EXPECT_NEAR(up(other).y, up(start).y, kTiny);
    EXPECT_GT(std::abs(forward(other).z - forward(start).z), 0.01);
  }
  CameraPath keys = pathOf(CameraPathKind::keyframes);
  keys.keyframes.resize(2);
  keys.keyframes[0].positionW = {4, -3, 1.5};
  keys.keyframes[1].positionW = {-4, -3, 1.5};
  keys.keyframes[1].frame = 10;
  const SceneCamera between = cameraAt(motionOf(keys, start), 4);
  EXPECT_GT(up(between).z, 0.9) << "upright";
}

TEST(CameraPath, TurnsAreEven) {
  // Angle between consecutive frames, for a camera that turns about its own up.
  CameraPath path = pathOf(CameraPathKind::pan, 0.5);
  path.about = CameraAxis::camera;
  const CameraMotion motion = motionOf(path, kCameras[2]);
  for (uint32_t frame = 0; frame < 1500; frame += 11) {
    const glm::dvec3 a = forward(cameraAt(motion, frame)), b = forward(cameraAt(motion, frame + 1));
    EXPECT_NEAR(std::asin(glm::length(glm::cross(a, b))), glm::radians(0.5), 1e-10);
  }
}

TEST(CameraPath, CutIsAtItsFrame) {
  CameraPath path = pathOf(CameraPathKind::cut);
  path.cutFrame = 10;
  for (const char* name : {"other", "1"}) {
    path.cutCamera = name;
    const CameraMotion motion = motionOf(path);
    for (const uint32_t frame : {0u, 9u}) {
      EXPECT_EQ(cameraAt(motion, frame).cameraToWorld, kCameras[1].cameraToWorld);
      EXPECT_EQ(cameraAt(motion, frame).yfov, 0.7);
    }
    for (const uint32_t frame : {10u, 11u, 1000u}) {
      const SceneCamera camera = cameraAt(motion, frame);
      EXPECT_EQ(camera.cameraToWorld, sceneWith(kCameras[1]).cameras[1].cameraToWorld);
      EXPECT_EQ(camera.yfov, 1.1);
      EXPECT_EQ(camera.aspect, 1.5) << "the film keeps its shape";
    }
  }
  path.cutCamera = "";
  path.cutDegrees = 25.0;
  path.targetW = glm::dvec3(1, 0, -1);
  CameraPath orbit = pathOf(CameraPathKind::orbit, 25.0);
  orbit.targetW = path.targetW;
  EXPECT_EQ(cameraAt(motionOf(path), 9).cameraToWorld, kCameras[1].cameraToWorld);
  EXPECT_EQ(cameraAt(motionOf(path), 10).cameraToWorld, cameraAt(motionOf(orbit), 1).cameraToWorld);
}

TEST(CameraPath, BackIsTurnedAwayAndThenTheScenesCamera) {
  CameraPath path = pathOf(CameraPathKind::back);
  path.cutFrame = 10;
  path.cutDegrees = 180.0;
  const CameraMotion motion = motionOf(path);
  const glm::dmat4 start = kCameras[1].cameraToWorld;
  for (const uint32_t frame : {0u, 9u}) {
    const glm::dmat4 away = cameraAt(motion, frame).cameraToWorld;
    EXPECT_EQ(away[3], start[3]) << "it turns where it stands";
    EXPECT_NEAR(away[2].x, -start[2].x, 1e-12);
    EXPECT_NEAR(away[2].y, start[2].y, 1e-12);
    EXPECT_NEAR(away[2].z, -start[2].z, 1e-12);
  }
  for (const uint32_t frame : {10u, 11u, 1000u})
    EXPECT_EQ(cameraAt(motion, frame).cameraToWorld, start);
  EXPECT_EQ(firstStillFrame(path), 10u);
  EXPECT_EQ(firstStillFrame(pathOf(CameraPathKind::still)), 0u);
  EXPECT_FALSE(firstStillFrame(pathOf(CameraPathKind::orbit)).has_value());

  path.leaveFrame = 4;
  const CameraMotion thereAndBack = motionOf(path);
  for (const uint32_t frame : {0u, 3u, 10u})
    EXPECT_EQ(cameraAt(thereAndBack, frame).cameraToWorld, start);
  for (const uint32_t frame : {4u, 9u})
    EXPECT_EQ(cameraAt(thereAndBack, frame).cameraToWorld, cameraAt(motion, 9).cameraToWorld);
}

TEST(CameraAim, IsTheFirstSurface) {
  const SceneCamera camera = cameraAtPoint("start", {1, 4, 3}, {-2, 0, 1});
  Scene scene = sceneWith(camera);
  EXPECT_LT(glm::distance(pointLookedAt(scene, camera), {-2, 0, 1}), 1e-12);
  // A second instance, moved and mirrored, in front of the first.
  MeshInstance shelf;
  shelf.objectToWorld = glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5, 2.0, 2.0)),
                                   glm::dvec3(-0.5, 1.0, 0.5));
  scene.instances.push_back(shelf);
  EXPECT_LT(glm::distance(pointLookedAt(scene, camera), {-0.5, 2, 2}), 1e-12);
  // Surfaces behind the camera do not count.
  scene.instances[0].objectToWorld = glm::translate(glm::dmat4(1.0), glm::dvec3(4, 8, 5));
  EXPECT_LT(glm::distance(pointLookedAt(scene, camera), {-0.5, 2, 2}), 1e-12);
  // A triangle ends at its edges: the middle of its bounds is 1 m below it.
  Scene triangle = sceneWith(camera);
  triangle.geometries[0].triangles.pop_back();
  triangle.geometries[0].positions[3].y = -2.0f;
  triangle.instances[0].objectToWorld = glm::dmat4(1.0);
  for (const glm::dvec3& seen : {glm::dvec3(0.5, 0.0, -0.5), glm::dvec3(-0.5, -1.0, 0.5),
                                 glm::dvec3(1.5, -1.0, 0.5), glm::dvec3(0.5, -1.0, -1.5)}) {
    const SceneCamera above = cameraAtPoint("start", {seen.x, 3, seen.z}, seen, {0, 0, 1});
    EXPECT_LT(glm::distance(pointLookedAt(triangle, above), seen), 1e-12) << seen.x;
  }
}

TEST(CameraAim, WhereThereIsNoSurface) {
  // Past the floor, whose middle is the origin: the nearest point of the axis counts.
  const SceneCamera past = cameraAtPoint("start", {-3, 4, 2}, {5, 4, 2});
  EXPECT_LT(glm::distance(pointLookedAt(sceneWith(past), past), {0, 4, 2}), 1e-12);
  // Away from the floor: a point as far ahead as the floor's diagonal counts.
  const SceneCamera away = cameraAtPoint("start", {60, 4, 0}, {61, 4, 0});
  EXPECT_LT(
      glm::distance(pointLookedAt(sceneWith(away), away), {60.0 + 100.0 * std::sqrt(2.0), 4, 0}),
      1e-9);
  EXPECT_LT(glm::distance(pointLookedAt(Scene(), away), {61, 4, 0}), 1e-12);
}

TEST(CameraAim, OrbitsGoAboutIt) {
  const SceneCamera camera = cameraAtPoint("start", {1, 4, 3}, {-2, 0, 1});
  const CameraMotion motion = motionOf(pathOf(CameraPathKind::orbit, 10.0), camera);
  const SceneCamera turned = cameraAt(motion, 9);
  // A quarter turn about (-2, y, 1): from (3, ., 2) relative to it to (2, ., -3).
  EXPECT_LT(glm::distance(positionOf(turned), {0, 4, -2}), 1e-10);
}

std::string messageOf(const CameraPath& path, uint32_t frame = 0) {
  try {
    cameraAt(motionOf(path), frame);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badUsage);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

TEST(CameraPath, UnknownCamerasAreSaidAtTheirPlace) {
  CameraPath path = pathOf(CameraPathKind::cut);
  path.cutCamera = "othr";
  path.place = "suite.toml:3:1";
  EXPECT_EQ(messageOf(path),
            "suite.toml:3:1: camera 'othr': 'floor' has start, other, flat; did you mean 'other'?");
  path.place.clear();
  EXPECT_EQ(messageOf(path).rfind("camera path: camera 'othr'", 0), 0u);
}

}  // namespace

}  // namespace restlab
