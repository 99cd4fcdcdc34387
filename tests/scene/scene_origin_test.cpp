// The origin of a scene follows its camera if something lies too far off; otherwise it is the
// middle of the bounds. Huge triangles near the camera are drawn in pieces.
#include "core/scene/compiled/scene_origin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/coarse_vertices.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/compiled/split_triangles.h"

namespace restlab {
namespace {

// A box around a camera at (1.4, 0, 0), which looks along -X.
builtin::SceneBuilder room(const glm::dvec3& at = glm::dvec3(0.0)) {
  builtin::SceneBuilder builder("room");
  const uint32_t grey = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  builder.place("room", builder.addGeometry(builtin::box("room", {-2, -1, -1}, {2, 1, 1.5})), grey,
                glm::translate(glm::dmat4(1.0), at));
  builder.addCamera("camera", at + glm::dvec3(1.4, 0, 0), at, 50.0);
  return builder;
}

void addStray(builtin::SceneBuilder& builder, const glm::dvec3& at) {
  builder.place("stray", builder.addGeometry(builtin::box("stray", {-1, -1, -1}, {1, 1, 1})), 0,
                glm::translate(glm::dmat4(1.0), at));
}

TEST(SceneOrigin, AStrayMovesNothing) {
  const auto plain = CompiledScene::build(room().finish());
  EXPECT_EQ(plain->origin(), glm::dvec3(0, 0, 0.25));
  for (const double distance : {2e3, 1e4, 1e5, 1e6, 1e8, 1e12}) {
    builtin::SceneBuilder builder = room();
    addStray(builder, {distance, -0.3 * distance, 0});
    const auto compiled = CompiledScene::build(builder.finish());
    EXPECT_EQ(compiled->origin(), plain->origin()) << distance;
    const rl::Camera c = compiled->camera(compiled->source().cameras[0], 8, 8);
    EXPECT_EQ(c.posW, plain->camera(plain->source().cameras[0], 8, 8).posW) << distance;
    bool isSaid = false;
    for (const std::string& line : compiled->warnings())
      isSaid |= line.find("room: stray: lies ") == 0;
    EXPECT_EQ(isSaid, distance > 2e4) << distance << ": float32 holds it where it is nearer";
  }
}

// The stray belongs to the room's mesh, as with exporters that join everything.
TEST(SceneOrigin, AStrayWithinTheSameMeshMovesNothing) {
  Scene scene = room().finish();
  MeshGeometry& mesh = scene.geometries[0];
  const auto first = uint32_t(mesh.positions.size());
  for (const glm::vec3 p : {glm::vec3(1e6f, 0, 0), glm::vec3(1e6f, 1, 0), glm::vec3(1e6f, 0, 1)})
    mesh.positions.push_back(p);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  for (const auto* attribute : {&mesh.normals})
    if (!attribute->empty()) mesh.normals.resize(mesh.positions.size(), glm::vec3(1, 0, 0));
  for (auto& uvs : mesh.uvs)
    if (!uvs.empty()) uvs.resize(mesh.positions.size());
  EXPECT_EQ(originOf(scene, 0).originW, glm::dvec3(0, 0, 0.25));
}

TEST(SceneOrigin, HarmlessScenesKeepTheMiddleOfTheirBounds) {
  for (const std::string& name : builtinSceneNames()) {
    const Scene scene = makeBuiltinScene(name);
    const auto bounds = worldBounds(scene);
    for (uint32_t camera = 0; camera < scene.cameras.size(); ++camera) {
      const SceneOrigin origin = originOf(scene, camera);
      EXPECT_FALSE(origin.followsCamera) << name;
      EXPECT_EQ(origin.originW, 0.5 * (bounds[0] + bounds[1])) << name;
    }
  }
  // Far from the world's origin, or seen from afar: neither makes a stray.
  EXPECT_FALSE(originOf(room({1e7, 0, 1e7}).finish(), 0).followsCamera);
  builtin::SceneBuilder far("far");
  addStray(far, glm::dvec3(0.0));
  far.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  far.addCamera("telephoto", {1e5, 0, 0}, {0, 0, 0}, 0.002);
  EXPECT_FALSE(originOf(far.finish(), 0).followsCamera);
}

// Two rooms a thousand kilometres apart: each camera gets precise coordinates in its own room.
TEST(SceneOrigin, FollowsTheMainCamera) {
  builtin::SceneBuilder builder = room();
  const glm::dvec3 away(1e6, 0, 0);
  addStray(builder, away + glm::dvec3(0, 0, 8));
  builder.addCamera("away", away, away + glm::dvec3(0, 0, 8), 40.0);
  Scene scene = builder.finish();
  EXPECT_EQ(originOf(scene, 0).originW, glm::dvec3(0, 0, 0.25));
  EXPECT_EQ(originOf(scene, 1).originW, away + glm::dvec3(0, 0, 8));
  const std::vector<std::string> lines = farFromOrigin(scene, originOf(scene, 0));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[1].find("camera 'away' stands 1e+06 m"), std::string::npos) << lines[1];
  scene.mainCamera = 1;
  EXPECT_EQ(CompiledScene::build(scene)->origin(), away + glm::dvec3(0, 0, 8));
}

// A narrow view from afar: no warning advises to render a scene's only camera by itself.
TEST(SceneOrigin, TheOnlyCameraIsNotComparedWithItself) {
  for (const double degrees : {1e-2, 1e-3, 1e-5}) {
    builtin::SceneBuilder builder("tele");
    const uint32_t grey = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
    builder.add(builtin::box("room", {-2, -1, -1}, {2, 1, 1.5}), grey);
    builder.addCamera("camera0", {1.4, 0, 0}, {-2, 0, 0}, degrees);
    const auto compiled = CompiledScene::build(builder.finish());
    bool isSaid = false;
    for (const std::string& line : compiled->warnings()) {
      EXPECT_EQ(line.find("render it by --camera"), std::string::npos) << line;
      isSaid |= line.find("tele: camera 'camera0' stands") == 0 &&
                line.find("float32 rounds its place to") != std::string::npos;
    }
    // A float of 3 m has a step of 2.4e-7 m; the view is 6e-4, 6e-5 and 6e-7 m high.
    EXPECT_EQ(isSaid, degrees < 1e-2) << degrees;
  }
}

TEST(SceneOrigin, WithoutACameraTheViewLeavesStraysOut) {
  builtin::SceneBuilder builder = room();
  const SceneCamera plain = framingCamera(builder.finish());
  for (const double distance : {1e4, 1e8}) {
    builtin::SceneBuilder other = room();
    other.add(builtin::quad("stray", {0, distance, 0}, {1, 0, 0}, {0, 1, 0}), 0);
    EXPECT_EQ(framingCamera(other.finish()).cameraToWorld, plain.cameraToWorld) << distance;
  }
}

// Vertices rounded in the file are judged relative to the visible part, not to the distance of a
// stray.
TEST(SceneOrigin, RoundedVerticesNearTheCameraAreSaidBesideAStray) {
  builtin::SceneBuilder builder = room();
  MeshGeometry rounded = builtin::box("rounded", {-0.1, -0.9, -0.1}, {0.1, -0.5, 0.1});
  for (glm::vec3& p : rounded.positions) p.x += 1e5f;
  builder.place("rounded", builder.addGeometry(rounded), 0,
                glm::translate(glm::dmat4(1.0), glm::dvec3(-1e5, 0, 0)));
  addStray(builder, {1e7, 0, 0});
  const std::string line = coarseVertices(builder.finish());
  EXPECT_NE(line.find("rounded: vertices are so far"), std::string::npos) << line;
}

// A ground of two triangles under the camera.
Scene onGround(double halfSize, const glm::dvec3& middle) {
  builtin::SceneBuilder builder("street");
  const uint32_t grey = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  const glm::dvec3 s(halfSize, 0.0, halfSize);
  builder.add(builtin::box("house", {-1, 0, -1}, {1, 2, 1}), grey);
  builder.place("ground",
                builder.addGeometry(
                    builtin::quad("ground", {-s.x, 0, -s.z}, {0, 0, 2 * s.z}, {2 * s.x, 0, 0})),
                grey, glm::translate(glm::dmat4(1.0), middle));
  builder.addCamera("camera", {4, 1.5, 3}, {0, 1, 0}, 45.0);
  return builder.finish();
}

TEST(SceneOrigin, HugeTrianglesNearTheCameraAreSplit) {
  EXPECT_EQ(CompiledScene::build(onGround(200.0, {}))->triangleCount(), 14u) << "as it stands";
  for (const double size : {1e4, 1e6, 1e8}) {
    for (const glm::dvec3 middle : {glm::dvec3(0.0), glm::dvec3(0.4 * size, 0.0, -0.7 * size)}) {
      const Scene scene = onGround(size, middle);
      const SceneOrigin origin = originOf(scene, 0);
      const auto split =
          splitHugeTriangles(scene.geometries[1], scene.instances[1].objectToWorld, origin);
      ASSERT_TRUE(split) << size;
      EXPECT_LT(split->mesh.triangles.size(), 2000u) << size;
      double area = 0.0, nearest = 1e300;
      for (const glm::uvec3& t : split->mesh.triangles) {
        const glm::dvec3 a = split->positionsW[t.x], b = split->positionsW[t.y],
                         c = split->positionsW[t.z];
        EXPECT_EQ(a.y, 0.0);
        const glm::dvec3 cross = glm::cross(b - a, c - a);
        EXPECT_GT(cross.y, 0.0) << "it faces as it did";
        area += 0.5 * cross.y;
        double most = 0.0;
        for (const glm::dvec3& p : {a, b, c}) most = std::max(most, glm::length(p - origin.focusW));
        nearest = std::min(nearest, most);
      }
      EXPECT_NEAR(area / (4.0 * size * size), 1.0, 1e-9);
      EXPECT_LT(nearest, 1.2 * std::sqrt(2.0) * kHarmlessReach * origin.viewSize);
    }
  }
}

}  // namespace
}  // namespace restlab
