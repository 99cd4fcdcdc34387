#include "core/image/io/chromaticities.h"

#include <fmt/format.h>

#include <cmath>

namespace restlab {

namespace {

glm::dvec3 withZ(const glm::dvec2& xy) { return {xy.x, xy.y, 1.0 - xy.x - xy.y}; }

glm::dmat3 primariesOf(const Chromaticities& c) {
  return {withZ(c.red), withZ(c.green), withZ(c.blue)};
}

// Returns how much of each primary the white of luminance 1 contains.
glm::dvec3 sharesOf(const Chromaticities& c) {
  return glm::inverse(primariesOf(c)) * (withZ(c.white) / c.white.y);
}

glm::dmat3 toXyz(const Chromaticities& c) {
  const glm::dmat3 primaries = primariesOf(c);
  const glm::dvec3 shares = sharesOf(c);
  return {primaries[0] * shares.x, primaries[1] * shares.y, primaries[2] * shares.z};
}

}  // namespace

bool isRec709(const Chromaticities& c) {
  const auto near = [](const glm::dvec2& a, const glm::dvec2& b) {
    return std::abs(a.x - b.x) < 1e-4 && std::abs(a.y - b.y) < 1e-4;
  };
  return near(c.red, kRec709.red) && near(c.green, kRec709.green) && near(c.blue, kRec709.blue) &&
         near(c.white, kRec709.white);
}

std::string textOf(const Chromaticities& c) {
  const auto point = [](const char* name, const glm::dvec2& xy) {
    return fmt::format("{} ({:.5g}, {:.5g})", name, xy.x, xy.y);
  };
  return fmt::format("{}, {}, {}, {}", point("red", c.red), point("green", c.green),
                     point("blue", c.blue), point("white", c.white));
}

std::string whyNoColours(const Chromaticities& c) {
  for (const glm::dvec2& xy : {c.red, c.green, c.blue, c.white}) {
    // Colours of all lights lie within 0 to 1, primaries of some working spaces a little outside.
    if (!(std::abs(xy.x) <= 10.0 && std::abs(xy.y) <= 10.0)) return "numbers of -10 to 10 expected";
  }
  if (std::abs(c.white.y) < 1e-6) return "a white with light, whose y is not 0, expected";
  if (std::abs(glm::determinant(primariesOf(c))) < 1e-6)
    return "three primaries that do not lie on a line expected";
  const glm::dvec3 shares = sharesOf(c);
  if (!(std::abs(shares.x) > 1e-6 && std::abs(shares.y) > 1e-6 && std::abs(shares.z) > 1e-6))
    return "a white that has some of each primary expected";
  return "";
}

glm::dmat3 toRec709(const Chromaticities& colours) {
  return glm::inverse(toXyz(kRec709)) * toXyz(colours);
}

void convert(const glm::dmat3& matrix, std::vector<glm::vec3>& pixels) {
  for (glm::vec3& pixel : pixels) pixel = glm::vec3(matrix * glm::dvec3(pixel));
}

}  // namespace restlab
