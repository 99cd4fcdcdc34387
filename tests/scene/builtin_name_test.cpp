// Built-in scenes with parameters in their names: parsing, and the effect on the scene.
#include "core/scene/builtin/name.h"
#include "core/scene/compiled/coarse_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/relations.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {
namespace {

std::string errorOf(const std::string& name) {
  try {
    makeBuiltinScene(name);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput) << name;
    return error.what();
  }
  return "";
}

TEST(BuiltinName, NumbersAndPowers) {
  const BuiltinName name = parseBuiltinName("furnace?albedo=0.75&scale=2^-13&move=-1e3");
  EXPECT_EQ(name.base, "furnace");
  EXPECT_EQ(name.value("albedo"), 0.75);
  EXPECT_EQ(name.value("scale"), std::exp2(-13.0));
  EXPECT_EQ(name.value("move"), -1000.0);
  EXPECT_EQ(name.value("radiance"), 1.0) << "its default";
  EXPECT_EQ(name.value("fov"), std::nullopt) << "it has none";
  EXPECT_EQ(parseBuiltinName("furnace").value("albedo"), 0.5);
}

TEST(BuiltinName, ChoicesGoByName) {
  EXPECT_EQ(parseBuiltinName("shape-furnace?kind=disk").value("kind"), 1.0);
  EXPECT_EQ(parseBuiltinName("shape-furnace").value("kind"), 0.0);
  EXPECT_EQ(withoutRelations("shape-furnace?kind=disk&as=mesh&scale=2"), "shape-furnace?kind=disk");
}

TEST(BuiltinName, MistakesAreOneLine) {
  const auto expectError = [](const std::string& name, const std::string& words) {
    const std::string error = errorOf(name);
    EXPECT_NE(error.find(words), std::string::npos) << name << ": " << error;
  };
  expectError(
      "furnace?albdo=0.5",
      "furnace has no parameter 'albdo' (it has: albedo, height, gap, wall, scale, radiance, "
      "move, fov); did you mean 'albedo'?");
  expectError("cornell-box?albedo=0.5", "cornell-box has no parameter 'albedo'");
  expectError("furnace?albedo=1.5", "albedo is 1.5, but must be in 0..1");
  expectError("furnace?albedo=nan", "albedo is 'nan', not a number");
  expectError("furnace?albedo=0.5x", "albedo is '0.5x', not a number");
  expectError("furnace?albedo", "albedo is '', not a number");
  expectError("furnace?albedo=2^2^2", "not a number");
  expectError("furnace?", "no parameter ''");
  expectError("furnace?scale=2&scale=2", "'scale' is given twice");
  expectError("ball?as=spere", "as is 'spere', not one of sphere, ");
  expectError("ball?as=spere", "did you mean 'sphere'?");
  expectError("ball?as=0", "as is '0', not one of sphere, ");
  expectError("furnase?albedo=0.5",
              "no built-in scene is named 'furnase'; did you mean 'furnace'?");
}

TEST(BuiltinName, FloorsAreCutAsTheySay) {
  const auto triangles = [](const std::string& name) {
    size_t count = 0;
    const Scene scene = makeBuiltinScene(name);
    for (const MeshInstance& instance : scene.instances)
      count += scene.geometries[instance.geometry].triangles.size();
    return count;
  };
  EXPECT_EQ(triangles("floor"), 2u);
  EXPECT_EQ(triangles("floor?triangles=0"), 0u);
  EXPECT_EQ(triangles("floor?triangles=1"), 1u);
  EXPECT_EQ(triangles("floor?triangles=1000"), 2u * 22u * 22u);
  EXPECT_EQ(triangles("floor?copies=3"), 6u);
  EXPECT_EQ(triangles("floor?needle=100"), 200u);
  EXPECT_EQ(triangles("quad-light?triangles=1e4"), 2u + 2u * 71u * 71u);
  EXPECT_EQ(triangles("quad-light?triangles=1e4&ratio=10"), 2u + 2u * 71u * 71u);
  const Scene floor = makeBuiltinScene("floor?needle=100");
  const MeshGeometry& needles = floor.geometries[0];
  const glm::uvec3 t = needles.triangles[0];
  const float length = glm::length(needles.positions[t.y] - needles.positions[t.x]);
  const float width = glm::length(needles.positions[t.z] - needles.positions[t.y]);
  EXPECT_NEAR(length / width, 100.0f, 1e-2f);
}

