// Cameras: rays through the film and projection back, both kinds, any shape of film; film samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/goodness.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

std::shared_ptr<const CompiledScene> anyScene() {
  builtin::SceneBuilder builder("off centre");
  builder.add(builtin::quad("floor", {40, -1, 7}, {0, 0, 2}, {2, 0, 0}),
              builder.addMaterial("floor", builtin::lambert(glm::vec3(0.5f))));
  return CompiledScene::build(builder.finish());
}

SceneCamera lookingDownX(uint32_t kind) {
  SceneCamera camera;
  camera.kind = kind;
  camera.yfov = 0.9;
  camera.ymag = 1.5;
  // Looks from (1, 2, 3) towards +X, rolled a little.
  camera.cameraToWorld =
      glm::inverse(glm::lookAt(glm::dvec3(1, 2, 3), glm::dvec3(9, 2, 3), glm::dvec3(0, 1, 0.3)));
  return camera;
}

TEST(Camera, AxesAndFieldOfView) {
  const auto scene = anyScene();
  Dialect<> d(scene);
  const glm::vec3 eye(glm::dvec3(1, 2, 3) - scene->origin());
  const rl::Camera c = scene->camera(lookingDownX(rl::RL_CAMERA_PERSPECTIVE), 640, 360);
  EXPECT_LT(glm::distance(c.posW, eye), 1e-5f);
  EXPECT_LT(glm::distance(c.forwardW, glm::vec3(1, 0, 0)), 1e-6f);
  EXPECT_NEAR(glm::dot(glm::cross(c.rightW, c.upW), -c.forwardW), 1.0f, 1e-6f);
  EXPECT_NEAR(c.halfHeight, std::tan(0.45), 1e-6);
  EXPECT_NEAR(c.halfWidth, std::tan(0.45) * 640.0 / 360.0, 1e-6);
  // Film (0, 0) is the upper left corner: left of and above the axis.
  const rl::Ray corner = d->cameraRay(c, {0.0f, 0.0f}, {640.0f, 360.0f});
  EXPECT_LT(glm::dot(corner.dir, c.rightW), 0.0f);
  EXPECT_GT(glm::dot(corner.dir, c.upW), 0.0f);
  const rl::Ray top = d->cameraRay(c, {320.0f, 0.0f}, {640.0f, 360.0f});
  EXPECT_NEAR(std::acos(glm::dot(top.dir, c.forwardW)), 0.45, 1e-5);
  EXPECT_EQ(top.tMin, 0.0f);
}

TEST(Camera, ProjectionIsTheInverseOfTheRay) {
  const auto scene = anyScene();
  Dialect<> d(scene);
  Inputs inputs(1);
  for (uint32_t kind : {rl::RL_CAMERA_PERSPECTIVE, rl::RL_CAMERA_ORTHOGRAPHIC}) {
    for (const glm::uvec2 size :
         {glm::uvec2(512, 512), glm::uvec2(640, 360), glm::uvec2(90, 400), glm::uvec2(1, 1)}) {
      const rl::Camera c = scene->camera(lookingDownX(kind), size.x, size.y);
      const glm::vec2 resolution(size);
      for (int i = 0; i < 20'000; ++i) {
        const glm::vec2 film = inputs.square() * resolution;
        const rl::Ray ray = d->cameraRay(c, film, resolution);
        ASSERT_NEAR(glm::length(ray.dir), 1.0f, 1e-6f);
        const glm::vec3 point = ray.origin + ray.dir * inputs.scale(0.1f, 100.0f);
        glm::vec2 back;
        ASSERT_TRUE(d->cameraProject(c, point, resolution, back));
        // Float positions at a hundred metres resolve a hundredth of a pixel.
        ASSERT_LT(glm::distance(back, film), 1e-2f);
      }
    }
  }
}

// A window of 16 x 12 pixels at (40, 8) of a film of 64 x 48.
TEST(Camera, AWindowShowsItsPartOfTheFilm) {
  const auto scene = anyScene();
  Dialect<> d(scene);
  for (uint32_t kind : {rl::RL_CAMERA_PERSPECTIVE, rl::RL_CAMERA_ORTHOGRAPHIC}) {
    const SceneCamera whole = lookingDownX(kind);
    SceneCamera window = whole;
    const double half =
        kind == rl::RL_CAMERA_ORTHOGRAPHIC ? whole.ymag : std::tan(0.5 * whole.yfov);
    window.ymag = 0.25 * half;
    window.yfov = 2.0 * std::atan(0.25 * half);
    window.shift = {half * 64.0 / 48.0 * (2.0 * 48.0 / 64.0 - 1.0),
                    half * (1.0 - 2.0 * 14.0 / 48.0)};
    const rl::Camera a = scene->camera(whole, 64, 48), b = scene->camera(window, 16, 12);
    for (float x = 0.0f; x <= 16.0f; x += 4.0f) {
      for (float y = 0.0f; y <= 12.0f; y += 3.0f) {
        const rl::Ray ofWhole = d->cameraRay(a, {40.0f + x, 8.0f + y}, {64.0f, 48.0f}),
                      ofWindow = d->cameraRay(b, {x, y}, {16.0f, 12.0f});
        EXPECT_LT(glm::distance(ofWhole.origin, ofWindow.origin), 1e-5f);
        EXPECT_LT(glm::distance(ofWhole.dir, ofWindow.dir), 1e-6f);
        glm::vec2 film;
        ASSERT_TRUE(d->cameraProject(b, ofWhole.origin + ofWhole.dir * 3.0f, {16.0f, 12.0f}, film));
        EXPECT_LT(glm::distance(film, glm::vec2(x, y)), 1e-3f);
      }
    }
  }
}

