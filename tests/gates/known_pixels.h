// Mitsuba scenes whose pixels are known from formulas, rendered by `path` and judged pixel by
// pixel.
//
// Independent runs give every pixel and channel a mean and a standard error; the t-tests of all
// pixels and of the whole image are one family by Holm's correction. A rejection counts if a fresh
// batch of seeds rejects the same on the same side.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace restlab::gates {

// Radiance of a pixel; row 0 on top. Not a number: the pixel is not judged.
using PixelTruth = std::function<glm::dvec3(uint32_t x, uint32_t y)>;

struct WrongTruth {
  std::string name;  // for messages
  PixelTruth pixel;
};

struct KnownScene {
  std::string name;  // for messages
  std::string xml;   // what <scene> holds
  uint32_t width = 24, height = 16;
  uint32_t bounces = 1;  // scattering events; those of an <integrator> win
  size_t runs = 64;
  uint32_t frames = 8;  // of a run
  // Relative error of pixels without noise: sums and positions of floats.
  double rounding = 2e-6;
  std::vector<std::pair<std::string, std::string>> files = {};  // name and bytes, beside it
};

// Expects that the truth is not rejected, and that every wrong one is. Prints a line.
void expectPixels(const KnownScene& scene, const PixelTruth& truth,
                  const std::vector<WrongTruth>& wrong);

// A camera of Mitsuba by its manual: +Z ahead, +X to the left of the image.
struct TheirCamera {
  glm::dvec3 origin{0.0}, ahead{0.0, 0.0, 1.0}, left{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0};
  double halfWidth = 1.0;              // of the film at a distance of 1
  double width = 24.0, height = 16.0;  // pixels

  // Direction through a point of the film in pixels, not normalised.
  glm::dvec3 through(double x, double y) const;
};
// `fov`: degrees along x.
TheirCamera lookingAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up,
                      double fov, const KnownScene& scene);

// Its <sensor>, with a film of the scene's size.
std::string sensorXml(const std::string& origin, const std::string& target, const std::string& up,
                      double fov, const KnownScene& scene);

// The mean of a smooth function of the ray over a pixel: 4 x 4 points of Gauss and Legendre.
PixelTruth meanOver(const TheirCamera& camera,
                    std::function<glm::dvec3(const glm::dvec3& origin, const glm::dvec3& dir)> of);

// Share of the interval from i to i + 1 that lies between two numbers.
double overlap(uint32_t i, double low, double high);

// Where a ray meets the plane y = 0.
glm::dvec3 floorOf(const glm::dvec3& origin, const glm::dvec3& dir);

}  // namespace restlab::gates
