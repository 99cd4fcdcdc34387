// `local` against its formulas, computed here in double precision: the lecture's shader in each
// pixel, Gouraud's interpolation, one value a triangle; occlusion at a wall; direct light as `path`
// finds it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/frame/session.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {
namespace {

using builtin::SceneBuilder;
using Vec = glm::dvec3;

const Vec kColour(0.7, 0.4, 0.2), kLamp(-0.2, 1.5, -1.5), kEye(0.5, 2.5, 3.0);
constexpr double kIntensity = 9.0, kPi = 3.14159265358979323846;
constexpr uint32_t kWidth = 32, kHeight = 24;

// A square of 2 m in two triangles, a point light above it.
struct Floor {
  Scene scene;
  std::shared_ptr<const CompiledScene> compiled;

  Floor() : scene(make()), compiled(CompiledScene::build(scene)) {}

  static Scene make() {
    SceneBuilder builder("floor");
    builder.add(builtin::quad("floor", {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}),
                builder.addMaterial("colour", builtin::lambert(glm::vec3(kColour))));
    PunctualLight light;
    light.posW = kLamp;
    light.intensity = glm::vec3(float(kIntensity));
    builder.addLight(light);
    builder.addCamera("eye", kEye, {0, 0, 0}, 45.0);
    return builder.finish();
  }

  // Where the centre of a pixel shows the square; none outside of it.
  std::optional<Vec> pointAt(uint32_t x, uint32_t y) const {
    const SceneCamera& camera = scene.cameras.at(0);
    const double height = std::tan(0.5 * camera.yfov), aspect = double(kWidth) / kHeight;
    const glm::dvec4 local((2.0 * (x + 0.5) / kWidth - 1.0) * height * aspect,
                           (1.0 - 2.0 * (y + 0.5) / kHeight) * height, -1.0, 0.0);
    const Vec dir = Vec(camera.cameraToWorld * local), eye = positionOf(camera);
    const Vec p = eye + dir * (-eye.y / dir.y);
    if (std::abs(p.x) > 0.999 || std::abs(p.z) > 0.999) return std::nullopt;
    return p;
  }
};

// The lecture's shader at a point of the floor: the light's irradiance over pi stands for its
// brightness.
Vec lecture(const Vec& p, double ambient = 0.05, double highlight = 0.4, double power = 20.0) {
  const Vec n(0, 1, 0), l = glm::normalize(kLamp - p), e = glm::normalize(kEye - p);
  const double brightness = kIntensity / glm::dot(kLamp - p, kLamp - p) / kPi;
  const double cosine = std::max(glm::dot(n, l), 0.0);
  const Vec r = 2.0 * glm::dot(n, l) * n - l;
  const double lobe = highlight * std::pow(std::max(glm::dot(r, e), 0.0), power);
  return kColour * ambient + brightness * (kColour * cosine + Vec(lobe));
}

Image render(const Floor& floor, ParameterMap parameters) {
  SessionConfig config;
  config.integrator = "local";
  config.width = kWidth;
  config.height = kHeight;
  config.threads = 1;
  config.pixelFilter = rl::RL_FILTER_CENTER;
  config.parameters = std::move(parameters);
  Session session(floor.compiled, config);
  session.frame();
  return session.radiance();
}

// Compares every pixel that shows the square with `expected` at its point.
template <class Expected>
void expectEverywhere(const Floor& floor, const ParameterMap& parameters, Expected expected) {
  const Image image = render(floor, parameters);
  size_t compared = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const std::optional<Vec> p = floor.pointAt(x, y);
      if (!p) continue;
      const Vec truth = expected(*p), found(image.pixels[y * kWidth + x]);
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], truth[c], 1e-5 * truth[c]) << x << " " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 140u);
}

const ParameterMap kPhong = {{"model", std::string("phong")}, {"ambient", 0.05}};

ParameterMap with(ParameterMap map, const std::string& name, const std::string& value) {
  map[name] = value;
  return map;
}

TEST(Local, ThePresetIsTheLecturesShader) {
  expectEverywhere(Floor(), {{"preset", std::string("lecture")}},
                   [](const Vec& p) { return lecture(p); });
}

TEST(Local, ParametersAreThoseOfTheFormula) {
  ParameterMap map = kPhong;
  map["highlight"] = 1.5;
  map["highlight_power"] = 7.0;
  map["ambient"] = 0.25;
  expectEverywhere(Floor(), map, [](const Vec& p) { return lecture(p, 0.25, 1.5, 7.0); });
}

TEST(Local, BlinnPhongMeasuresTheHalfVector) {
  expectEverywhere(Floor(), with(kPhong, "model", "blinn_phong"), [](const Vec& p) {
    const Vec h = glm::normalize(glm::normalize(kLamp - p) + glm::normalize(kEye - p));
    const double brightness = kIntensity / glm::dot(kLamp - p, kLamp - p) / kPi;
    return lecture(p, 0.05, 0.0) + Vec(brightness * 0.4 * std::pow(h.y, 20.0));
  });
}

