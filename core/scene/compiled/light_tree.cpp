#include "core/scene/compiled/light_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/scene/compiled/alias_table.h"

namespace restlab {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr size_t kBins = 12;
// Lamps that the heuristic looks at, of a larger set.
constexpr uint32_t kLooksAt = 512;

// Directions within an angle of an axis: normals of emitters, and how far from a normal they emit.
struct Cone {
  glm::dvec3 axis{0.0, 0.0, 1.0};
  double spread = -1.0;  // radians from the axis to the farthest normal; negative: empty
  double beyond = 0.0;   // radians from a normal to the farthest direction of emission
};

// The smallest cone around two, or all directions.
Cone joined(const Cone& a, const Cone& b) {
  if (a.spread < 0.0) return b;
  if (b.spread < 0.0) return a;
  if (a.spread >= kPi) return {a.axis, a.spread, std::max(a.beyond, b.beyond)};
  if (b.spread >= kPi) return {b.axis, b.spread, std::max(a.beyond, b.beyond)};
  const Cone& wide = a.spread >= b.spread ? a : b;
  const Cone& other = a.spread >= b.spread ? b : a;
  Cone cone = wide;
  cone.beyond = std::max(a.beyond, b.beyond);
  const double between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0, 1.0));
  if (std::min(between + other.spread, kPi) <= wide.spread) return cone;
  cone.spread = 0.5 * (wide.spread + between + other.spread);
  const glm::dvec3 across = glm::cross(wide.axis, other.axis);
  if (cone.spread >= kPi || glm::length(across) < 1e-6) {
    // One axis but for rounding, or opposite ones: there is no direction to turn to.
    const bool isOne = glm::dot(wide.axis, other.axis) > 0.0;
    cone.spread = isOne ? std::min(std::max(wide.spread, between + other.spread), kPi) : kPi;
    return cone;
  }
  // Turn the wider cone's axis towards the other one's.
  const double turn = cone.spread - wide.spread;
  const glm::dvec3 side = glm::normalize(glm::cross(glm::normalize(across), wide.axis));
  cone.axis = glm::normalize(std::cos(turn) * wide.axis + std::sin(turn) * side);
  return cone;
}

struct Bounds {
  glm::dvec3 low{1e300}, high{-1e300};
  double power = 0.0;
  Cone cone;

  glm::dvec3 center() const { return 0.5 * (low + high); }
};

Bounds joined(const Bounds& a, const Bounds& b) {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high), a.power + b.power,
          joined(a.cone, b.cone)};
}

