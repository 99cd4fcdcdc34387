#include "core/scene/compiled/split_triangles.h"

#include <algorithm>
#include <cmath>

#include "core/scene/camera_path/sight.h"

namespace restlab {

namespace {

// Fraction of the coordinates below which an edge gains nothing by a split.
constexpr double kShortest = 0.125;

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

template <class T>
void addMiddle(std::vector<T>& values, uint32_t a, uint32_t b) {
  if (!values.empty()) values.push_back(0.5f * (values[a] + values[b]));
}

class Splitter {
 public:
  Splitter(const MeshGeometry& mesh, const SceneOrigin& origin, std::vector<glm::dvec3> positionsW)
      : origin_(origin), split_{mesh, std::move(positionsW)} {}

  bool isHuge(const glm::uvec3& triangle) const {
    const glm::dvec3 a = at(triangle.x), b = at(triangle.y), c = at(triangle.z);
    const glm::dvec3 from = origin_.originW;
    const double coordinate = std::max({largest(a - from), largest(b - from), largest(c - from)});
    if (!(coordinate > kHarmlessReach * origin_.viewSize)) return false;
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    if (longest < kShortest * coordinate) return false;
    const double distance = std::min(distanceToTriangle(origin_.eyeW, a, b, c),
                                     distanceToTriangle(origin_.focusW, a, b, c));
    return coordinate > kHarmlessReach * std::max(origin_.viewSize, distance);
  }

  SplitMesh run() {
    std::vector<glm::uvec3> waiting(std::move(split_.mesh.triangles));
    std::vector<glm::uvec3> done;
    std::reverse(waiting.begin(), waiting.end());
    while (!waiting.empty()) {
      const glm::uvec3 t = waiting.back();
      waiting.pop_back();
      if (!isHuge(t)) {
        done.push_back(t);
        continue;
      }
      // Split the longest edge: pieces stay round.
      const double xy = glm::length(at(t.y) - at(t.x)), yz = glm::length(at(t.z) - at(t.y)),
                   zx = glm::length(at(t.x) - at(t.z));
      const glm::uvec3 turned = xy >= yz && xy >= zx ? t
                                : yz >= zx           ? glm::uvec3(t.y, t.z, t.x)
                                                     : glm::uvec3(t.z, t.x, t.y);
      const uint32_t middle = middleOf(turned.x, turned.y);
      waiting.emplace_back(middle, turned.y, turned.z);
      waiting.emplace_back(turned.x, middle, turned.z);
    }
    split_.mesh.triangles = std::move(done);
    return std::move(split_);
  }

 private:
  const glm::dvec3& at(uint32_t vertex) const { return split_.positionsW[vertex]; }

  uint32_t middleOf(uint32_t a, uint32_t b) {
    MeshGeometry& mesh = split_.mesh;
    const auto index = static_cast<uint32_t>(split_.positionsW.size());
    split_.positionsW.push_back(0.5 * (at(a) + at(b)));
    addMiddle(mesh.positions, a, b);
    addMiddle(mesh.normals, a, b);
    addMiddle(mesh.tangents, a, b);
    addMiddle(mesh.colors, a, b);
    for (auto& uvs : mesh.uvs) addMiddle(uvs, a, b);
    return index;
  }

  const SceneOrigin& origin_;
  SplitMesh split_;
};

}  // namespace

std::optional<SplitMesh> splitHugeTriangles(const MeshGeometry& mesh, const glm::dmat4& toWorld,
                                            const SceneOrigin& origin) {
  if (!(origin.viewSize > 0.0)) return std::nullopt;
  std::vector<glm::dvec3> positionsW;
  positionsW.reserve(mesh.positions.size());
  double most = 0.0;
  for (const glm::vec3& p : mesh.positions) {
    positionsW.emplace_back(toWorld * glm::dvec4(p, 1.0));
    most = std::max(most, largest(positionsW.back() - origin.originW));
  }
  if (!(most > kHarmlessReach * origin.viewSize)) return std::nullopt;
  MeshGeometry bare;  // attributes are copied only if a triangle is split
  const Splitter looker(bare, origin, positionsW);
  const bool isSplit = std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                                   [&](const glm::uvec3& t) { return looker.isHuge(t); });
  if (!isSplit) return std::nullopt;
  return Splitter(mesh, origin, std::move(positionsW)).run();
}

}  // namespace restlab