// Corners of the triangle that holds a point: both share the diagonal from (-1, 1) to (1, -1).
std::array<Vec, 3> cornersAround(const Vec& p) {
  const Vec a(-1, 0, 1), c(1, 0, -1);
  const Vec third = p.x + p.z > 0.0 ? Vec(1, 0, 1) : Vec(-1, 0, -1);
  return {a, third, c};
}

TEST(Local, GouraudInterpolatesTheCornersAndMissesTheHighlight) {
  const Floor floor;
  const auto interpolated = [](const Vec& p) {
    const auto [a, b, c] = cornersAround(p);
    const auto area = [](const Vec& u, const Vec& v, const Vec& w) {
      return std::abs(glm::cross(v - u, w - u).y);
    };
    const double whole = area(a, b, c);
    return (lecture(a) * area(p, b, c) + lecture(b) * area(a, p, c) + lecture(c) * area(a, b, p)) /
           whole;
  };
  expectEverywhere(floor, with(kPhong, "shading", "gouraud"), interpolated);
  // Phong's highlight lies within the square.
  double brightest = 0.0, ofGouraud = 0.0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      if (const std::optional<Vec> p = floor.pointAt(x, y)) {
        brightest = std::max(brightest, lecture(*p).z);
        ofGouraud = std::max(ofGouraud, interpolated(*p).z);
      }
    }
  }
  EXPECT_GT(brightest, 1.5 * ofGouraud);
}

TEST(Local, FlatIsOneValueATriangle) {
  expectEverywhere(Floor(), with(kPhong, "shading", "flat"), [](const Vec& p) {
    const auto [a, b, c] = cornersAround(p);
    return lecture((a + b + c) / 3.0);
  });
}

// Without light, a floor and a wall that is wide against its distance: the wall hides half of the
// sky, by symmetry. Nearer than the radius alone.
TEST(Local, AWallHidesHalfOfTheAmbientLight) {
  SceneBuilder builder("corner");
  const uint32_t white = builder.addMaterial("white", builtin::lambert(glm::vec3(0.5f)));
  builder.add(builtin::quad("floor", {-1e3, 0, 1e3}, {2e3, 0, 0}, {0, 0, -2e3}), white);
  builder.add(builtin::quad("wall", {-1e3, 0, -1}, {2e3, 0, 0}, {0, 1e3, 0}), white);
  builder.addCamera("eye", {0, 2, 0.2}, {0, 0, 0}, 5.0);
  const auto scene = CompiledScene::build(builder.finish());
  const auto meanAt = [&](double radius) {
    SessionConfig config;
    config.integrator = "local";
    config.width = config.height = 32;
    config.threads = 1;
    config.parameters = {{"occlusion", std::string("rays")},
                         {"occlusion_rays", int64_t{64}},
                         {"occlusion_radius", radius},
                         {"ambient", 2.0}};
    Session session(scene, config);
    session.frame();
    double sum = 0.0;
    for (const glm::vec3& p : session.radiance().pixels) sum += double(p.x) / (32.0 * 32.0);
    return sum;
  };
  // 65536 rays: a standard error of 0.002 of 1.
  EXPECT_NEAR(meanAt(0.0), 0.5, 0.01);
  EXPECT_NEAR(meanAt(0.5), 1.0, 1e-6);
}

// One light sample without MIS has the mean of `path`'s direct light.
TEST(Local, ShadowRaysAreDirectLight) {
  const auto scene = CompiledScene::build(makeBuiltinScene("cornell-box"));
  const auto meansOf = [&](const std::string& integrator) {
    SessionConfig config;
    config.integrator = integrator;
    config.width = config.height = 16;
    config.threads = 1;
    config.maxBounces = 1;
    Session session(scene, config);
    constexpr int kFrames = 512;
    Image mean(16, 16);
    for (int i = 0; i < kFrames; ++i) {
      session.frame();
      for (size_t p = 0; p < mean.pixels.size(); ++p)
        mean.pixels[p] += session.radiance().pixels[p] * (1.0f / kFrames);
    }
    return mean;
  };
  const Image local = meansOf("local"), path = meansOf("path");
  double sum = 0.0, truth = 0.0;
  for (size_t p = 0; p < local.pixels.size(); ++p) {
    sum += double(local.pixels[p].x);
    truth += double(path.pixels[p].x);
  }
  EXPECT_NEAR(sum / truth, 1.0, 0.01);
}

TEST(Local, ReflectionsShowWhatIsLit) {
  const auto sumOf = [](const std::string& scene, const std::string& reflections) {
    SessionConfig config;
    config.integrator = "local";
    config.width = config.height = 32;
    config.threads = 1;
    config.parameters = {{"reflections", reflections}};
    Session session(CompiledScene::build(makeBuiltinScene(scene)), config);
    session.frame();
    double sum = 0.0;
    for (const glm::vec3& p : session.radiance().pixels) sum += double(p.y);
    return sum;
  };
  // Smooth glass; rough metal, whose lobes are no mirror's.
  EXPECT_GT(sumOf("glass", "mirror"), 1.01 * sumOf("glass", "none"));
  EXPECT_EQ(sumOf("glossy-gallery", "mirror"), sumOf("glossy-gallery", "none"));
  EXPECT_GT(sumOf("glossy-gallery", "glossy"), 1.01 * sumOf("glossy-gallery", "none"));
}

}  // namespace
}  // namespace restlab
