#include "core/scene/mitsuba/bump.h"

#include <algorithm>
#include <cmath>

#include "core/image/color.h"
#include "core/scene/textures/image_formats.h"

namespace restlab::mitsuba {
namespace {

// Index of a texel beside the image's edge, as the sampler reads it.
uint32_t wrapped(int64_t i, uint32_t count, uint32_t mode) {
  const int64_t n = count;
  if (mode == rl::RL_WRAP_CLAMP) return uint32_t(std::clamp<int64_t>(i, 0, n - 1));
  const int64_t period = mode == rl::RL_WRAP_MIRROR ? 2 * n : n;
  const int64_t inside = ((i % period) + period) % period;
  return uint32_t(inside < n ? inside : period - 1 - inside);
}

}  // namespace

UvScale uvScaleOf(const MeshGeometry& mesh, const glm::dmat4& toWorld) {
  UvScale all;
  if (mesh.uvs[0].empty()) return all;
  glm::dvec2 sum(0.0);
  double areas = 0.0, sides = 0.0, least = 1e300, most = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto corner = [&](uint32_t i) {
      return glm::dvec3(toWorld * glm::dvec4(mesh.positions[i], 1.0));
    };
    const glm::dvec3 e1 = corner(t.y) - corner(t.x), e2 = corner(t.z) - corner(t.x);
    const glm::dvec2 d1(mesh.uvs[0][t.y] - mesh.uvs[0][t.x]),
        d2(mesh.uvs[0][t.z] - mesh.uvs[0][t.x]);
    const double uvArea = d1.x * d2.y - d1.y * d2.x;
    const glm::dvec3 normal = glm::cross(e1, e2);
    const double area = glm::length(normal);
    if (uvArea == 0.0 || !(area > 0.0)) continue;
    const glm::dvec3 alongU = (e1 * d2.y - e2 * d1.y) / uvArea,
                     alongV = (e2 * d1.x - e1 * d2.x) / uvArea;
    const glm::dvec2 size(glm::length(alongU), glm::length(alongV));
    sum += area * size;
    areas += area;
    sides += area * (uvArea > 0.0 ? 1.0 : -1.0);
    least = std::min(least, std::min(size.x, size.y));
    most = std::max(most, std::max(size.x, size.y));
  }
  if (!(areas > 0.0)) return all;
  all.metres = glm::max(sum / areas, glm::dvec2(1e-12));
  const bool isMirrored = glm::determinant(glm::dmat3(toWorld)) < 0.0;
  all.side = (sides < 0.0) != isMirrored ? -1.0 : 1.0;
  all.spread = most / std::max(least, 1e-12);
  return all;
}

TextureImage normalsOf(const TextureUse& use, const TextureImage& heights, double scale,
                       const UvScale& surface) {
  TextureImage normals{heights.name + " as normals", heights.width, heights.height, {}};
  normals.texels.reserve(heights.texels.size());
  const auto height = [&](int64_t x, int64_t y) {
    const uint32_t column = wrapped(x, heights.width, use.wrapU),
                   row = wrapped(y, heights.height, use.wrapV);
    const double red = double(heights.texels[size_t(row) * heights.width + column] & 255u) / 255.0;
    return scale * (use.srgb ? decodeSrgb(red) : red);
  };
  const glm::dvec2 half(0.5 * heights.width, 0.5 * heights.height);
  const auto byteOf = [](double c) { return uint32_t(std::lround(127.5 * (c + 1.0))); };
  for (int64_t y = 0; y < int64_t(heights.height); ++y) {
    for (int64_t x = 0; x < int64_t(heights.width); ++x) {
      // Slopes by the image's coordinates, then by the surface's.
      const double s = half.x * (height(x + 1, y) - height(x - 1, y)),
                   t = half.y * (height(x, y + 1) - height(x, y - 1));
      const double u = s * use.uvRow0.x + t * use.uvRow1.x, v = s * use.uvRow0.y + t * use.uvRow1.y;
      const glm::dvec3 n = glm::normalize(
          glm::dvec3(-u / surface.metres.x, -v / surface.metres.y * surface.side, 1.0));
      normals.texels.push_back(packRgba(byteOf(n.x), byteOf(n.y), byteOf(n.z), 255u));
    }
  }
  return normals;
}

}  // namespace restlab::mitsuba
