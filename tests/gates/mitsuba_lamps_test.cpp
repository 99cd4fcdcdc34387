// Light of Mitsuba's emitters on a diffuse floor, and in closed rooms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/truths/polygon_irradiance.h"
#include "tests/gates/known_pixels.h"

namespace restlab::gates {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::dvec3 kOfFloor(0.5, 0.6, 0.7), kOfLamp(6.0, 4.0, 2.0), kUp(0.0, 1.0, 0.0);

// The floor y = 0, from above.
const std::string kFloor =
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"50\"/>"
    "<rotate x=\"1\" angle=\"-90\"/></transform><bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
    "value=\"0.5 0.6 0.7\"/></bsdf></shape>\n";
const std::string kAreaLamp =
    "<emitter type=\"area\"><rgb name=\"radiance\" value=\"6 4 2\"/></emitter>";

// A view of the floor around the origin; all pixels show it.
struct FloorView {
  KnownScene scene;
  TheirCamera camera;
};
FloorView floorView(const std::string& name, const std::string& lamps, const glm::dvec3& origin,
                    uint32_t width = 12, uint32_t frames = 64) {
  FloorView view;
  view.scene.name = name;
  view.scene.width = width;
  view.scene.height = width * 2 / 3;
  view.scene.frames = frames;
  view.scene.xml = sensorXml(fmt::format("{},{},{}", origin.x, origin.y, origin.z), "0,0,0",
                             "0,1,0", 40.0, view.scene) +
                   kFloor + lamps;
  view.camera = lookingAt(origin, glm::dvec3(0.0), kUp, 40.0, view.scene);
  return view;
}

// The floor under an irradiance over the lamp's radiance, which is a projected solid angle.
PixelTruth lit(const FloorView& view, double factor,
               std::function<double(const glm::dvec3& posW)> projected) {
  return meanOver(view.camera, [=](const glm::dvec3& origin, const glm::dvec3& dir) {
    return kOfFloor * kOfLamp * (factor / kPi * projected(floorOf(origin, dir)));
  });
}

// A leaning lamp of 2 x 1 metres, by Lambert's formula.
TEST(MitsubaTruths, ARectangleOverAFloor) {
  const auto corners = [](double degrees) {
    // Scaled, turned face down and leaning about X, then lifted.
    std::vector<glm::dvec3> found;
    const double a = degrees * kPi / 180.0;
    for (const glm::dvec2 c : {glm::dvec2(-1, -1), glm::dvec2(1, -1), {1, 1}, {-1, 1}})
      found.emplace_back(0.5 * c.x + 0.3, std::cos(a) * c.y + 0.0 * a, std::sin(a) * c.y - 1.0);
    for (glm::dvec3& c : found) c.y += 1.2;
    return found;
  };
  const FloorView view = floorView(
      "rectangle over a floor",
      "<shape type=\"shapegroup\" id=\"lamps\"><shape type=\"rectangle\"><transform "
      "name=\"to_world\"><scale x=\"0.5\"/><rotate x=\"1\" angle=\"60\"/></transform>" +
          kAreaLamp +
          "</shape></shape><shape type=\"instance\"><ref id=\"lamps\"/><transform "
          "name=\"to_world\"><translate x=\"0.3\" y=\"1.2\" z=\"-1\"/></transform></shape>",
      {0.0, 3.0, 3.0});
  const auto truth = [&](double degrees, double factor) {
    return lit(view, factor, [c = corners(degrees)](const glm::dvec3& posW) {
      return std::abs(analytic::projectedSolidAngle(c, posW, kUp));
    });
  };
  expectPixels(view.scene, truth(60.0, 1.0),
               {{"radiance + 2 %", truth(60.0, 1.02)}, {"leans by 75 degrees", truth(75.0, 1.0)}});
}

// Irradiance over radiance from a sphere that the horizon may cut: sine of its half angle, cosine
// to its centre (Snyder 1996).
double sphereOverHorizon(double sineOfSize, double cosine) {
  const double size = std::asin(sineOfSize), slope = std::acos(cosine);
  const double whole = kPi * cosine * sineOfSize * sineOfSize;
  if (slope <= 0.5 * kPi - size) return whole;
  if (slope >= 0.5 * kPi + size) return 0.0;
  const double sine = std::sin(slope);
  const double gamma = std::asin(std::clamp(std::cos(size) / sine, -1.0, 1.0));
  const double g = -2.0 * sine * std::cos(size) * std::cos(gamma) + 0.5 * kPi - gamma +
                   std::sin(gamma) * std::cos(gamma);
  const double root =
      std::sqrt(std::max(0.0, sineOfSize * sineOfSize - std::cos(gamma) * std::cos(gamma)));
  const double h = cosine * (std::cos(gamma) * root +
                             sineOfSize * sineOfSize *
                                 std::asin(std::clamp(std::cos(gamma) / sineOfSize, -1.0, 1.0)));
  return slope <= 0.5 * kPi ? whole + g - h : g + h;
}

// The formula beside a sum over directions.
TEST(MitsubaTruths, SpheresCutByTheHorizon) {
  for (const double cosine : {0.9, 0.3, 0.05, -0.1, -0.3}) {
    const double sineOfSize = 0.5, size = std::asin(sineOfSize);
    const glm::dvec3 z(std::sqrt(1.0 - cosine * cosine), cosine, 0.0), x(0.0, 0.0, 1.0),
        y = glm::cross(z, x);
    constexpr int kSteps = 2000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < 400; ++j) {
        const double a = size * (i + 0.5) / kSteps, b = 2.0 * kPi * (j + 0.5) / 400;
        const glm::dvec3 d = z * std::cos(a) + (x * std::cos(b) + y * std::sin(b)) * std::sin(a);
        sum += std::max(d.y, 0.0) * std::sin(a) * (size / kSteps) * (2.0 * kPi / 400);
      }
    EXPECT_NEAR(sphereOverHorizon(sineOfSize, cosine), sum, 2e-5) << cosine;
  }
}

