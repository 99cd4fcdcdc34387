#include "tests/report/colour_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/glm.hpp>

namespace restlab::report_test {
namespace {

glm::dvec3 linearColour(const std::string& hex) {
  glm::dvec3 colour;
  for (int c = 0; c < 3; ++c) {
    const double encoded =
        double(std::strtol(hex.substr(1 + 2 * size_t(c), 2).c_str(), nullptr, 16)) / 255.0;
    colour[c] = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  }
  return colour;
}

glm::dvec3 oklab(const glm::dvec3& linear) {
  const glm::dmat3 toCones = {{0.4122214708, 0.2119034982, 0.0883024619},
                              {0.5363325363, 0.6806995451, 0.2817188376},
                              {0.0514459929, 0.1073969566, 0.6299787005}};
  const glm::dmat3 toLab = {{0.2104542553, 1.9779984951, 0.0259040371},
                            {0.7936177850, -2.4285922050, 0.7827717662},
                            {-0.0040720468, 0.4505937099, -0.8086757660}};
  const glm::dvec3 cones = toCones * linear;
  return toLab * glm::dvec3(std::cbrt(cones.x), std::cbrt(cones.y), std::cbrt(cones.z));
}

// Rows of the published matrices, for linear colours.
const glm::dmat3 kWithoutACone[] = {{{0.152286, 1.052583, -0.204868},
                                     {0.114503, 0.786281, 0.099216},
                                     {-0.003882, -0.048116, 1.051998}},
                                    {{0.367322, 0.860646, -0.227968},
                                     {0.280085, 0.672501, 0.047413},
                                     {-0.011820, 0.042940, 0.968881}},
                                    {{1.255528, -0.076749, -0.178779},
                                     {-0.078411, 0.930809, 0.147602},
                                     {0.004733, 0.691367, 0.303900}}};

glm::dvec3 seen(const glm::dvec3& linear, const glm::dmat3& rows) {
  return glm::clamp(glm::transpose(rows) * linear, glm::dvec3(0.0), glm::dvec3(1.0));
}

}  // namespace

double colourDistance(const std::string& a, const std::string& b) {
  return glm::distance(oklab(linearColour(a)), oklab(linearColour(b)));
}

double leastColourDistance(const std::string& a, const std::string& b) {
  double least = colourDistance(a, b);
  for (const glm::dmat3& rows : kWithoutACone) {
    const glm::dvec3 seenA = seen(linearColour(a), rows), seenB = seen(linearColour(b), rows);
    least = std::min(least, glm::distance(oklab(seenA), oklab(seenB)));
  }
  return least;
}

}  // namespace restlab::report_test