TEST(BuiltinName, WhatDoesNotGoTogetherIsRefused) {
  const auto expectError = [](const std::string& name, const std::string& words) {
    try {
      makeBuiltinScene(name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  expectError("floor?ior=1.5&copies=2", "goes with 'view' alone");
  expectError("floor?needle=10&triangles=8", "both say how many");
  expectError("floor?spots=10&sun=8", "instead of the sky");
  expectError("furnace?wall=0.1&height=0.5", "leave 'height' out");
}

TEST(BuiltinName, TexturesAreInTheHash) {
  EXPECT_NE(makeBuiltinScene("floor?slope=10").contentHash,
            makeBuiltinScene("floor?slope=20").contentHash);
  Scene scene = makeBuiltinScene("floor?slope=10");
  const uint64_t before = builtin::hashOf(scene);
  scene.images.at(0).texels.at(0) ^= 1u;
  EXPECT_NE(builtin::hashOf(scene), before);
}

TEST(BuiltinName, WithoutRelationsKeepsTheRest) {
  EXPECT_EQ(withoutRelations("furnace"), "furnace");
  EXPECT_EQ(withoutRelations("furnace?scale=2"), "furnace");
  EXPECT_EQ(withoutRelations("furnace?scale=2&albedo=0.25&radiance=4&fov=90&move=3"),
            "furnace?albedo=0.25&fov=90");
}

TEST(BuiltinName, TheHashIsOfTheContents) {
  const Scene plain = makeBuiltinScene("furnace");
  const Scene same = makeBuiltinScene("furnace?albedo=0.5&scale=1&move=0");
  EXPECT_EQ(plain.contentHash, same.contentHash);
  EXPECT_EQ(same.name, "furnace?albedo=0.5&scale=1&move=0");
  for (const char* other : {"furnace?albedo=0.25", "furnace?scale=2", "furnace?radiance=2",
                            "furnace?move=1", "furnace?fov=90"})
    EXPECT_NE(makeBuiltinScene(other).contentHash, plain.contentHash) << other;
}

TEST(BuiltinName, EveryParameterWorksAtBothEnds) {
  for (const std::string& scene : builtinSceneNames()) {
    for (const SceneParameter& parameter : builtinSceneParameters(scene)) {
      EXPECT_FALSE(parameter.summary.empty());
      for (const std::string& choice : parameter.choices)
        makeBuiltinScene(scene + "?" + parameter.name + "=" + choice);
      if (!parameter.choices.empty()) continue;
      for (const double value : {parameter.lo, parameter.hi}) {
        const std::string name = scene + "?" + parameter.name + "=" + std::to_string(value);
        // std::to_string() gives six digits behind the point: write small values as 1e-4 instead.
        const std::string exact =
            std::abs(value) < 1e-3 ? scene + "?" + parameter.name + "=1e-4" : name;
        if (std::abs(value) < 1e-3 && (1e-4 < parameter.lo || 1e-4 > parameter.hi)) continue;
        const Scene made = makeBuiltinScene(exact);
        for (const MeshGeometry& geometry : made.geometries) {
          for (const glm::vec3& p : geometry.positions)
            ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << exact;
        }
      }
    }
  }
}

TEST(BuiltinRelations, ScaleTakesLightsAndAbsorptionAlong) {
  Scene scene = makeBuiltinScene("glass");
  PunctualLight spot;
  spot.kind = rl::RL_LIGHT_SPOT;
  spot.posW = {1.0, 2.0, 3.0};
  spot.intensity = glm::vec3(5.0f);
  PunctualLight sun = spot;
  sun.kind = rl::RL_LIGHT_DIRECTIONAL;
  scene.lights = {spot, sun};
  const Scene before = scene;
  builtin::scaleScene(scene, 4.0);
  for (size_t g = 0; g < scene.geometries.size(); ++g) {
    for (size_t i = 0; i < scene.geometries[g].positions.size(); ++i)
      ASSERT_EQ(scene.geometries[g].positions[i], 4.0f * before.geometries[g].positions[i]);
  }
  EXPECT_EQ(scene.lights[0].posW, 4.0 * spot.posW);
  EXPECT_EQ(scene.lights[0].intensity, 16.0f * spot.intensity) << "W/sr at four times the distance";
  EXPECT_EQ(scene.lights[1].intensity, sun.intensity);
  for (size_t m = 0; m < scene.materials.size(); ++m)
    EXPECT_EQ(scene.materials[m].data.sigmaAbsorption,
              0.25f * before.materials[m].data.sigmaAbsorption);
  EXPECT_EQ(glm::dvec3(scene.cameras[0].cameraToWorld[3]),
            4.0 * glm::dvec3(before.cameras[0].cameraToWorld[3]));
  EXPECT_EQ(scene.cameras[0].yfov, before.cameras[0].yfov);
}

TEST(BuiltinRelations, RadianceIsOfEveryLight) {
  const Scene plain = makeBuiltinScene("courtyard");
  const Scene bright = makeBuiltinScene("courtyard?radiance=8");
  ASSERT_FALSE(plain.lights.empty());
  for (size_t i = 0; i < plain.lights.size(); ++i)
    EXPECT_EQ(bright.lights[i].intensity, 8.0f * plain.lights[i].intensity);
  EXPECT_EQ(bright.environment->scale, 8.0f * plain.environment->scale);
  const Scene furnace = makeBuiltinScene("furnace?radiance=2^-60");
  EXPECT_EQ(furnace.materials[0].data.emission.x, std::exp2(-61.0f));
}

// Vertices and eye move together: coinciding points stay coincident.
TEST(BuiltinRelations, MovesVerticesAndEyeAlike) {
  const Scene plain = makeBuiltinScene("furnace"), moved = makeBuiltinScene("furnace?move=100");
  const double offset = 100.0 * 5.0;        // the room is 5 m deep
  const float spacing = std::exp2(-15.0f);  // spacing of floats from 256 to 512
  for (size_t g = 0; g < plain.geometries.size(); ++g) {
    for (size_t i = 0; i < plain.geometries[g].positions.size(); ++i) {
      const glm::dvec3 apart(glm::dvec3(moved.geometries[g].positions[i]) - offset -
                             glm::dvec3(plain.geometries[g].positions[i]));
      ASSERT_LE(std::max({std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)}), spacing);
    }
  }
  EXPECT_EQ(moved.cameras[0].cameraToWorld[3].x, plain.cameras[0].cameraToWorld[3].x + offset);
}

std::string coarseWarning(const std::string& name) {
  const auto compiled = CompiledScene::build(makeBuiltinScene(name));
  for (const std::string& warning : compiled->warnings()) {
    if (warning.find("float32 rounds them") != std::string::npos) return warning;
  }
  return "";
}

// The warning about the limit of float32 appears beyond the limit, and not before.
TEST(CoarseVertices, AreAWarningBeyondTheLimitAlone) {
  for (const std::string& name : builtinSceneNames()) EXPECT_EQ(coarseWarning(name), "") << name;
  EXPECT_EQ(coarseWarning("furnace?move=500"), "") << "2^-13 m of 5 m";
  EXPECT_EQ(coarseWarning("furnace?scale=2^17"), "");
  EXPECT_EQ(coarseWarning("furnace?scale=2^-13"), "");
  const std::string warning = coarseWarning("furnace?move=1e4");
  EXPECT_NE(warning.find("furnace?move=1e4: "), std::string::npos) << warning;
  EXPECT_NE(warning.find("0.0039 m, 0.00078 of the scene's size"), std::string::npos) << warning;
}

TEST(CoarseVertices, ASceneWithoutAnyHasNoWarning) {
  Scene scene = makeBuiltinScene("furnace");
  scene.instances.clear();
  EXPECT_EQ(coarseVertices(scene), "");
  EXPECT_EQ(coarseVertices(Scene()), "");
}

// The transform of a node loses nothing: scenes are recentred in double.
TEST(CoarseVertices, ADistanceOfTheNodeIsKept) {
  Scene scene = makeBuiltinScene("furnace");
  for (MeshInstance& instance : scene.instances)
    instance.objectToWorld[3] += glm::dvec4(1e7, 1e7, 1e7, 0.0);
  const auto compiled = CompiledScene::build(scene);
  EXPECT_TRUE(compiled->warnings().empty());
}

}  // namespace
}  // namespace restlab
