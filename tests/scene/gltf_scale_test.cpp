// Node scales that mirror or are 0: their effect on cameras and lights, and plates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/compiled/compiled_scene.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::warns;

const double kHalfSide = std::sqrt(0.5);

// Loads a file in which the node `camera` carries a camera, below `root`.
Scene withCamera(json camera, json root, bool isOrthographic = false) {
  GltfBuilder file;
  if (isOrthographic) {
    file.add("cameras", {{"type", "orthographic"},
                         {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}}});
  } else {
    file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  }
  camera["camera"] = 0;
  root["children"] = {file.add("nodes", camera)};
  file.node(root);
  file.node({{"mesh", file.triangle()}});
  return file.load();
}

// Position of a world point in the image: x to the right, y up, z along the view.
glm::vec3 onFilm(const Scene& scene, const glm::dvec3& pointW) {
  const auto compiled = CompiledScene::build(scene);
  const rl::Camera camera = compiled->camera(scene.cameras.at(0), 64, 64);
  const auto d = glm::vec3(pointW - compiled->origin()) - camera.posW;
  return {glm::dot(d, camera.rightW), glm::dot(d, camera.upW), glm::dot(d, camera.forwardW)};
}

void expectSame(const glm::vec3& a, const glm::vec3& b, const json& node) {
  EXPECT_LT(glm::distance(a, b), 1e-5f) << node << ": " << a.x << " " << a.y << " " << a.z;
}

// One mirror above both the camera and all that it sees leaves the image unchanged.
TEST(GltfScale, AMirrorAboveCameraAndMeshesShowsInNoImage) {
  const json turned = {{"rotation", {0, 0.6, 0, 0.8}}, {"translation", {1, 2, 3}}};
  for (const bool isOrthographic : {false, true}) {
    const Scene plain = withCamera(turned, json::object(), isOrthographic);
    for (const glm::dvec3 s : {glm::dvec3(1, 1, -1), glm::dvec3(-1, 1, 1), glm::dvec3(1, -1, 1),
                               glm::dvec3(-1, -1, -1), glm::dvec3(-1, -1, 1)}) {
      const json root = {{"scale", {s.x, s.y, s.z}}};
      const Scene mirrored = withCamera(turned, root, isOrthographic);
      for (const glm::dvec3 p : {glm::dvec3(4, -1, 2), glm::dvec3(0, 0, 0), glm::dvec3(1, 5, 3)})
        expectSame(onFilm(mirrored, p * s), onFilm(plain, p), root);
      EXPECT_EQ(mirrored.cameras[0].isMirrored, s.x * s.y * s.z < 0.0);
      EXPECT_NEAR(glm::determinant(glm::dmat3(mirrored.cameras[0].cameraToWorld)), 1.0, 1e-12);
    }
  }
}

// The camera's own scale is ignored, whatever its signs, written as a scale or as a matrix.
TEST(GltfScale, TheScaleOfACameraIsIgnored) {
  const Scene plain = withCamera(json::object(), json::object());
  for (const glm::dvec3 s :
       {glm::dvec3(1, 1, -1), glm::dvec3(-1, 1, 1), glm::dvec3(1, -2, 1), glm::dvec3(-1, -1, -1),
        glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 1), glm::dvec3(0, 1, -1), glm::dvec3(2, 3, 0)}) {
    const json scaled = {{"scale", {s.x, s.y, s.z}}};
    const json matrix = {{"matrix", {s.x, 0, 0, 0, 0, s.y, 0, 0, 0, 0, s.z, 0, 0, 0, 0, 1}}};
    // The signs of a matrix without volume cannot be determined.
    const bool isReadable = s.x * s.y * s.z != 0.0 || std::min({s.x, s.y, s.z}) >= 0.0;
    for (const json& node : isReadable ? std::vector{scaled, matrix} : std::vector{scaled}) {
      const Scene scene = withCamera(node, json::object());
      for (const glm::dvec3 p : {glm::dvec3(4, -1, 2), glm::dvec3(1, 5, -3)})
        expectSame(onFilm(scene, p), onFilm(plain, p), node);
      EXPECT_FALSE(scene.cameras[0].isMirrored) << node;
      EXPECT_TRUE(warns(scene, "carries a camera, and its scale")) << node;
    }
  }
}

TEST(GltfScale, ZeroAboveACameraCountsAsOne) {
  const json turned = {{"rotation", {0, kHalfSide, 0, kHalfSide}}, {"translation", {1, 2, 3}}};
  for (const glm::dvec3 s : {glm::dvec3(0, 1, 1), glm::dvec3(1, 0, 1), glm::dvec3(0, 0, 0)}) {
    const json root = {{"scale", {s.x, s.y, s.z}}};
    const Scene scene = withCamera(turned, root);
    const glm::dmat4& m = scene.cameras[0].cameraToWorld;
    EXPECT_LT(glm::distance(glm::dvec3(m[3]), s * glm::dvec3(1, 2, 3)), 1e-12) << root;
    EXPECT_LT(glm::distance(-glm::dvec3(m[2]), glm::dvec3(-1, 0, 0)), 1e-12) << root;
  }
}

// Below an uneven scale, axes are not orthogonal: the centre of the view must stay.
TEST(GltfScale, AShearedCameraLooksWhereItsNodeSays) {
  const json turned = {{"rotation", {0, std::sin(0.3), 0, std::cos(0.3)}}};
  const Scene scene = withCamera(turned, {{"scale", {3, 1, 1}}});
  const glm::dvec3 ahead(-3.0 * std::sin(0.6), 0.0, -std::cos(0.6));
  const glm::vec3 film = onFilm(scene, ahead);
  EXPECT_NEAR(film.x, 0.0f, 1e-6f);
  EXPECT_NEAR(film.y, 0.0f, 1e-6f);
  EXPECT_NEAR(film.z, float(glm::length(ahead)), 1e-5f);
}

TEST(GltfScale, LightsOfZeroOrMirroredScaleShineAlongTheirNode) {
  for (const json& scale : {json{0, 0, 0}, json{1, 1, -1}, json{1, 1, 0}}) {
    GltfBuilder file;
    file.doc["extensionsUsed"] = {"KHR_lights_punctual"};
    file.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}}};
    file.node({{"rotation", {kHalfSide, 0, 0, kHalfSide}},
               {"scale", scale},
               {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_LT(glm::distance(scene.lights[0].dirW, glm::dvec3(0, 1, 0)), 1e-12) << scale;
    EXPECT_TRUE(warns(scene, "carries a light, and its scale")) << scale;
  }
}

TEST(GltfScale, PlatesAreDrawnAndLinesAreNot) {
  GltfBuilder file;
  const int mesh = file.triangle();
  file.node({{"mesh", mesh}, {"scale", {1, 0, 1}}, {"name", "plate"}});
  file.node({{"mesh", mesh}, {"scale", {1, 0, 0}}, {"name", "line"}});
  // Flattened along a direction that is no axis of the mesh.
  const int turned = file.add("nodes", {{"mesh", mesh}, {"rotation", {0, 0, 0.6, 0.8}}});
  file.node({{"children", {turned}}, {"scale", {1, 0, 1}}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_TRUE(warns(scene, "nodes[0] ('plate'): its transform to the world flattens 'plate'"));
  EXPECT_TRUE(warns(scene, "leaves a line or a point of 'line'"));
  for (const MeshInstance& instance : scene.instances)
    EXPECT_GT(glm::determinant(glm::dmat3(instance.objectToWorld)), 0.0);
}

}  // namespace
}  // namespace restlab
