#include "core/scene/curves/curve_words.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace restlab {

namespace {

constexpr size_t kPiecesOfLeaf = 3;  // at most, nearly
constexpr double kBoxPad = 1e-6;     // of coordinates: rounding errors of points and rays

struct CurveBox {
  glm::dvec3 low{1e300}, high{-1e300};
};

CurveBox boxOf(const StrandPiece& piece) {
  CurveBox box;
  for (const glm::vec4& s : {piece.start, piece.end}) {
    box.low = glm::min(box.low, glm::dvec3(s) - double(s.w));
    box.high = glm::max(box.high, glm::dvec3(s) + double(s.w));
  }
  return box;
}

uint32_t bitsOf(float x) { return std::bit_cast<uint32_t>(x); }
float numberOf(uint32_t x) { return std::bit_cast<float>(x); }

class CurveTree {
 public:
  explicit CurveTree(std::vector<StrandPiece>& pieces) : pieces_(pieces) {
    while (leaves_ * kPiecesOfLeaf < pieces.size()) leaves_ *= 2;
    words_.resize(8 * 2 * leaves_ + 12 * pieces.size());
    build(1, 0, pieces.size());
    words_[0] = uint32_t(leaves_);
    words_[1] = uint32_t(4 * leaves_);
    words_[2] = uint32_t(pieces.size());
    uint32_t* to = words_.data() + 16 * leaves_;
    for (const StrandPiece& p : pieces) {
      const glm::vec2 across = octahedralOf(p.across);
      for (const float x : {p.start.x, p.start.y, p.start.z, p.start.w, p.end.x, p.end.y, p.end.z,
                            p.end.w, across.x, across.y, p.v.x, p.v.y})
        *to++ = bitsOf(x);
    }
  }
  std::vector<uint32_t> words() { return std::move(words_); }

 private:
  CurveBox build(size_t node, size_t begin, size_t end) {
    CurveBox box;
    uint32_t* words = words_.data() + 8 * node;
    if (node >= leaves_) {
      for (size_t i = begin; i < end; ++i) {
        const CurveBox one = boxOf(pieces_[i]);
        box = {glm::min(box.low, one.low), glm::max(box.high, one.high)};
      }
      words[3] = uint32_t(begin);
      words[7] = uint32_t(end);
    } else {
      const size_t middle = split(begin, end);
      const CurveBox a = build(2 * node, begin, middle), b = build(2 * node + 1, middle, end);
      box = {glm::min(a.low, b.low), glm::max(a.high, b.high)};
    }
    const glm::dvec3 far = glm::max(glm::abs(box.low), glm::abs(box.high));
    const double pad = kBoxPad * std::max({far.x, far.y, far.z});
    for (int i = 0; i < 3; ++i) {
      words[i] = bitsOf(float(box.low[i] - pad));
      words[4 + i] = bitsOf(float(box.high[i] + pad));
    }
    return box;
  }

  // Halves the pieces along the axis on which their middles are farthest apart.
  size_t split(size_t begin, size_t end) {
    CurveBox of;
    for (size_t i = begin; i < end; ++i) {
      const glm::dvec3 at(pieces_[i].start + pieces_[i].end);
      of = {glm::min(of.low, at), glm::max(of.high, at)};
    }
    const glm::dvec3 size = of.high - of.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const size_t middle = (begin + end) / 2;
    const auto at = [&](size_t i) { return pieces_.begin() + ptrdiff_t(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [axis](const StrandPiece& a, const StrandPiece& b) {
                       return a.start[axis] + a.end[axis] < b.start[axis] + b.end[axis];
                     });
    return middle;
  }

  static glm::vec2 octahedralOf(const glm::vec3& n) {
    const glm::vec3 p = n / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    if (p.z >= 0.0f) return {p.x, p.y};
    return {std::copysign(1.0f - std::abs(p.y), p.x), std::copysign(1.0f - std::abs(p.x), p.y)};
  }

  std::vector<StrandPiece>& pieces_;
  size_t leaves_ = 1;
  std::vector<uint32_t> words_;
};

glm::vec3 vec3Of(const uint32_t* words) {
  return {numberOf(words[0]), numberOf(words[1]), numberOf(words[2])};
}

bool isInNode(const std::vector<uint32_t>& words, size_t node, const glm::dvec3& p) {
  const uint32_t* box = words.data() + 8 * node;
  const glm::dvec3 low(vec3Of(box)), high(vec3Of(box + 4));
  if (!glm::all(glm::lessThanEqual(low, p)) || !glm::all(glm::lessThanEqual(p, high))) return false;
  if (node < words[0]) return isInNode(words, 2 * node, p) || isInNode(words, 2 * node + 1, p);
  for (size_t i = box[3]; i < box[7]; ++i) {
    if (distanceTo(curvePiece(words, i), p) < 0.0) return true;
  }
  return false;
}

}  // namespace

std::vector<uint32_t> curveWords(std::vector<StrandPiece> pieces) {
  return CurveTree(pieces).words();
}

size_t curvePieces(const std::vector<uint32_t>& words) { return words[2]; }

StrandPiece curvePiece(const std::vector<uint32_t>& words, size_t piece) {
  const uint32_t* w = words.data() + 4 * size_t{words[1]} + 12 * piece;
  const auto vec4Of = [](const uint32_t* at) { return glm::vec4(vec3Of(at), numberOf(at[3])); };
  glm::vec3 across(numberOf(w[8]), numberOf(w[9]), 0.0f);
  across.z = 1.0f - std::abs(across.x) - std::abs(across.y);
  if (across.z < 0.0f) {
    const glm::vec2 folded(std::copysign(1.0f - std::abs(across.y), across.x),
                           std::copysign(1.0f - std::abs(across.x), across.y));
    across.x = folded.x;
    across.y = folded.y;
  }
  return {vec4Of(w), vec4Of(w + 4), glm::normalize(across), {numberOf(w[10]), numberOf(w[11])}};
}

std::array<glm::vec3, 2> boxOfCurves(const std::vector<uint32_t>& words) {
  return {vec3Of(&words[8]), vec3Of(&words[12])};
}

bool isInCurves(const std::vector<uint32_t>& words, const glm::dvec3& posL) {
  return isInNode(words, 1, posL);
}

double distanceTo(const StrandPiece& piece, const glm::dvec3& posL) {
  const glm::dvec3 start(piece.start), way = glm::dvec3(piece.end) - start, at = posL - start;
  const double length = glm::length(way), r0 = double(piece.start.w), r1 = double(piece.end.w);
  if (!(length > 0.0)) return glm::length(at) - r0;
  const double sine = (r0 - r1) / length, cosine = std::sqrt(1.0 - sine * sine);
  const double y = glm::dot(at, way) / length;
  const double rho = glm::length(at - way * (y / length));
  const double foot = y - rho * sine / cosine;  // of the normal, on the axis
  if (foot <= 0.0) return glm::length(at) - r0;
  if (foot >= length) return glm::length(at - way) - r1;
  return y * sine + rho * cosine - r0;
}

}  // namespace restlab
