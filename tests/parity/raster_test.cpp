// Rasterised first hits against those of rays, on the CPU and on a Vulkan device: every scene of
// the project, edges that triangles share, cameras inside of scenes, alpha, and what methods make
// of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "core/bench/first_hits.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/unit/ray_cases.h"

namespace restlab::parity {
namespace {

using Hits = std::vector<glm::uvec4>;
using SharedScene = std::shared_ptr<const CompiledScene>;

// Pixels whose centre lies so far from an edge show the same surface, whatever the rasteriser
// rounds: devices place corners on a grid of 1/256 pixel.
constexpr double kEdgePixels = 1.0 / 64.0;
constexpr double kSharedPixels = 1e-4;

BackendOptions optionsOf(const std::string& backend, int threads = 0) {
  BackendOptions options;
  options.rayTracing = backend == "vulkan" ? "bvh" : "embree";
  options.threads = threads;
  return options;
}

struct BothHits {
  Hits rays, raster;
};

BothHits bothHits(const SharedScene& scene, const std::string& backend, const SceneCamera& camera,
                  const glm::uvec2& size, bool isAtCentre = true, int threads = 0) {
  FirstHits hits(scene, backend, optionsOf(backend, threads), camera, size, isAtCentre);
  BothHits both;
  hits.byRays();
  both.rays = hits.hits();
  hits.byRaster();
  both.raster = hits.hits();
  return both;
}

// Distance in pixels from a pixel's centre to the nearest edge of a triangle on the film; 0 if a
// corner is behind the camera, or for shapes.
double pixelsToEdge(const CompiledScene& scene, const SceneCamera& of, const glm::uvec2& size,
                    size_t pixel, const glm::uvec4& hit) {
  const BvhInput in = scene.bvhInput();
  const rl::Instance& inst = in.instances[hit.x];
  const rl::Geometry& geometry = in.geometries[inst.geometry];
  if (geometry.triangleCount == 0) return 0.0;
  const rl::Camera camera = scene.camera(of, size.x, size.y);
  const glm::uvec3 corners = in.triangles[geometry.firstTriangle + hit.y];
  std::array<glm::dvec2, 3> film;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec4 p(in.positions[geometry.firstVertex + corners[i]], 1.0);
    const glm::dvec3 posW(glm::dot(glm::dvec4(inst.objectToWorldRow0), p),
                          glm::dot(glm::dvec4(inst.objectToWorldRow1), p),
                          glm::dot(glm::dvec4(inst.objectToWorldRow2), p));
    const bool isWorld = (inst.flags & rl::RL_INSTANCE_IDENTITY) != 0;
    const glm::dvec3 d = (isWorld ? glm::dvec3(p) : posW) - glm::dvec3(camera.posW);
    double along = glm::dot(d, glm::dvec3(camera.forwardW));
    if (camera.kind == rl::RL_CAMERA_ORTHOGRAPHIC) along = 1.0;
    if (!(along > 0.0)) return 0.0;
    const double x = glm::dot(d, glm::dvec3(camera.rightW)) / along - double(camera.shiftX);
    const double y = glm::dot(d, glm::dvec3(camera.upW)) / along - double(camera.shiftY);
    film[size_t(i)] = {(x / double(camera.halfWidth) + 1.0) * 0.5 * size.x,
                       (1.0 - y / double(camera.halfHeight)) * 0.5 * size.y};
  }
  const glm::dvec2 centre(double(pixel % size.x) + 0.5, double(pixel / size.x) + 0.5);
  double nearest = 1e300;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec2 a = film[i], ab = film[(i + 1) % 3] - a;
    const double t =
        std::clamp(glm::dot(centre - a, ab) / std::max(glm::dot(ab, ab), 1e-300), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(centre, a + t * ab));
  }
  return nearest;
}

// How many pixels differ.
struct RasterDifference {
  size_t pixels = 0;
  size_t shared = 0;   // the centre lies on the edge of two triangles of one mesh: both are right
  size_t atEdges = 0;  // near an edge of one of the triangles
  size_t unexplained = 0;  // all other differences: surfaces in one place
  double share() const { return double(atEdges + unexplained) / double(pixels); }
};

