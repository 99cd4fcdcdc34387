// Content that enters the view by less than a pixel per frame must not take the border's history.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"
#include "tests/denoise/layered_images.h"

namespace restlab::denoise {
namespace {

constexpr glm::uvec2 kBorderSize = {32, 8};

// View from above; the image is 4 m wide, centred on x.
SceneCamera above(double x) {
  SceneCamera camera;
  camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  camera.xmag = 2.0;
  camera.ymag = 0.5;
  camera.cameraToWorld = glm::dmat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, x, 5, 0, 1);
  return camera;
}

// Floor under one lamp beside the image, whose light falls to a small fraction across the image.
// Free of noise: one light, one scattering event.
std::shared_ptr<const CompiledScene> darkeningFloor() {
  builtin::SceneBuilder builder("darkening floor");
  builder.add(builtin::quad("floor", {-40, 0, -40}, {0, 0, 80}, {80, 0, 0}),
              builder.addMaterial("floor", builtin::lambert(glm::vec3(0.5f))));
  PunctualLight lamp;
  lamp.posW = {-4.0, 2.0, 0.0};
  lamp.intensity = glm::vec3(20.0f);
  builder.addLight(lamp);
  Scene scene = builder.finish();
  scene.cameras = {above(0.0)};
  return CompiledScene::build(scene);
}

double lightOfLastColumns(const Image& image) {
  double sum = 0.0;
  for (uint32_t y = 0; y < kBorderSize.y; ++y) {
    for (uint32_t x = kBorderSize.x - 4; x < kBorderSize.x; ++x)
      sum += double(image.pixels[size_t(y) * kBorderSize.x + x].y);
  }
  return sum;
}

class Border : public testing::TestWithParam<const char*> {};

TEST_P(Border, ShowsWhatComesIntoView) {
  const auto scene = darkeningFloor();
  const double pixel = 4.0 / kBorderSize.x;
  for (const double speed : {0.2, 0.45, 0.7}) {
    SessionConfig config = filterConfig(GetParam(), kBorderSize);
    config.maxBounces = 1;
    Session session(scene, config);
    double x = 0.0;
    for (int frame = 0; frame < 60; ++frame, x += speed * pixel) {
      session.setCamera(above(x));
      session.frame();
    }
    Session plain(scene, [&] {
      SessionConfig none = filterConfig("none", kBorderSize);
      none.maxBounces = 1;
      return none;
    }());
    plain.setCamera(above(x - speed * pixel));
    plain.frame();
    EXPECT_NEAR(lightOfLastColumns(session.radiance()) / lightOfLastColumns(plain.radiance()), 1.0,
                0.08)
        << speed << " pixels a frame";
  }
}

INSTANTIATE_TEST_SUITE_P(Denoisers, Border, testing::Values("accumulate", "svgf", "asvgf"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace restlab::denoise