TEST(MitsubaTruths, SpheresOverAndInAFloor) {
  for (const double height : {0.9, 0.15, -0.15}) {
    const glm::dvec3 centre(0.0, height, -2.0);
    FloorView view = floorView(
        fmt::format("sphere at a height of {}", height),
        fmt::format("<shape type=\"sphere\"><float name=\"radius\" value=\"0.25\"/><point "
                    "name=\"center\" x=\"0\" y=\"{}\" z=\"-1\"/><transform name=\"to_world\">"
                    "<scale value=\"2\"/></transform>{}</shape>",
                    0.5 * height, kAreaLamp),
        {0.0, 2.0, 2.0});
    if (height < 0.5) view.scene.frames = 256;
    const auto truth = [&](double radius, double factor) {
      return lit(view, factor, [=](const glm::dvec3& posW) {
        const glm::dvec3 to = centre - posW;
        return sphereOverHorizon(radius / glm::length(to), to.y / glm::length(to));
      });
    };
    expectPixels(view.scene, truth(0.5, 1.0),
                 {{"radiance + 2 %", truth(0.5, 1.02)}, {"radius + 1 %", truth(0.505, 1.0)}});
  }
}

// A disk that faces a parallel floor.
TEST(MitsubaTruths, ADiskOverAFloor) {
  const FloorView view =
      floorView("disk over a floor",
                "<shape type=\"disk\"><transform name=\"to_world\"><scale value=\"0.8\"/>"
                "<rotate x=\"1\" angle=\"90\"/><translate x=\"0.2\" y=\"1.5\" z=\"-0.5\"/>"
                "</transform>" +
                    kAreaLamp + "</shape>",
                {0.0, 1.4, 3.0});
  const auto truth = [&](double radius, double factor) {
    return lit(view, factor, [=](const glm::dvec3& posW) {
      const double h2 = 1.5 * 1.5, r2 = radius * radius;
      const double a2 = (posW.x - 0.2) * (posW.x - 0.2) + (posW.z + 0.5) * (posW.z + 0.5);
      const double sum = a2 + h2 + r2;
      return 0.5 * kPi * (1.0 - (a2 + h2 - r2) / std::sqrt(sum * sum - 4.0 * r2 * a2));
    });
  };
  expectPixels(view.scene, truth(0.8, 1.0),
               {{"radiance + 2 %", truth(0.8, 1.02)}, {"radius + 1 %", truth(0.808, 1.0)}});
}

double fromPoint(const glm::dvec3& lamp, const glm::dvec3& posW) {
  const glm::dvec3 to = lamp - posW;
  return to.y / std::pow(glm::length(to), 3.0);
}

// Irradiance on the floor of red light.
PixelTruth litByOne(const FloorView& view, std::function<double(const glm::dvec3& posW)> e) {
  return meanOver(view.camera, [=](const glm::dvec3& origin, const glm::dvec3& dir) {
    return glm::dvec3(kOfFloor.x / kPi * e(floorOf(origin, dir)), 0.0, 0.0);
  });
}

