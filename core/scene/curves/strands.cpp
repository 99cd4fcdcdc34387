#include "core/scene/curves/strands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/base/memory.h"

namespace restlab {

namespace {

// Rays tell the sides of a surface apart by 2^-19 of its coordinates (RL_HIT_ERROR).
constexpr double kThinnest = 0x1p-16;
// Squares of radii must be numbers that single precision holds well.
constexpr double kLeastRadius = 1e-15;
// Longer pieces have coarse boxes, and rounding errors that count against their radius.
constexpr double kLongest = 256.0;

using Segment = std::array<glm::dvec4, 4>;  // Bezier points

glm::dvec4 pointAt(const Segment& s, double t) {
  const double r = 1.0 - t;
  return r * r * r * s[0] + 3.0 * r * r * t * s[1] + 3.0 * r * t * t * s[2] + t * t * t * s[3];
}

// The segments of one strand.
std::vector<Segment> segmentsOf(StrandBasis basis, const glm::dvec4* p, size_t count) {
  std::vector<Segment> segments;
  if (basis == StrandBasis::linear) {
    for (size_t i = 0; i + 1 < count; ++i)
      segments.push_back({p[i], glm::mix(p[i], p[i + 1], 1.0 / 3.0),
                          glm::mix(p[i], p[i + 1], 2.0 / 3.0), p[i + 1]});
  } else if (basis == StrandBasis::bezier) {
    for (size_t i = 0; i + 3 < count; i += 3)
      segments.push_back({p[i], p[i + 1], p[i + 2], p[i + 3]});
  } else if (basis == StrandBasis::bspline) {
    for (size_t i = 0; i + 3 < count; ++i) {
      const glm::dvec4 b = (2.0 * p[i + 1] + p[i + 2]) / 3.0, c = (p[i + 1] + 2.0 * p[i + 2]) / 3.0;
      segments.push_back({(p[i] + 4.0 * p[i + 1] + p[i + 2]) / 6.0, b, c,
                          (p[i + 1] + 4.0 * p[i + 2] + p[i + 3]) / 6.0});
    }
  } else {
    for (size_t i = 0; i + 3 < count; ++i)
      segments.push_back({p[i + 1], p[i + 1] + (p[i + 2] - p[i]) / 6.0,
                          p[i + 2] - (p[i + 3] - p[i + 1]) / 6.0, p[i + 2]});
  }
  return segments;
}

double leastRadius(const Segment& s) {
  double least = s[0].w;
  for (int i = 1; i <= 8; ++i) least = std::min(least, pointAt(s, i / 8.0).w);
  return least;
}

// Equal steps of the parameter after which chords are close to the curve: a chord is off by at most
// an eighth of the square of its step times the largest second derivative.
double stepsOf(const Segment& s, StrandBasis basis, double error, size_t strand) {
  const double radius = leastRadius(s);
  if (!(radius > 0.0))
    failInput(
        fmt::format("the radius falls to {:.3g} within strand {}; points closer together, or "
                    "radii that differ less, expected",
                    radius, strand));
  double steps = 1.0;
  if (basis != StrandBasis::linear) {
    const auto bend = [](const glm::dvec4& d) {
      return glm::length(glm::dvec3(d)) + std::abs(d.w);
    };
    const double most =
        6.0 * std::max(bend(s[0] - 2.0 * s[1] + s[2]), bend(s[1] - 2.0 * s[2] + s[3]));
    steps = std::ceil(std::sqrt(most / (8.0 * error * radius)));
  }
  double length = 0.0;
  for (int i = 0; i < 3; ++i) length += glm::distance(glm::dvec3(s[i]), glm::dvec3(s[i + 1]));
  return std::max({steps, 1.0, std::ceil(length / (kLongest * radius))});
}

// A direction across `axis`, the closest one to `before`.
glm::dvec3 across(const glm::dvec3& axis, const glm::dvec3& before) {
  glm::dvec3 x = before - axis * glm::dot(axis, before);
  if (glm::length(x) < 1e-6) {
    const glm::dvec3 a = glm::abs(axis);
    x = glm::cross(axis, a.x < a.y && a.x < a.z ? glm::dvec3(1, 0, 0)
                         : a.y < a.z            ? glm::dvec3(0, 1, 0)
                                                : glm::dvec3(0, 0, 1));
  }
  return glm::normalize(x);
}

void addPiece(const glm::dvec4& from, const glm::dvec4& to, const glm::dvec2& v, size_t strand,
              glm::dvec3& reference, std::vector<StrandPiece>& pieces) {
  StrandPiece piece{glm::vec4(from), glm::vec4(to), {}, glm::vec2(v)};
  for (const glm::vec4& p : {piece.start, piece.end}) {
    const double far = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (!(double(p.w) >= kLeastRadius))
      failInput(fmt::format("strand {} has a radius of {:.3g}; {:g} expected at least", strand, p.w,
                            kLeastRadius));
    if (!(double(p.w) > kThinnest * far))
      failInput(fmt::format(
          "strand {} is too thin for single precision at ({:.6g}, {:.6g}, {:.6g}): its radius "
          "{:.3g} "
          "is below 1/65536 of a coordinate; put its points near 0 and move it with 'translate'",
          strand, p.x, p.y, p.z, p.w));
  }
  const glm::dvec3 way = glm::dvec3(piece.end) - glm::dvec3(piece.start);
  const double length = glm::length(way), fall = std::abs(double(piece.start.w - piece.end.w));
  // A sphere that is all but within the other has no cone with it.
  if (length - fall <= 1e-3 * double(std::min(piece.start.w, piece.end.w))) {
    if (piece.start.w < piece.end.w) {
      piece.start = piece.end;
    } else {
      piece.end = piece.start;
    }
    piece.across = {1.0f, 0.0f, 0.0f};
  } else {
    reference = across(way / length, reference);
    piece.across = glm::vec3(reference);
  }
  pieces.push_back(piece);
}

}  // namespace

const std::vector<std::string>& strandBases() {
  static const std::vector<std::string> kNames{"linear", "bezier", "bspline", "catmull-rom"};
  return kNames;
}

std::string faultOfCount(StrandBasis basis, size_t count) {
  if (basis == StrandBasis::linear)
    return count >= 2 ? "" : fmt::format("a strand of {} points: at least 2 expected", count);
  if (count < 4)
    return fmt::format("a strand of {} points: at least 4 expected of basis '{}'", count,
                       strandBases()[size_t(basis)]);
  if (basis == StrandBasis::bezier && count % 3 != 1)
    return fmt::format("a strand of {} points: 4, 7, 10, ... expected of basis 'bezier'", count);
  return "";
}

std::string faultOfPoint(const glm::dvec4& point) {
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(point[i]) <= kMostStrandCoordinate))
      return fmt::format("coordinate {:g} is out of range; {:g} to {:g} expected", point[i],
                         -kMostStrandCoordinate, kMostStrandCoordinate);
  }
  if (!(point.w >= kLeastRadius && point.w <= kMostStrandCoordinate))
    return fmt::format("radius {:g} is out of range; {:g} to {:g} expected", point.w, kLeastRadius,
                       kMostStrandCoordinate);
  return "";
}

