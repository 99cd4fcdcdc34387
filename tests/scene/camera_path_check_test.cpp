// Warnings of camera paths that lead through walls, into bodies, or to views without a surface.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/camera_path/camera_path.h"

namespace restlab {

namespace {

// A box with normals outwards, 12 triangles.
MeshGeometry box() {
  MeshGeometry geometry;
  for (int i = 0; i < 8; ++i)
    geometry.positions.push_back({i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1});
  geometry.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return geometry;
}

// A wall of 20 m at z = -10 and a body of 2 m at the origin, seen from z = 6.
Scene walledScene() {
  Scene scene;
  scene.geometries = {box()};
  MeshInstance body, wall;
  body.name = "body";
  wall.name = "wall";
  wall.objectToWorld =
      glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -10.5)), glm::dvec3(20, 20, 0.5));
  scene.instances = {body, wall};
  SceneCamera camera;
  camera.name = "start";
  camera.aspect = 1.5;
  camera.yfov = 0.7;
  camera.cameraToWorld = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 6));
  scene.cameras = {camera};
  return scene;
}

std::vector<std::string> linesOf(const Scene& of, CameraPath path, uint32_t frames = 41) {
  path.place = "path";
  return cameraPathWarnings(of, resolveCameraPath(path, of, 0), frames);
}

CameraPath dolly(double metres) {
  CameraPath path;
  path.kind = CameraPathKind::dolly;
  path.metresPerFrame = metres;
  return path;
}

using Lines = std::vector<std::string>;

TEST(CameraPathCheck, NothingIsSaidOfAFreePath) {
  EXPECT_EQ(linesOf(walledScene(), dolly(0.05)), Lines());
  CameraPath orbit;
  orbit.kind = CameraPathKind::orbit;
  orbit.degreesPerFrame = 1.0;
  EXPECT_EQ(linesOf(walledScene(), orbit), Lines());
  EXPECT_EQ(cameraWarnings(walledScene(), walledScene().cameras[0]), Lines());
}

TEST(CameraPathCheck, ThroughASurfaceIntoABody) {
  const Lines lines = linesOf(walledScene(), dolly(0.15));  // ends at the origin
  ASSERT_EQ(lines.size(), 3u) << lines[0];
  EXPECT_EQ(lines[0], "path: the camera walks through 'body' between the frames 32 and 34");
  EXPECT_EQ(lines[1],
            "path: at frame 34 the camera is inside 'body', whose back it sees to all sides");
  EXPECT_EQ(lines[2], "path: at frame 40 one flat surface of 'body' fills the view");
  // The camera passes through nothing at a cut.
  CameraPath keys;
  keys.kind = CameraPathKind::cut;
  keys.cutFrame = 3;
  keys.cutDegrees = 180.0;
  keys.targetW = glm::dvec3(0.0);
  Scene open = walledScene();
  open.instances[1].objectToWorld[3].z = -30.0;
  EXPECT_EQ(linesOf(open, keys), Lines());
}

// The face where a path begins counts as crossed; so does an edge between two triangles.
TEST(CameraPathCheck, FromAFaceIntoABody) {
  for (const double offset : {0.0, 1.7e-15, -1.7e-15}) {
    for (const double aside : {0.0, 0.3}) {
      Scene atFace = walledScene();
      atFace.cameras[0].cameraToWorld[3] = glm::dvec4(aside, 0, 1.0 + offset, 1);
      const Lines into = linesOf(atFace, dolly(0.02));
      ASSERT_FALSE(into.empty()) << offset;
      EXPECT_EQ(into[0], "path: the camera walks through 'body' between the frames 0 and 2")
          << offset << " " << aside;
      for (const std::string& line : linesOf(atFace, dolly(-0.02)))
        EXPECT_EQ(line.find("walks through"), std::string::npos) << line;
    }
  }
}

TEST(CameraPathCheck, ABlankEndAndNothingInView) {
  Scene beside = walledScene();
  beside.cameras[0].cameraToWorld[3].x = 5.5;
  beside.instances[0].objectToWorld[3].x = 4.0;  // in view at first, later behind
  const Lines blank = linesOf(beside, dolly(0.35));
  ASSERT_FALSE(blank.empty());
  EXPECT_EQ(blank.back(), "path: at frame 40 one flat surface of 'wall' fills the view");
  CameraPath away;
  away.kind = CameraPathKind::pan;
  away.degreesPerFrame = 4.5;
  EXPECT_EQ(linesOf(walledScene(), away), Lines({"path: at frame 40 no surface is in view"}));
}

TEST(CameraPathCheck, NearerThanTheNearDistance) {
  Scene near = walledScene();
  near.cameras[0].znear = 6.5;
  const Lines lines = linesOf(near, dolly(0.001));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].rfind("path: at frame 0 'body' is 5 m before the camera, nearer than its near "
                           "distance of 6.5 m",
                           0),
            0u)
      << lines[0];
  EXPECT_EQ(cameraWarnings(near, near.cameras[0]).size(), 1u);
}

// A mirrored instance flips its triangles; its inside must stay inside.
TEST(CameraPathCheck, AMirroredBodyHasItsInside) {
  Scene mirrored = walledScene();
  mirrored.instances[0].objectToWorld = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
  SceneCamera inside = mirrored.cameras[0];
  inside.cameraToWorld[3].z = 0.1;
  EXPECT_EQ(cameraWarnings(mirrored, inside).size(), 1u);
  EXPECT_EQ(cameraWarnings(mirrored, mirrored.cameras[0]), Lines());
}

}  // namespace

}  // namespace restlab