RasterDifference compare(const SharedScene& scene, const std::string& backend,
                         const SceneCamera& camera, const glm::uvec2& size) {
  const BothHits both = bothHits(scene, backend, camera, size);
  RasterDifference sum;
  sum.pixels = both.rays.size();
  for (size_t i = 0; i < both.rays.size(); ++i) {
    const glm::uvec4 &a = both.rays[i], &b = both.raster[i];
    const bool isNone = a.x == rl::RL_INVALID && b.x == rl::RL_INVALID;
    if (isNone || (a.x == b.x && a.y == b.y)) continue;
    double least = 1e300, most = 0.0;
    for (const glm::uvec4& hit : {a, b}) {
      if (hit.x == rl::RL_INVALID) continue;
      const double pixels = pixelsToEdge(*scene, camera, size, i, hit);
      least = std::min(least, pixels);
      most = std::max(most, pixels);
    }
    if (a.x == b.x && most < kSharedPixels)
      ++sum.shared;
    else
      ++(least < kEdgePixels ? sum.atEdges : sum.unexplained);
  }
  return sum;
}

// 99.9 % of the pixels show the primitive that the centre's ray meets; the others lie on edges.
void expectAgreement(const std::string& name, const std::string& backend) {
  const SharedScene scene = sceneNamed(name);
  // Devices round corners by a part of a pixel: triangles of a few pixels show it. Rays of shapes
  // take long.
  const bool isLarge = backend == "vulkan" && (scene->features() & rl::RL_FEATURE_SHAPES) == 0;
  const glm::uvec2 size = isLarge ? glm::uvec2(640, 360) : glm::uvec2(192, 108);
  const RasterDifference a = compare(scene, backend, scene->source().cameras.front(), size);
  std::printf("  %s, %s: of %zu pixels %zu differ at edges, %zu elsewhere; %zu on shared edges\n",
              name.c_str(), backend.c_str(), a.pixels, a.atEdges, a.unexplained, a.shared);
  EXPECT_LE(a.share(), 1e-3) << name << " on " << backend;
  EXPECT_EQ(a.unexplained, 0u) << name << " on " << backend;
  EXPECT_LE(double(a.shared), 0.01 * double(a.pixels)) << name << " on " << backend;
}

std::vector<std::string> backends() {
  std::vector<std::string> all = {"cpu"};
  if (hasVulkan()) all.emplace_back("vulkan");
  return all;
}

class RasterOf : public testing::TestWithParam<std::string> {};

TEST_P(RasterOf, ShowsWhatRaysShow) {
  for (const std::string& backend : backends()) expectAgreement(GetParam(), backend);
}

std::string testNameOf(const testing::TestParamInfo<std::string>& scene) {
  std::string name = scene.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Builtin, RasterOf, testing::ValuesIn(builtinSceneNames()), testNameOf);
// Instances, alpha, closures, all kinds of shapes from inside, a view along the floor.
INSTANTIATE_TEST_SUITE_P(Odd, RasterOf,
                         testing::Values("everything", "materials", "shapes-file", "nurbs-file",
                                         "shape-furnace?kind=curves_coil",
                                         "shape-furnace?kind=sdf_dumbbell", "floor?view=89.9"),
                         testNameOf);

// Needles of 16 m by 1.6 cm.
TEST(Raster, NeedlesAreThoseOfRays) { expectAgreement("floor?needle=1000", "cpu"); }

TEST(Raster, AlphaIsDecidedAsForRays) {
  const SharedScene scene = unit::veils();
  SceneCamera camera;
  camera.cameraToWorld = glm::inverse(glm::lookAt(
      glm::dvec3(-4.0, 1.5, 5.0), glm::dvec3(5.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0)));
  for (const std::string& backend : backends()) {
    for (const bool isAtCentre : {true, false}) {
      const BothHits both = bothHits(scene, backend, camera, {128, 128}, isAtCentre);
      const HitAgreement a = agreementOf(both.rays, both.raster);
      EXPECT_GE(a.share(), 0.995) << backend << isAtCentre;  // triangles of a few pixels
      EXPECT_GE(double(a.sameInstance), 0.999 * double(a.pixels)) << backend << isAtCentre;
      // Some veils are passed, others are not.
      const auto shows = [&](uint32_t instance) {
        return std::count_if(both.raster.begin(), both.raster.end(),
                             [&](const glm::uvec4& hit) { return hit.x == instance; });
      };
      EXPECT_GT(shows(0), 20) << backend;
      EXPECT_GT(shows(3), 20) << backend;
    }
  }
}