std::vector<StrandPiece> cutStrands(const Strands& strands, double error) {
  std::vector<StrandPiece> pieces;
  static thread_local MemoryGuard memory;
  // A piece itself, twice in a vector that grows; its words and boxes; triangles that stand in.
  constexpr uint64_t kBytes = 1024;
  double total = 0.0;
  const glm::dvec4* points = strands.points.data();
  for (size_t strand = 0; strand < strands.counts.size(); ++strand) {
    const size_t count = strands.counts[strand];
    const std::vector<Segment> segments = segmentsOf(strands.basis, points, count);
    points += count;
    glm::dvec3 reference(0.0);
    for (size_t k = 0; k < segments.size(); ++k) {
      const double steps = stepsOf(segments[k], strands.basis, error, strand);
      total += steps;
      if (total > double(kMostStrandPieces))
        failInput(
            fmt::format("the strands need more than {} pieces; fewer points or a larger "
                        "'error' expected",
                        kMostStrandPieces));
      memory.take("strands", kBytes * uint64_t(steps));
      glm::dvec4 from = segments[k][0];
      for (double i = 1.0; i <= steps; i += 1.0) {
        const glm::dvec4 to = i == steps ? segments[k][3] : pointAt(segments[k], i / steps);
        const glm::dvec2 v = (double(k) + glm::dvec2(i - 1.0, i) / steps) / double(segments.size());
        addPiece(from, to, v, strand, reference, pieces);
        from = to;
      }
    }
  }
  return pieces;
}

}  // namespace restlab