TEST(MitsubaTruths, APoint) {
  const FloorView view =
      floorView("point",
                "<emitter type=\"point\"><rgb name=\"intensity\" value=\"5 0 0\"/><point "
                "name=\"position\" x=\"0.5\" y=\"1\" z=\"0\"/></emitter>",
                {0.0, 3.0, 3.0});
  const auto truth = [&](double height, double intensity) {
    return litByOne(view, [=](const glm::dvec3& posW) {
      return intensity * fromPoint({0.5, height, 0.0}, posW);
    });
  };
  expectPixels(view.scene, truth(1.0, 5.0),
               {{"1 % higher", truth(1.01, 5.0)}, {"intensity + 2 %", truth(1.0, 5.1)}});
}

// In its beam a spot is constant, and outside of its cone dark. Pixels that reach between, within
// a degree, are not judged.
TEST(MitsubaTruths, ASpot) {
  const FloorView view = floorView(
      "spot",
      "<emitter type=\"spot\"><rgb name=\"intensity\" value=\"7 0 0\"/><float "
      "name=\"cutoff_angle\" value=\"24\"/><float name=\"beam_width\" value=\"22\"/><transform "
      "name=\"to_world\"><lookat origin=\"1,2,0\" target=\"-0.5,0,0\" up=\"0,0,1\"/></transform>"
      "</emitter>",
      {0.0, 3.0, 3.0}, 30, 8);
  const glm::dvec3 spot(1.0, 2.0, 0.0), axis = glm::normalize(glm::dvec3(-1.5, -2.0, 0.0));
  const auto truth = [&](double beam, double intensity) {
    return litByOne(view, [=](const glm::dvec3& posW) {
      const double off = std::acos(glm::dot(glm::normalize(posW - spot), axis)) * 180.0 / kPi;
      const double share = off < beam - 1.0 ? 1.0 : off > beam + 3.0 ? 0.0 : std::nan("");
      return intensity * share * fromPoint(spot, posW);
    });
  };
  expectPixels(
      view.scene, truth(22.0, 7.0),
      {{"a beam of 25 degrees", truth(25.0, 7.0)}, {"intensity + 2 %", truth(22.0, 7.14)}});
}

TEST(MitsubaTruths, ADirection) {
  const FloorView view = floorView("directional",
                                   "<emitter type=\"directional\"><rgb name=\"irradiance\" "
                                   "value=\"3 0 0\"/><vector name=\"direction\" x=\"1\" "
                                   "y=\"-2\" z=\"0.5\"/></emitter>",
                                   {0.0, 3.0, 3.0});
  const auto truth = [&](double slope) {
    return litByOne(view, [=](const glm::dvec3&) {
      return 3.0 * slope / std::sqrt(1.0 + slope * slope + 0.25);
    });
  };
  expectPixels(view.scene, truth(2.0), {{"1 % steeper", truth(2.02)}});
}

// A room that shines and scatters everywhere: paths of d segments bring 1 + r + ... + r^(d - 1).
TEST(MitsubaTruths, ClosedRooms) {
  const glm::dvec3 albedo(0.5, 0.8, 0.3), radiance(1.0, 0.5, 2.0);
  const auto truth = [&](uint32_t segments, double factor) {
    glm::dvec3 sum(0.0), power(1.0);
    for (uint32_t i = 0; i < segments; ++i, power *= albedo) sum += power;
    return [=](uint32_t, uint32_t) { return factor * radiance * sum; };
  };
  for (const char* shape : {"cube", "sphere"})
    for (const uint32_t segments : {1u, 2u, 3u, 7u}) {
      KnownScene scene{.name = fmt::format("room in a {}, {} segments", shape, segments),
                       .xml = {},
                       .width = 12,
                       .height = 8,
                       .bounces = 99};
      scene.xml =
          sensorXml("0.2,0.1,0", "0.9,0.5,0.7", "0,1,0", 90.0, scene) +
          fmt::format(
              "<integrator type=\"path\"><integer name=\"max_depth\" value=\"{}\"/>"
              "</integrator><shape type=\"{}\"><boolean name=\"flip_normals\" value=\"true\"/>"
              "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.5 0.8 "
              "0.3\"/></bsdf><emitter type=\"area\"><rgb name=\"radiance\" "
              "value=\"1 0.5 2\"/></emitter></shape>",
              segments, shape);
      expectPixels(scene, truth(segments, 1.0),
                   {{"radiance + 2 %", truth(segments, 1.02)},
                    {"a segment more", truth(segments + 1, 1.0)}});
    }
}

}  // namespace
}  // namespace restlab::gates
