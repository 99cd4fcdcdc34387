// Views of lamps by Mitsuba's sensors: shares of pixels that a rectangle covers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/gates/known_pixels.h"

namespace restlab::gates {
namespace {

const glm::dvec3 kLampSeen(3.0, 2.0, 1.0), kSkySeen(0.25, 0.5, 0.75);
constexpr double kLeft = 5.5, kRight = 18.25, kTop = 3.5, kBottom = 12.75;  // pixels

// A lamp before a sky that covers the film between these edges.
PixelTruth framed(double left, double right, double top, double bottom) {
  return [=](uint32_t x, uint32_t y) {
    return glm::mix(kSkySeen, kLampSeen, overlap(x, left, right) * overlap(y, top, bottom));
  };
}

// The lamp at z = 3 that fills those edges of a film with that half width at a distance of 1. The
// camera stands in the origin and looks along +Z, so the image's right is at -X.
std::string lampBehindEdges(double halfWidth, const KnownScene& scene) {
  const double perPixel = 3.0 * 2.0 * halfWidth / scene.width;
  const auto across = [&](double x) { return -(x - 0.5 * scene.width) * perPixel; };
  const auto above = [&](double y) { return -(y - 0.5 * scene.height) * perPixel; };
  return fmt::format(
      "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"{}\" y=\"{}\"/>"
      "<rotate y=\"1\" angle=\"180\"/><translate x=\"{}\" y=\"{}\" z=\"3\"/></transform>"
      "<emitter type=\"area\"><rgb name=\"radiance\" value=\"3 2 1\"/></emitter></shape>"
      "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.25 0.5 0.75\"/></emitter>",
      0.5 * (across(kLeft) - across(kRight)), 0.5 * (above(kTop) - above(kBottom)),
      0.5 * (across(kLeft) + across(kRight)), 0.5 * (above(kTop) + above(kBottom)));
}

// The film's sides over those that a field of view 2 % wider would show.
PixelTruth wider(const KnownScene& scene, double degrees) {
  const double k = std::tan(degrees * std::numbers::pi / 360.0) /
                   std::tan(1.02 * degrees * std::numbers::pi / 360.0);
  const double w = 0.5 * scene.width, h = 0.5 * scene.height;
  return framed(w + k * (kLeft - w), w + k * (kRight - w), h + k * (kTop - h),
                h + k * (kBottom - h));
}

PixelTruth mirrored(const KnownScene& scene) {
  return framed(scene.width - kRight, scene.width - kLeft, kTop, kBottom);
}

void expectFieldOfView(const std::string& axis, uint32_t width, uint32_t height,
                       const std::string& fov, double degrees, double halfOf) {
  KnownScene scene{
      .name = "fov_axis " + axis, .xml = {}, .width = width, .height = height, .bounces = 0};
  // halfOf: half the side that spans the angle, over half the width.
  const double halfWidth = std::tan(degrees * std::numbers::pi / 360.0) / halfOf;
  scene.xml = fmt::format(
                  "<sensor type=\"perspective\">{}<film type=\"hdrfilm\"><integer name=\"width\" "
                  "value=\"{}\"/><integer name=\"height\" value=\"{}\"/></film></sensor>",
                  fov, width, height) +
              lampBehindEdges(halfWidth, scene);
  expectPixels(scene, framed(kLeft, kRight, kTop, kBottom),
               {{"fov + 2 %", wider(scene, degrees)}, {"mirrored", mirrored(scene)}});
}

std::string angle(const std::string& axis) {
  return "<float name=\"fov\" value=\"50\"/><string name=\"fov_axis\" value=\"" + axis + "\"/>";
}

TEST(MitsubaTruths, FieldsOfView) {
  const double diagonal = std::hypot(24.0, 16.0) / 24.0, high = 16.0 / 24.0;
  expectFieldOfView("x", 24, 16, angle("x"), 50.0, 1.0);
  expectFieldOfView("y", 24, 16, angle("y"), 50.0, high);
  expectFieldOfView("diagonal", 24, 16, angle("diagonal"), 50.0, diagonal);
  expectFieldOfView("smaller", 24, 16, angle("smaller"), 50.0, high);
  expectFieldOfView("larger", 24, 16, angle("larger"), 50.0, 1.0);
  expectFieldOfView("smaller of an upright film", 22, 28, angle("smaller"), 50.0, 1.0);
  expectFieldOfView("larger of an upright film", 22, 28, angle("larger"), 50.0, 28.0 / 22.0);
  // A lens of 40 mm before a film of 36 x 24 mm.
  expectFieldOfView("of a lens", 24, 16, "<string name=\"focal_length\" value=\"40mm\"/>",
                    2.0 * std::atan(0.5 * std::hypot(36.0, 24.0) / 40.0) * 180.0 / std::numbers::pi,
                    diagonal);
}

// A window of 16 x 12 pixels at (4, 2) of the film, whose middle is moved by 3 pixels and -1.
TEST(MitsubaTruths, WindowsOfTheFilm) {
  const KnownScene film{.name = {}, .xml = {}};
  const double halfWidth = std::tan(25.0 * std::numbers::pi / 180.0);
  const KnownScene scene{
      .name = "crop and principal point",
      .xml =
          "<sensor type=\"perspective\"><float name=\"fov\" value=\"50\"/>"
          "<float name=\"principal_point_offset_x\" value=\"0.125\"/>"
          "<float name=\"principal_point_offset_y\" value=\"-0.0625\"/>"
          "<film type=\"hdrfilm\"><integer name=\"width\" value=\"24\"/><integer "
          "name=\"height\" value=\"16\"/><integer name=\"crop_offset_x\" value=\"4\"/>"
          "<integer name=\"crop_offset_y\" value=\"2\"/><integer name=\"crop_width\" "
          "value=\"16\"/><integer name=\"crop_height\" value=\"12\"/></film></sensor>" +
          lampBehindEdges(halfWidth, film),
      .width = 16,
      .height = 12,
      .bounces = 0};
  const auto truth = [](double x, double y) {
    return framed(kLeft - x, kRight - x, kTop - y, kBottom - y);
  };
  expectPixels(scene, truth(7.0, 1.0),
               {{"middle not moved", truth(4.0, 2.0)},
                {"moved the other way", truth(1.0, 3.0)},
                {"an eighth of a pixel", truth(7.125, 1.0)}});
}

// Steps of a transform apply one after the other: one lamp is turned and then moved to x = 1.25,
// the other moved to x = 1.25 and then turned about the origin, to y = 1.25.
TEST(MitsubaTruths, OrderOfTransformsAndParallelRays) {
  KnownScene scene{
      .name = "order of transforms", .xml = {}, .width = 24, .height = 22, .bounces = 0};
  const auto lamp = [](const char* first, const char* second, const char* radiance) {
    return fmt::format(
        "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"0.25\" y=\"0.5\"/>{}{}"
        "</transform><emitter type=\"area\"><rgb name=\"radiance\" value=\"{}\"/></emitter>"
        "</shape>",
        first, second, radiance);
  };
  const char *turn = "<rotate z=\"1\" angle=\"90\"/>", *move = "<translate x=\"1.25\"/>";
  // Rays along -Z over 6 x 5.5 metres: 2.75 = 4.125 / (24 / 16). Its pixels are not square, and the
  // image has 22 rows that are.
  scene.xml =
      "<sensor type=\"orthographic\"><transform name=\"to_world\"><scale x=\"3\" y=\"4.125\"/>"
      "<lookat origin=\"0, 0, 5\" target=\"0, 0, 0\" up=\"0, 1, 0\"/></transform>"
      "<film type=\"hdrfilm\"><integer name=\"width\" value=\"24\"/><integer name=\"height\" "
      "value=\"16\"/></film></sensor><emitter type=\"constant\"><rgb name=\"radiance\" "
      "value=\"0.25 0.5 0.75\"/></emitter>" +
      lamp(turn, move, "3 0 0") + lamp(move, turn, "0 3 0");
  const auto truth = [](double toTheRight, double sizeX, double sizeY) {
    return [=](uint32_t x, uint32_t y) {
      // The share of the pixel that a rectangle of 2 sizeX by 2 sizeY around (cx, cy) covers.
      const auto share = [&](double cx, double cy) {
        const double px = 24.0 / 6.0, py = 22.0 / 5.5;
        return overlap(x, 12.0 + px * (cx - sizeX), 12.0 + px * (cx + sizeX)) *
               overlap(y, 11.0 - py * (cy + sizeY), 11.0 - py * (cy - sizeY));
      };
      const double a = share(toTheRight, 0.0), b = share(0.0, 1.25);
      return (1.0 - a - b) * kSkySeen + glm::dvec3(3.0 * a, 3.0 * b, 0.0);
    };
  };
  expectPixels(scene, truth(1.25, 0.5, 0.25),
               {{"mirrored", truth(-1.25, 0.5, 0.25)}, {"not turned", truth(1.25, 0.25, 0.5)}});
}

}  // namespace
}  // namespace restlab::gates