// Half the surface of a box that is larger by `pad`: lamps on one line or in one place have a cost.
double areaOf(const Bounds& b, double pad) {
  const glm::dvec3 d = glm::max(b.high - b.low, glm::dvec3(0.0)) + pad;
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

// Solid angle in which a cone emits, weighed by the cosine beyond its normals (equation 1).
double measureOf(const Cone& cone) {
  const double o = std::max(cone.spread, 0.0), w = std::min(o + cone.beyond, kPi);
  return 2.0 * kPi * (1.0 - std::cos(o)) +
         0.5 * kPi *
             (2.0 * w * std::sin(o) - std::cos(o - 2.0 * w) - 2.0 * o * std::sin(o) + std::cos(o));
}

Bounds boundsOf(const rl::Light& light) {
  Bounds b;
  const glm::dvec3 p(light.p0);
  b.low = b.high = p;
  b.power = double(light.pmf);
  if (light.kind == rl::RL_LIGHT_AREA) {
    const glm::dvec3 e1(light.e1), e2(light.e2);
    if ((light.flags & rl::RL_LIGHT_SHAPE) != 0) {
      b.low = p - e1;
      b.high = p + e1;
      const bool isFlat = light.e2 != glm::vec3(0.0f);
      const bool isOneSided = (light.flags & rl::RL_MATERIAL_DOUBLE_SIDED) == 0;
      if (isFlat) b.cone.axis = glm::dvec3(light.e2);
      b.cone.spread = isFlat && isOneSided ? 0.0 : kPi;
      b.cone.beyond = 0.5 * kPi;
      return b;
    }
    for (const glm::dvec3& corner : {p + e1, p + e2}) {
      b.low = glm::min(b.low, corner);
      b.high = glm::max(b.high, corner);
    }
    const bool isTwoSided = (light.flags & rl::RL_MATERIAL_DOUBLE_SIDED) != 0;
    const bool isFlipped = (light.flags & rl::RL_LIGHT_FLIPPED) != 0;
    b.cone.axis = glm::normalize(glm::cross(e1, e2)) * (isFlipped ? -1.0 : 1.0);
    b.cone.spread = isTwoSided ? kPi : 0.0;
    b.cone.beyond = 0.5 * kPi;
  } else if (light.kind == rl::RL_LIGHT_SPOT) {
    b.cone.axis = glm::normalize(glm::dvec3(light.e1));
    b.cone.spread = 0.0;
    // Light::e2 has the scale and the offset of the falloff, which is 0 at the outer cosine.
    const double scale = double(light.e2.x), offset = double(light.e2.y);
    b.cone.beyond = scale > 0.0 ? std::acos(std::clamp(-offset / scale, -1.0, 1.0)) : kPi;
  } else {
    b.cone.spread = kPi;
    b.cone.beyond = 0.5 * kPi;
  }
  return b;
}

// Cosine as 16 bits, rounded to a wider angle: a cone never loses a direction.
uint32_t packedCosine(double angle) {
  const double cosine = std::cos(std::min(std::max(angle, 0.0), kPi));
  return uint32_t(std::clamp(std::floor((cosine + 1.0) * 32767.0) - 1.0, 0.0, 65534.0));
}

// Rounds a bound outwards.
float below(double v) {
  return std::nextafter(static_cast<float>(v), -std::numeric_limits<float>::infinity());
}
float above(double v) {
  return std::nextafter(static_cast<float>(v), std::numeric_limits<float>::infinity());
}

struct Range {
  uint32_t first, end;
  uint32_t count() const { return end - first; }
};

class Builder {
 public:
  Builder(const std::vector<rl::Light>& lights, size_t clusters) : lights_(lights) {
    for (uint32_t i = 0; i < lights.size(); ++i) {
      const uint32_t kind = lights[i].kind;
      const bool isLamp =
          kind == rl::RL_LIGHT_AREA || kind == rl::RL_LIGHT_POINT || kind == rl::RL_LIGHT_SPOT;
      if (!isLamp || !(lights[i].pmf > 0.0f)) continue;
      order_.push_back(i);
      bounds_.push_back(boundsOf(lights[i]));
    }
    if (order_.empty()) return;
    trails_.resize(2 * lights.size());
    places_.resize(order_.size());
    std::iota(places_.begin(), places_.end(), 0u);
    mostOfCluster_ = static_cast<uint32_t>(std::max(order_.size() / clusters, size_t{1}));
    writeNode({0, uint32_t(places_.size())}, 0, 0);
    writeClusters();
  }

  LightTree take() { return {std::move(nodes_), std::move(trails_)}; }

 private:
  // Appends the node of lamps that `depth` nodes lead to, and all below it. Returns its bounds.
  Bounds writeNode(const Range& lamps, uint32_t depth, uint32_t trail) {
    const auto number = static_cast<uint32_t>(nodes_.size() / rl::RL_LIGHT_NODE_UVEC4S);
    nodes_.resize(nodes_.size() + rl::RL_LIGHT_NODE_UVEC4S, glm::uvec4(0));
    std::vector<Range> parts;
    for (const Range& half : halvesOf(lamps, 2 * depth)) {
      for (const Range& quarter : halvesOf(half, 2 * depth + 1)) parts.push_back(quarter);
    }
    Bounds all;
    for (uint32_t part = 0; part < parts.size(); ++part) {
      const uint32_t below = trail | (part << (2 * depth));
      uint32_t link = 0;
      Bounds bounds;
      if (parts[part].count() <= mostOfCluster_) {
        link = linkOfLamps(number, part, parts[part], below);
        for (uint32_t i = parts[part].first; i < parts[part].end; ++i)
          bounds = joined(bounds, bounds_[places_[i]]);
      } else {
        link = static_cast<uint32_t>(nodes_.size() / rl::RL_LIGHT_NODE_UVEC4S);
        bounds = writeNode(parts[part], depth + 1, below);
      }
      writePart(number, part, bounds, link);
      all = joined(all, bounds);
    }
    return all;
  }

  // One range where the lamps are one cluster.
  std::vector<Range> halvesOf(const Range& lamps, uint32_t turns) {
    if (lamps.count() <= mostOfCluster_) return {lamps};
    const uint32_t middle = split(lamps.first, lamps.end, turns);
    return {{lamps.first, middle}, {middle, lamps.end}};
  }

  // The lamp, or the cluster of several, whose place is not known before all nodes are written.
  uint32_t linkOfLamps(uint32_t node, uint32_t part, const Range& lamps, uint32_t trail) {
    for (uint32_t i = lamps.first; i < lamps.end; ++i) {
      const uint32_t light = order_[places_[i]];
      trails_[2 * size_t(light)] = trail;
      trails_[2 * size_t(light) + 1] = std::bit_cast<uint32_t>(1.0f);
    }
    if (lamps.count() == 1) return rl::RL_LIGHT_NODE_LEAF | order_[places_[lamps.first]];
    clusters_.push_back({node, part, lamps});
    return rl::RL_LIGHT_NODE_CLUSTER;
  }

  void writeClusters() {
    for (const Cluster& cluster : clusters_) {
      const auto where = static_cast<uint32_t>(nodes_.size());
      const size_t links = size_t(cluster.node) * rl::RL_LIGHT_NODE_UVEC4S + 11;
      nodes_[links][int(cluster.part)] = rl::RL_LIGHT_NODE_CLUSTER | where;
      const Range& lamps = cluster.lamps;
      std::vector<double> powers;
      const auto lightAt = [&](uint32_t i) { return order_[places_[lamps.first + i]]; };
      for (uint32_t i = 0; i < lamps.count(); ++i)
        powers.push_back(double(lights_[lightAt(i)].pmf));
      const std::vector<rl::AliasEntry> alias = buildAliasTable(powers, powers.size());
      nodes_.emplace_back(lamps.count(), 0u, 0u, 0u);
      for (uint32_t i = 0; i < lamps.count(); ++i) {
        nodes_.emplace_back(alias[i].keep, lightAt(i), lightAt(alias[i].other), 0u);
        trails_[2 * size_t(lightAt(i)) + 1] = std::bit_cast<uint32_t>(alias[i].pmf);
      }
    }
  }

  void writePart(uint32_t node, uint32_t part, const Bounds& b, uint32_t link) {
    const auto bits = [](float v) { return std::bit_cast<uint32_t>(v); };
    const std::array<uint32_t, rl::RL_LIGHT_NODE_UVEC4S> words = {
        bits(below(b.low.x)),
        bits(below(b.low.y)),
        bits(below(b.low.z)),
        bits(above(b.high.x)),
        bits(above(b.high.y)),
        bits(above(b.high.z)),
        bits(static_cast<float>(b.power)),
        bits(static_cast<float>(b.cone.axis.x)),
        bits(static_cast<float>(b.cone.axis.y)),
        bits(static_cast<float>(b.cone.axis.z)),
        packedCosine(b.cone.spread) | (packedCosine(b.cone.beyond) << 16),
        link};
    for (size_t i = 0; i < words.size(); ++i)
      nodes_[size_t(node) * rl::RL_LIGHT_NODE_UVEC4S + i][int(part)] = words[i];
  }

  // Parts lamps where the surface area orientation heuristic is least (equations 2 and 3); in
  // halves where they lie in one place, or where unequal parts would lead too deep. Returns the
  // first of the second part.
  uint32_t split(uint32_t first, uint32_t end, uint32_t turns) {
    const uint32_t half = first + (end - first) / 2;
    const uint32_t levels = uint32_t(std::bit_width(end - first - 1u));
    const uint32_t step = std::max((end - first) / kLooksAt, 1u);
    glm::dvec3 low(1e300), high(-1e300);
    for (uint32_t i = first; i < end; i += step) {
      low = glm::min(low, bounds_[places_[i]].center());
      high = glm::max(high, bounds_[places_[i]].center());
    }
    const glm::dvec3 size = high - low;
    const double longest = std::max({size.x, size.y, size.z});
    double best = 1e300, place = 0.0;
    int axis = -1;
    const bool isFree = turns + levels + 1 < 2 * rl::RL_LIGHT_TREE_DEPTH;
    for (int a = 0; isFree && a < 3; ++a) {
      if (!(size[a] > 0.0)) continue;
      const double cost = bestOfAxis({first, end}, step, a, low[a], size[a], longest, place, best);
      if (cost < best) {
        best = cost;
        axis = a;
      }
    }
    if (axis < 0) {
      int widest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
      std::nth_element(places_.begin() + first, places_.begin() + half, places_.begin() + end,
                       [&](uint32_t i, uint32_t j) {
                         const double x = bounds_[i].center()[widest],
                                      y = bounds_[j].center()[widest];
                         return x != y ? x < y : i < j;
                       });
      return half;
    }
    const auto middle =
        std::stable_partition(places_.begin() + first, places_.begin() + end, [&](uint32_t i) {
          return binOf(bounds_[i].center()[axis], low[axis], size[axis]) < size_t(place);
        });
    return uint32_t(middle - places_.begin());
  }

  static size_t binOf(double v, double low, double size) {
    return size_t(std::clamp((v - low) / size * double(kBins), 0.0, double(kBins - 1)));
  }

  // Least cost over the borders of an axis' bins; sets `place` to the first bin behind the border
  // if it is below `best`.
  double bestOfAxis(const Range& lamps, uint32_t step, int axis, double low, double size,
                    double longest, double& place, double best) const {
    const double pad = 0.01 * longest;
    std::array<Bounds, kBins> bins;
    for (uint32_t i = lamps.first; i < lamps.end; i += step) {
      const Bounds& b = bounds_[places_[i]];
      Bounds& bin = bins[binOf(b.center()[axis], low, size)];
      bin = joined(bin, b);
    }
    std::array<double, kBins> after{};
    Bounds right;
    for (size_t i = kBins - 1; i > 0; --i) {
      right = joined(right, bins[i]);
      after[i] = right.power * areaOf(right, pad) * measureOf(right.cone);
    }
    Bounds left;
    double least = 1e300;
    for (size_t i = 1; i < kBins; ++i) {
      left = joined(left, bins[i - 1]);
      const double cost =
          longest / size * (left.power * areaOf(left, pad) * measureOf(left.cone) + after[i]);
      if (cost < least) {
        least = cost;
        if (cost < best) place = double(i);
      }
    }
    return least;
  }

  struct Cluster {
    uint32_t node, part;
    Range lamps;
  };

  const std::vector<rl::Light>& lights_;
  std::vector<uint32_t> order_;   // lights of the hierarchy
  std::vector<Bounds> bounds_;    // of each of them
  std::vector<uint32_t> places_;  // their order in the hierarchy
  std::vector<glm::uvec4> nodes_;
  std::vector<uint32_t> trails_;
  std::vector<Cluster> clusters_;
  uint32_t mostOfCluster_ = 1;
};

}  // namespace

LightTree buildLightTree(const std::vector<rl::Light>& lights, size_t clusters) {
  return Builder(lights, clusters).take();
}

}  // namespace restlab
