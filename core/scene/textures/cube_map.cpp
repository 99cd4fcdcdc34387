#include "core/scene/textures/cube_map.h"

#include <ImfEnvmap.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace restlab {

namespace {

class Cube {
 public:
  explicit Cube(const Image& image)
      : image_(image), window_({0, 0}, {int(image.width) - 1, int(image.height) - 1}) {}

  // Interpolates between the pixels of one face; the outer pixels lie on the face's edges.
  glm::dvec3 value(const Imath::V3f& direction) const {
    Imf::CubeMapFace face = Imf::CUBEFACE_POS_X;
    Imath::V2f at;
    Imf::CubeMap::faceAndPixelPosition(direction, window_, face, at);
    const int last = int(image_.width) - 1;
    const int x = std::clamp(int(std::floor(at.x)), 0, std::max(last - 1, 0));
    const int y = std::clamp(int(std::floor(at.y)), 0, std::max(last - 1, 0));
    const double u = std::clamp(double(at.x) - x, 0.0, 1.0);
    const double v = std::clamp(double(at.y) - y, 0.0, 1.0);
    const int x1 = std::min(x + 1, last), y1 = std::min(y + 1, last);
    return (1.0 - v) * ((1.0 - u) * pixel(face, x, y) + u * pixel(face, x1, y)) +
           v * ((1.0 - u) * pixel(face, x, y1) + u * pixel(face, x1, y1));
  }

 private:
  glm::dvec3 pixel(Imf::CubeMapFace face, int x, int y) const {
    const Imath::V2f at =
        Imf::CubeMap::pixelPosition(face, window_, Imath::V2f(float(x), float(y)));
    return glm::dvec3(image_.at(uint32_t(std::lround(at.x)), uint32_t(std::lround(at.y))));
  }

  const Image& image_;
  Imath::Box2i window_;
};

// Direction at a point of the map; u, v from 0 to 1 from its left and upper edge.
Imath::V3f directionAt(double u, double v) {
  const double longitude = -2.0 * std::numbers::pi * (u - 0.5);
  const double latitude = -std::numbers::pi * (v - 0.5);
  return Imath::V3f(float(std::sin(longitude) * std::cos(latitude)), float(std::sin(latitude)),
                    float(std::cos(longitude) * std::cos(latitude)));
}

}  // namespace

Image latLongOfCube(const Image& cube) {
  const Cube faces(cube);
  Image map(4 * cube.width, 2 * cube.width);
  tbb::parallel_for(0u, map.height, [&](uint32_t y) {
    for (uint32_t x = 0; x < map.width; ++x) {
      glm::dvec3 sum(0.0);
      for (const double dy : {0.25, 0.75}) {
        for (const double dx : {0.25, 0.75})
          sum += faces.value(directionAt((x + dx) / map.width, (y + dy) / map.height));
      }
      map.at(x, y) = glm::vec3(sum / 4.0);
    }
  });
  return map;
}

}  // namespace restlab