TEST(Camera, NothingProjectsFromBehindAPerspectiveCamera) {
  const auto scene = anyScene();
  Dialect<> d(scene);
  const rl::Camera c = scene->camera(lookingDownX(rl::RL_CAMERA_PERSPECTIVE), 64, 64);
  glm::vec2 film;
  EXPECT_FALSE(d->cameraProject(c, c.posW - c.forwardW, {64.0f, 64.0f}, film));
  EXPECT_FALSE(d->cameraProject(c, c.posW, {64.0f, 64.0f}, film));
  EXPECT_FALSE(d->cameraProject(c, c.posW + c.rightW, {64.0f, 64.0f}, film));
}

struct FilmTest : testing::Test {
  Dialect<> d;
  FilmTest() {
    d.frame.width = 32;
    d.frame.height = 16;
    d.frame.seed = 3;
  }
};

TEST_F(FilmTest, BoxFilterIsUniformOverThePixel) {
  d.frame.pixelFilter = rl::RL_FILTER_BOX;
  std::vector<uint64_t> counts(16 * 16);
  for (d.frame.frame = 0; d.frame.frame < 2000; ++d.frame.frame) {
    for (uint32_t y = 0; y < 16; ++y) {
      for (uint32_t x = 0; x < 32; ++x) {
        const glm::vec2 offset =
            d->cameraFilmPoint({x, y}, d->cameraFilmBits({x, y})) - glm::vec2(float(x), float(y));
        ASSERT_TRUE(offset.x >= 0.0f && offset.x <= 1.0f && offset.y >= 0.0f && offset.y <= 1.0f);
        ++counts[std::min(size_t(offset.y * 16.0f), size_t(15)) * 16 +
                 std::min(size_t(offset.x * 16.0f), size_t(15))];
      }
    }
  }
  expectUniform(counts, "film samples");
}

TEST_F(FilmTest, CenterFilterIsTheCentre) {
  d.frame.pixelFilter = rl::RL_FILTER_CENTER;
  EXPECT_EQ(d->cameraFilmPoint({3, 7}, d->cameraFilmBits({3, 7})), glm::vec2(3.5f, 7.5f));
}

// Samples differ in every frame, are uniform over seeds, and their bits give their position
// exactly.
TEST_F(FilmTest, SamplesAreFreshAndTheirBitsAreTheirPlace) {
  d.frame.pixelFilter = rl::RL_FILTER_BOX;
  std::set<uint32_t> seen;
  for (d.frame.frame = 0; d.frame.frame < 64; ++d.frame.frame)
    seen.insert(d->cameraFilmBits({9, 9}));
  EXPECT_EQ(seen.size(), 64u);
  std::vector<uint64_t> counts(16);
  d.frame.frame = 13;
  for (d.frame.seed = 0; d.frame.seed < 100'000; ++d.frame.seed) {
    const uint32_t bits = d->cameraFilmBits({9, 9});
    const glm::vec2 offset = d->cameraFilmPoint({9, 9}, bits) - glm::vec2(9.0f, 9.0f);
    ASSERT_EQ(uint32_t(offset.x * 65536.0f), bits & 0xffffu);
    ASSERT_EQ(uint32_t(offset.y * 65536.0f), bits >> 16);
    ++counts[std::min(size_t(offset.y * 4.0f), size_t(3)) * 4 +
             std::min(size_t(offset.x * 4.0f), size_t(3))];
  }
  expectUniform(counts, "film samples of one frame over seeds");
}

// From any frame on, a few frames cover the pixel: every cell of 4 x 4 gets two to six of 64
// samples. (With independent samples one cell of sixteen misses that in a tenth of all tries.)
TEST_F(FilmTest, AFewFramesCoverThePixelEvenly) {
  for (uint32_t x = 0; x < 32; ++x) {
    std::vector<uint32_t> counts(16);
    for (d.frame.frame = 5 * x; d.frame.frame < 5 * x + 64; ++d.frame.frame) {
      const uint32_t bits = d->cameraFilmBits({x, 5});
      ++counts[(bits >> 30) * 4 + ((bits & 0xffffu) >> 14)];
    }
    for (const uint32_t count : counts) {
      EXPECT_GE(count, 2u) << "pixel " << x;
      EXPECT_LE(count, 6u) << "pixel " << x;
    }
  }
}

}  // namespace
}  // namespace restlab::unit
