// Node hierarchy, instancing, cameras, lights.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/base/error.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::warns;

void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-6)
      << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

const double kHalf = std::sqrt(0.5);

TEST(GltfNodes, HierarchyWithNegativeAndNonUniformScale) {
  GltfBuilder file;
  const int mesh = file.triangle();
  const int child = file.add(
      "nodes",
      {{"mesh", mesh}, {"translation", {1, 0, 0}}, {"scale", {-1, 2, 1}}, {"name", "child"}});
  // The parent turns by 90 degrees about Z.
  file.node(
      {{"children", {child}}, {"rotation", {0, 0, kHalf, kHalf}}, {"translation", {0, 0, 3}}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.instances.size(), 1u);
  const glm::dmat4& m = scene.instances[0].objectToWorld;
  EXPECT_EQ(scene.instances[0].name, "child");
  expectNear(glm::dvec3(m * glm::dvec4(0, 0, 0, 1)), {0, 1, 3});
  expectNear(glm::dvec3(m * glm::dvec4(1, 0, 0, 1)), {0, 0, 3});
  expectNear(glm::dvec3(m * glm::dvec4(0, 1, 0, 1)), {-2, 1, 3});
  EXPECT_LT(glm::determinant(glm::dmat3(m)), 0.0) << "mirrored";
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST(GltfNodes, MatrixIsColumnMajor) {
  GltfBuilder file;
  file.node(
      {{"mesh", file.triangle()}, {"matrix", {2, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1}}});
  const Scene scene = file.load();
  const glm::dmat4& m = scene.instances.at(0).objectToWorld;
  expectNear(glm::dvec3(m * glm::dvec4(1, 1, 0, 1)), {9.5, 9, 9});
}

TEST(GltfNodes, DefaultSceneFirstSceneOrAllNodes) {
  for (int kind = 0; kind < 3; ++kind) {
    GltfBuilder file;
    const int mesh = file.triangle();
    for (const char* name : {"a", "b", "c"}) file.add("nodes", {{"mesh", mesh}, {"name", name}});
    if (kind < 2) {
      file.doc["scenes"] = json::array({{{"nodes", {0}}}, {{"nodes", {1, 2}}}});
      if (kind == 0) file.doc["scene"] = 1;
    }
    const Scene scene = file.load();
    const std::vector<size_t> expected = {2, 1, 3};
    ASSERT_EQ(scene.instances.size(), expected[size_t(kind)]);
    EXPECT_EQ(scene.instances[0].name, kind == 0 ? "b" : "a");
    EXPECT_EQ(warns(scene, "2 scenes; only scenes"), kind < 2);
  }
}

TEST(GltfNodes, DegenerateTransformIsLeftOutWithAWarning) {
  GltfBuilder file;
  file.node({{"mesh", file.triangle()}, {"scale", {0, 0, 1}}, {"name", "thread"}});
  file.node({{"mesh", 0}, {"scale", {1e-4, 1e4, 1}}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(warns(scene, "nodes[0] ('thread'): its transform to the world leaves a line"));
}

TEST(GltfNodes, DeepChainDoesNotOverflowTheStack) {
  GltfBuilder file;
  const int mesh = file.triangle();
  constexpr int kDepth = 40000;
  file.node({{"children", {1}}, {"translation", {1e-3, 0, 0}}});
  for (int i = 1; i < kDepth; ++i) {
    json node = {{"translation", {1e-3, 0, 0}}};
    if (i + 1 < kDepth) node["children"] = {i + 1};
    if (i + 1 == kDepth) node["mesh"] = mesh;
    file.add("nodes", node);
  }
  const Scene scene = file.load();
  EXPECT_NEAR(scene.instances.at(0).objectToWorld[3].x, 40.0, 1e-6);
}

TEST(GltfNodes, GpuInstancing) {
  GltfBuilder file;
  file.doc["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  const int translation = file.accessor<float>({1, 0, 0, 0, 2, 0}, "VEC3");
  const int rotation = file.accessor<int16_t>({0, 0, 0, 32767, 0, 0, 23170, 23170}, "VEC4", true);
  const int scale = file.accessor<float>({1, 1, 1, 3, 3, 3}, "VEC3");
  file.node({{"mesh", file.triangle()},
             {"name", "tree"},
             {"translation", {0, 0, 10}},
             {"extensions",
              {{"EXT_mesh_gpu_instancing",
                {{"attributes",
                  {{"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}}}}}}}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.geometries.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].name, "tree[1]");
  expectNear(glm::dvec3(scene.instances[0].objectToWorld[3]), {1, 0, 10});
  const glm::dmat4& m = scene.instances[1].objectToWorld;
  EXPECT_LT(glm::length(glm::dvec3(m * glm::dvec4(1, 0, 0, 1)) - glm::dvec3(0, 5, 10)), 1e-3);
}

TEST(GltfNodes, GpuInstancingErrors) {
  const auto errorOf = [](const std::vector<float>& translation, const std::vector<float>& scale) {
    GltfBuilder file;
    file.doc["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    json attributes = json::object();
    if (!translation.empty()) attributes["TRANSLATION"] = file.accessor(translation, "VEC3");
    if (!scale.empty()) attributes["SCALE"] = file.accessor(scale, "VEC3");
    file.node({{"mesh", file.triangle()},
               {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
    return file.error();
  };
  EXPECT_EQ(errorOf({1, 2, 3}, {1, 1, 1}), "");
  EXPECT_NE(errorOf({1, 2, 3}, {1, 1, 1, 2, 2, 2}).find("1 elements; 2 expected"),
            std::string::npos);
  EXPECT_NE(
      errorOf({1, 2, std::nanf("")}, {}).find("TRANSLATION: component 2 of instance 0 is nan"),
      std::string::npos);
  EXPECT_NE(errorOf({}, {}).find("has no TRANSLATION, ROTATION or SCALE"), std::string::npos);
}

TEST(GltfNodes, Cameras) {
  GltfBuilder file;
  file.node({{"mesh", file.triangle()}});
  file.add("cameras", {{"type", "perspective"},
                       {"name", "hero"},
                       {"perspective", {{"yfov", 0.7}, {"znear", 0.1}, {"aspectRatio", 1.5}}}});
  file.add("cameras", {{"type", "orthographic"},
                       {"orthographic", {{"xmag", 4}, {"ymag", 2}, {"znear", 0}, {"zfar", 10}}}});
  // Turned by -90 degrees about Y under a parent: looks along +X.
  const int child = file.add("nodes", {{"camera", 0}, {"rotation", {0, -kHalf, 0, kHalf}}});
  file.node({{"children", {child}}, {"translation", {1, 2, 3}}});
  file.node({{"camera", 1}, {"name", "top"}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "hero");
  EXPECT_EQ(scene.cameras[0].kind, rl::RL_CAMERA_PERSPECTIVE);
  EXPECT_DOUBLE_EQ(scene.cameras[0].yfov, 0.7);
  EXPECT_DOUBLE_EQ(scene.cameras[0].aspect, 1.5);
  expectNear(-glm::dvec3(scene.cameras[0].cameraToWorld[2]), {1, 0, 0});
  expectNear(glm::dvec3(scene.cameras[0].cameraToWorld[3]), {1, 2, 3});
  EXPECT_EQ(scene.cameras[1].name, "top");
  EXPECT_EQ(scene.cameras[1].kind, rl::RL_CAMERA_ORTHOGRAPHIC);
  EXPECT_DOUBLE_EQ(scene.cameras[1].xmag, 4.0);
  EXPECT_DOUBLE_EQ(scene.cameras[1].aspect, 2.0);
}

TEST(GltfNodes, FramingCameraSeesTheWholeScene) {
  GltfBuilder file;
  file.node({{"mesh", file.triangle()}, {"scale", {10, 4, 1}}, {"translation", {100, 0, -7}}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.cameras.size(), 1u);
  const SceneCamera& camera = scene.cameras[0];
  const glm::dmat4 worldToCamera = glm::inverse(camera.cameraToWorld);
  const double slope = std::tan(0.5 * camera.yfov);
  const auto bounds = worldBounds(scene);
  expectNear(bounds[0], {100, 0, -7});
  expectNear(bounds[1], {110, 4, -7});
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p = worldToCamera * glm::dvec4(bounds[corner & 1].x, bounds[corner >> 1 & 1].y,
                                                    bounds[corner >> 2].z, 1);
    EXPECT_LT(p.z, 0.0);
    EXPECT_LE(std::abs(p.x), -p.z * slope);
    EXPECT_LE(std::abs(p.y), -p.z * slope);
  }
}

TEST(GltfNodes, PunctualLights) {
  GltfBuilder file;
  file.doc["extensionsUsed"] = {"KHR_lights_punctual"};
  file.doc["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"},
       {"intensity", 10},
       {"color", {1, 0.5, 0}},
       {"name", "bulb"},
       {"range", 4}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.4}}}},
      {{"type", "directional"}, {"intensity", 3}}};
  const auto light = [](int index, json node) {
    node["extensions"]["KHR_lights_punctual"]["light"] = index;
    return node;
  };
  file.node({{"mesh", file.triangle()}});
  // The scale of a node does not change a light's numbers.
  file.node(light(0, {{"translation", {1, 2, 3}}, {"scale", {5, 5, 5}}}));
  // A turn by 90 degrees about X: -Z becomes +Y.
  file.node(light(1, {{"rotation", {kHalf, 0, 0, kHalf}}, {"scale", {1, 1, 4}}}));
  file.node(light(2, json::object()));
  const Scene scene = file.load();
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].kind, rl::RL_LIGHT_POINT);
  EXPECT_EQ(scene.lights[0].name, "bulb");
  EXPECT_EQ(scene.lights[0].intensity, glm::vec3(10, 5, 0));
  expectNear(scene.lights[0].posW, {1, 2, 3});
  EXPECT_EQ(scene.lights[1].kind, rl::RL_LIGHT_SPOT);
  expectNear(scene.lights[1].dirW, {0, 1, 0});
  EXPECT_FLOAT_EQ(scene.lights[1].innerConeAngle, 0.1f);
  EXPECT_FLOAT_EQ(scene.lights[1].outerConeAngle, 0.4f);
  EXPECT_EQ(scene.lights[2].kind, rl::RL_LIGHT_DIRECTIONAL);
  expectNear(scene.lights[2].dirW, {0, 0, -1});
  EXPECT_EQ(scene.lights[2].intensity, glm::vec3(3));
  EXPECT_TRUE(warns(scene, "lights[0].range: is not read"));
  EXPECT_FALSE(warns(scene, "no node of the scene carries it"));
  file.doc["extensions"]["KHR_lights_punctual"]["lights"].push_back({{"type", "point"}});
  EXPECT_TRUE(warns(file.load(), "lights[3]: no node of the scene carries it"));
}

TEST(GltfNodes, FindCamera) {
  Scene scene;
  scene.name = "s";
  for (const char* name : {"front", "side", "1", "side"}) {
    scene.cameras.emplace_back();
    scene.cameras.back().name = name;
  }
  EXPECT_EQ(findCamera(scene, "front"), 0u);
  EXPECT_EQ(findCamera(scene, "0"), 0u);
  EXPECT_EQ(findCamera(scene, "1"), 2u) << "a name goes before an index";
  EXPECT_EQ(findCamera(scene, "3"), 3u);
  const auto error = [&](const std::string& camera) {
    try {
      findCamera(scene, camera);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::badUsage);
      return std::string(e.what());
    }
    return std::string("none");
  };
  EXPECT_NE(error("frnt").find("did you mean 'front'?"), std::string::npos);
  EXPECT_NE(error("side").find("give an index: 1, 3"), std::string::npos);
  EXPECT_NE(error("4").find("cameras 0 to 3"), std::string::npos);
}

}  // namespace
}  // namespace restlab
