#include "core/scene/curves/stand_in.h"

#include <cmath>
#include <numbers>

#include "core/scene/curves/curve_words.h"

namespace restlab {

namespace {

class Tubes {
 public:
  Tubes(uint32_t sides, bool hasNormals) : sides_(sides), hasNormals_(hasNormals) {}

  // The side of a piece, and the ends of its strand.
  void add(const StrandPiece& piece) {
    const glm::dvec3 start(piece.start), end(piece.end), way = end - start;
    const double length = glm::length(way);
    const bool isSphere = !(length > 0.0);
    axis_ = isSphere ? glm::dvec3(0.0, 0.0, 1.0) : way / length;
    x_ = glm::dvec3(piece.across);
    y_ = glm::cross(axis_, x_);
    const double rim = isSphere ? 0.0 : std::asin(double(piece.start.w - piece.end.w) / length);
    const double quarter = 0.5 * std::numbers::pi;
    uint32_t rings = 0;
    const auto ring = [&](const glm::dvec3& centre, double radius, double angle, double v) {
      addRing(centre, radius, angle, v);
      if (rings++ > 0) addBand();
    };
    if (isSphere || piece.v.x == 0.0f) {
      for (int i = 0; i < kDome; ++i)
        ring(start, double(piece.start.w), glm::mix(-quarter, rim, i / double(kDome)),
             double(piece.v.x));
    }
    ring(start, double(piece.start.w), rim, double(piece.v.x));
    if (!isSphere) ring(end, double(piece.end.w), rim, double(piece.v.y));
    if (isSphere || piece.v.y == 1.0f) {
      for (int i = 1; i <= kDome; ++i)
        ring(end, double(piece.end.w), glm::mix(rim, quarter, i / double(kDome)),
             double(piece.v.y));
    }
  }

  MeshGeometry take() { return std::move(mesh_); }

 private:
  static constexpr int kDome = 3;  // rings of an end, with its pole

  // Points whose normals are that angle above the plane across the axis.
  void addRing(const glm::dvec3& centre, double radius, double angle, double v) {
    for (uint32_t i = 0; i <= sides_; ++i) {
      const double u = double(i) / sides_,
                   phi = 2.0 * std::numbers::pi * double(i % sides_) / sides_;
      const glm::dvec3 n =
          axis_ * std::sin(angle) + (x_ * std::cos(phi) + y_ * std::sin(phi)) * std::cos(angle);
      mesh_.positions.push_back(glm::vec3(centre + n * radius));
      if (!hasNormals_) continue;
      mesh_.normals.push_back(glm::vec3(n));
      mesh_.uvs[0].push_back(glm::vec2(u, v));
    }
  }

  // Joins the last two rings.
  void addBand() {
    const uint32_t width = sides_ + 1, high = uint32_t(mesh_.positions.size()) - width;
    for (uint32_t i = 0; i < sides_; ++i) {
      const uint32_t a = high - width + i, b = high + i;
      addTriangle(a, a + 1, b + 1);
      addTriangle(a, b + 1, b);
    }
  }

  // A pole is many vertices in one place.
  void addTriangle(uint32_t a, uint32_t b, uint32_t c) {
    const glm::dvec3 p(mesh_.positions[a]), q(mesh_.positions[b]), r(mesh_.positions[c]);
    const glm::dvec3 n = glm::cross(q - p, r - p);
    const double widest = glm::dot(q - p, q - p) + glm::dot(r - p, r - p);
    if (glm::length(n) > 1e-9 * widest) mesh_.triangles.emplace_back(a, b, c);
  }

  uint32_t sides_;
  bool hasNormals_;
  glm::dvec3 axis_{}, x_{}, y_{};
  MeshGeometry mesh_;
};

}  // namespace

MeshGeometry tubesOf(const std::vector<uint32_t>& words, bool isFine) {
  const size_t pieces = curvePieces(words);
  const uint32_t sides = pieces <= 2'000 ? 12 : pieces <= 50'000 ? 6 : 3;
  Tubes tubes(isFine ? 2 * sides : sides, isFine);
  for (size_t i = 0; i < pieces; ++i) tubes.add(curvePiece(words, i));
  return tubes.take();
}

}  // namespace restlab