// A closed mesh has no holes at its edges, nor has a pixel two owners.
TEST(Raster, ClosedMeshesHaveNoHoles) {
  const unit::ClosedBall ball(glm::dvec3(0.0));
  SceneCamera camera;
  for (const std::string& backend : backends()) {
    for (const double degrees : {0.0, 31.0, 90.0, 200.0}) {
      camera.cameraToWorld = glm::rotate(glm::dmat4(1.0), glm::radians(degrees),
                                         glm::normalize(glm::dvec3(0.2, 1.0, 0.1)));
      const BothHits both = bothHits(ball.scene, backend, camera, {256, 192});
      const auto holes = std::count_if(both.raster.begin(), both.raster.end(),
                                       [](const glm::uvec4& hit) { return hit.x != 0u; });
      EXPECT_EQ(holes, 0) << backend << " at " << degrees;
    }
  }
}

// A square whose edges and diagonal run through the centres of pixels: each centre belongs to one
// of the two triangles, and to the square or not as the fill rule says.
TEST(Raster, CentresOnEdgesBelongToOneTriangle) {
  builtin::SceneBuilder builder("square");
  const uint32_t grey = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  builder.add(builtin::quad("square", {-2.0, -2.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0}), grey);
  SceneCamera camera;
  camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  camera.xmag = camera.ymag = 4.0;
  camera.cameraToWorld = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 0.5, 3.0));
  const SharedScene scene = CompiledScene::build(builder.finish());
  for (const std::string& backend : backends()) {
    const BothHits both = bothHits(scene, backend, camera, {8, 8});
    std::array<int, 2> count{};
    for (const glm::uvec4& hit : both.raster)
      if (hit.x != rl::RL_INVALID) ++count[hit.y];
    // Centres lie at whole numbers: five by five are in the square or on its border, of which two
    // sides are its own.
    EXPECT_EQ(count[0] + count[1], 16) << backend;
    EXPECT_EQ(std::min(count[0], count[1]), 6) << backend;
  }
}

TEST(Raster, DoesNotDependOnThreads) {
  const SharedScene scene = sceneNamed("everything");
  const SceneCamera& camera = scene->source().cameras.front();
  const Hits one = bothHits(scene, "cpu", camera, {200, 120}, true, 1).raster;
  EXPECT_EQ(one, bothHits(scene, "cpu", camera, {200, 120}, true, 2).raster);
  EXPECT_EQ(one, bothHits(scene, "cpu", camera, {200, 120}, true, 3).raster);
}

// Surfaces nearer than RasterParams::nearest are cut, and triangles that reach behind the camera
// are drawn before it.
TEST(Raster, TrianglesMayReachBehindTheCamera) {
  builtin::SceneBuilder builder("plain");
  const uint32_t grey = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  builder.add(
      builtin::quad("plain", {-1000.0, 0.0, 1000.0}, {2000.0, 0.0, 0.0}, {0.0, 0.0, -2000.0}),
      grey);
  const SharedScene scene = CompiledScene::build(builder.finish());
  SceneCamera camera;
  camera.cameraToWorld = glm::translate(glm::dmat4(1.0), glm::dvec3(3.0, 1.5, 7.0));
  for (const std::string& backend : backends()) {
    const BothHits both = bothHits(scene, backend, camera, {96, 96});
    const HitAgreement a = agreementOf(both.rays, both.raster);
    EXPECT_GE(a.share(), 0.999) << backend;
    EXPECT_GT(std::count_if(both.raster.begin(), both.raster.end(),
                            [](const glm::uvec4& hit) { return hit.x == 0u; }),
              96 * 40);
  }
}

// The image of a method whose first hits are rasterised is that of rays with the same film samples.
FrameDifference againstRays(const std::string& scene, const Machine& where, SessionConfig config) {
  config.pixelFilter = rl::RL_FILTER_CENTER;
  const auto image = [&](const char* firstHit) {
    SessionConfig c = config;
    c.backend = where.backend;
    c.rayTracing = where.rayTracing;
    c.parameters["first_hit"] = std::string(firstHit);
    Session session(sceneNamed(scene), c);
    for (int i = 0; i < 3; ++i) session.frame();
    return session.radiance();
  };
  return countDifferent(image("rays"), image("raster"));
}

