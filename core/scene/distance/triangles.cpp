#include "core/scene/distance/triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "core/base/error.h"

namespace restlab {

namespace {

struct PlaceHash {
  size_t operator()(const std::array<uint32_t, 3>& bits) const {
    uint64_t h = 0x9e3779b97f4a7c15u;
    for (const uint32_t word : bits) h = (h ^ word) * 0xff51afd7ed558ccdu, h ^= h >> 32u;
    return size_t(h);
  }
};

class Welder {
 public:
  explicit Welder(ClosedTriangles& all) : all_(all) {}

  void add(const MeshGeometry& mesh, const glm::dmat4& toWorld) {
    std::vector<uint32_t> corners;
    for (const glm::vec3& p : mesh.positions)
      corners.push_back(corner(glm::vec3(toWorld * glm::dvec4(p, 1.0))));
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::uvec3 welded(corners[t.x], corners[t.y], corners[t.z]);
      if (welded.x != welded.y && welded.y != welded.z && welded.z != welded.x)
        all_.triangles.push_back(welded);
    }
  }

 private:
  uint32_t corner(glm::vec3 p) {
    p = p + 0.0f;  // one zero of both
    if (!(std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < 1e15f))
      failInput("a vertex is further away than 1e15");
    const std::array<uint32_t, 3> bits{std::bit_cast<uint32_t>(p.x), std::bit_cast<uint32_t>(p.y),
                                       std::bit_cast<uint32_t>(p.z)};
    const auto [found, isNew] =
        known_.try_emplace(bits, static_cast<uint32_t>(all_.positions.size()));
    if (isNew) all_.positions.push_back(p);
    return found->second;
  }

  ClosedTriangles& all_;
  std::unordered_map<std::array<uint32_t, 3>, uint32_t, PlaceHash> known_;
};

void requireClosed(const ClosedTriangles& all) {
  // Triangles that run along an edge from the lower corner, less those that run back.
  std::unordered_map<uint64_t, int> balance;
  for (const glm::uvec3& t : all.triangles) {
    for (int c = 0; c < 3; ++c) {
      const uint32_t from = t[c], to = t[(c + 1) % 3];
      balance[uint64_t(std::min(from, to)) << 32u | std::max(from, to)] += from < to ? 1 : -1;
    }
  }
  size_t open = 0;
  uint64_t first = ~uint64_t{0};
  for (const auto& [edge, sum] : balance) {
    if (sum == 0) continue;
    ++open;
    first = std::min(first, edge);
  }
  if (open == 0) return;
  const glm::vec3 a = all.positions[first >> 32u], b = all.positions[first & 0xffffffffu];
  failInput(
      fmt::format("the surface is not closed: {} of its {} edges have a triangle on one side "
                  "alone, or two that "
                  "face different ways, as that from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}); a "
                  "closed surface "
                  "expected",
                  open, balance.size(), a.x, a.y, a.z, b.x, b.y, b.z));
}

}  // namespace

ClosedTriangles closedTriangles(const Scene& scene) {
  ClosedTriangles all;
  Welder welder(all);
  for (const MeshInstance& instance : scene.instances)
    welder.add(scene.geometries.at(instance.geometry), instance.objectToWorld);
  if (all.triangles.empty()) failInput("there is no triangle with an area");
  requireClosed(all);
  all.low = glm::dvec3(1e300);
  all.high = glm::dvec3(-1e300);
  for (const glm::uvec3& t : all.triangles) {
    for (int c = 0; c < 3; ++c) {
      all.low = glm::min(all.low, glm::dvec3(all.positions[t[c]]));
      all.high = glm::max(all.high, glm::dvec3(all.positions[t[c]]));
    }
  }
  return all;
}

}  // namespace restlab