TEST(RasterMethods, LocalIsThatOfRays) {
  for (const Machine& where : {kCpuEmbree, kVulkanSpecialised}) {
    if (std::string(where.backend) == "vulkan" && !hasVulkan()) continue;
    for (const char* scene : {"glossy-gallery", "course"}) {
      SessionConfig config = configOf({"local", "", ""}, where, 64, 48, 5);
      config.parameters = {{"preset", std::string("reflections")},
                           {"occlusion", std::string("screen")}};
      const FrameDifference difference = againstRays(scene, where, config);
      EXPECT_LE(difference.different, 12u) << scene << " " << where.name << difference.text();
    }
  }
}

// Corners are lit once in the vertex stage, or in every pixel that needs them.
TEST(RasterMethods, GouraudOfTheVertexStageIsThatOfPixels) {
  for (const Machine& where : {kCpuEmbree, kVulkanSpecialised}) {
    if (std::string(where.backend) == "vulkan" && !hasVulkan()) continue;
    for (const char* model : {"lambert", "phong", "blinn_phong"}) {
      for (const char* shadows : {"rays", "map"}) {
        // One of both with triangles in parts.
        const int64_t divisions = shadows == std::string("map") ? 2 : 0;
        SessionConfig config = configOf({"local", "", ""}, where, 64, 48, 5);
        config.parameters = {{"shading", std::string("gouraud")},
                             {"model", std::string(model)},
                             {"divisions", divisions},
                             {"shadows", std::string(shadows)},
                             {"shadow_map_size", int64_t{64}},
                             {"light_samples", int64_t{0}}};
        const FrameDifference difference = againstRays("floor?spots=3", where, config);
        EXPECT_LE(difference.different, 8u) << model << shadows << where.name << difference.text();
      }
    }
  }
}

TEST(RasterMethods, ReuseAndDenoisersTakeThem) {
  const Combination gi{"restir_gi", "unbiased", "pixel"}, filtered{"path", "", "", "svgf"};
  for (const Machine& where : {kCpuEmbree, kVulkanSpecialised}) {
    if (std::string(where.backend) == "vulkan" && !hasVulkan()) continue;
    SessionConfig whole = configOf(filtered, where, 64, 48, 5);
    whole.parameters["demodulate"] = std::string("none");
    for (const SessionConfig& config :
         {configOf(gi, where, 64, 48, 5), configOf(filtered, where, 64, 48, 5), whole}) {
      const FrameDifference difference = againstRays("glossy-gallery", where, config);
      // A pixel at an edge changes its neighbours.
      EXPECT_LE(difference.different, 120u)
          << config.integrator << " " << config.denoiser << " " << where.name << difference.text();
    }
  }
}

// The boxes of shapes are a table of the host. Written before all buffers were there, it parted
// them, and a software driver compiled kernels that read by address, for minutes.
TEST(RasterMethods, TablesLeaveBuffersTogether) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  SessionConfig config = configOf({"local", "", ""}, kVulkanSpecialised, 16, 16, 5);
  const auto readsTexels = [&](const char* firstHit) {
    config.parameters["first_hit"] = std::string(firstHit);
    return Session(sceneNamed("shape-furnace"), config).startup().readsTexels;
  };
  EXPECT_EQ(readsTexels("raster"), readsTexels("rays"));
}

// All pixels of a frame share the film sample, and frames cover the pixel.
TEST(RasterMethods, FramesCoverThePixel) {
  SessionConfig config = configOf({"local", "", ""}, kCpuEmbree, 32, 32, 5);
  config.parameters = {{"model", std::string("lambert")}, {"light_samples", int64_t{0}}};
  const auto mean = [&](const char* firstHit) {
    SessionConfig c = config;
    c.parameters["first_hit"] = std::string(firstHit);
    Session session(sceneNamed("floor?spots=3"), c);
    double sum = 0.0;
    for (int frame = 0; frame < 256; ++frame) {
      session.frame();
      for (const glm::vec3& pixel : session.radiance().pixels) sum += double(pixel.x);
    }
    return sum;
  };
  const double rays = mean("rays");
  EXPECT_NEAR(mean("raster"), rays, 2e-3 * rays);
}

}  // namespace
}  // namespace restlab::parity
