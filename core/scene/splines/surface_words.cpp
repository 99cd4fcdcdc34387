#include "core/scene/splines/surface_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/error.h"
#include "core/dialect/types.h"

namespace restlab {

namespace {

constexpr double kMostTurn = 0.5;  // of the normal along one direction of a piece, radians
constexpr double kMostBend = 0.5;  // change of a tangent over its length
constexpr size_t kMostCuts = 32;   // parts of a Bezier piece along one direction
constexpr size_t kSamples = 5;     // along one direction
constexpr double kPad = 0x1p-20;   // of boxes

using Samples = std::array<SplinePoint, kSamples * kSamples>;

Samples samplesOf(const BezierPiece& piece) {
  Samples samples;
  for (size_t j = 0; j < kSamples; ++j) {
    for (size_t i = 0; i < kSamples; ++i)
      samples[j * kSamples + i] =
          evaluate(piece, fraction(i, kSamples - 1), fraction(j, kSamples - 1));
  }
  return samples;
}

double angleOf(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Whether the normal turns, or the tangent changes, too much along u (isAlongU) or v.
bool mustCut(const Samples& samples, bool isAlongU) {
  double longest = 0.0, change = 0.0, turn = 0.0;
  for (size_t line = 0; line < kSamples; ++line) {
    const auto at = [&](size_t k) -> const SplinePoint& {
      return samples[isAlongU ? line * kSamples + k : k * kSamples + line];
    };
    const auto tangent = [&](size_t k) { return isAlongU ? at(k).du : at(k).dv; };
    for (size_t k = 0; k < kSamples; ++k) {
      longest = std::max(longest, glm::length(tangent(k)));
      change = std::max(change, glm::length(tangent(k) - tangent(0)));
      turn = std::max(turn, angleOf(at(k).normal, at(0).normal));
    }
  }
  return turn > kMostTurn || change > kMostBend * longest;
}

glm::dvec3 pointOf(const glm::dvec4& h) { return glm::dvec3(h) / h.w; }

// Indices of the net along an edge: 0 and 1 are s = 0 and 1, 2 and 3 t = 0 and 1.
std::vector<size_t> edgeOf(const BezierPiece& piece, int edge) {
  const size_t width = size_t(piece.degreeU) + 1, height = size_t(piece.degreeV) + 1;
  std::vector<size_t> points;
  for (size_t k = 0; k < (edge < 2 ? height : width); ++k)
    points.push_back(edge < 2 ? k * width + (edge == 1 ? width - 1 : 0)
                              : k + (edge == 3 ? width * (height - 1) : 0));
  return points;
}

bool isPoint(const BezierPiece& piece, int edge, double size) {
  const std::vector<size_t> points = edgeOf(piece, edge);
  return std::all_of(points.begin(), points.end(), [&](size_t i) {
    return glm::distance(pointOf(piece.net[i]), pointOf(piece.net[points[0]])) <= 1e-9 * size;
  });
}

double sizeOf(const std::vector<BezierPiece>& pieces) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const BezierPiece& piece : pieces) {
    for (const glm::dvec4& h : piece.net) {
      low = glm::min(low, pointOf(h));
      high = glm::max(high, pointOf(h));
    }
  }
  return glm::length(high - low);
}

BezierGrid cut(const BezierGrid& grid, const std::vector<size_t>& u, const std::vector<size_t>& v) {
  const auto linesOf = [](const std::vector<double>& knots, const std::vector<size_t>& parts) {
    std::vector<double> lines;
    for (size_t k = 0; k < parts.size(); ++k) {
      for (size_t i = 0; i < parts[k]; ++i)
        lines.push_back(knots[k] + (knots[k + 1] - knots[k]) * double(i) / double(parts[k]));
    }
    lines.push_back(knots.back());
    return lines;
  };
  BezierGrid result{linesOf(grid.linesU, u), linesOf(grid.linesV, v), {}};
  for (size_t y = 0; y < v.size(); ++y) {
    for (size_t j = 0; j < v[y]; ++j) {
      for (size_t x = 0; x < u.size(); ++x) {
        for (size_t i = 0; i < u[x]; ++i)
          result.pieces.push_back(part(grid.pieces[y * grid.columns() + x],
                                       double(i) / double(u[x]), double(i + 1) / double(u[x]),
                                       double(j) / double(v[y]), double(j + 1) / double(v[y])));
      }
    }
  }
  return result;
}

// Cuts columns and rows until every piece is flat enough, or kMostCuts.
BezierGrid flattened(const BezierGrid& grid, double size) {
  std::vector<size_t> u(grid.columns(), 1), v(grid.rows(), 1);
  // A piece has one point at most as its edge: it is the origin of its net.
  for (size_t k = 0; k < grid.pieces.size(); ++k) {
    const BezierPiece& piece = grid.pieces[k];
    if (isPoint(piece, 0, size) && isPoint(piece, 1, size)) u[k % grid.columns()] = 2;
    if (isPoint(piece, 2, size) && isPoint(piece, 3, size)) v[k / grid.columns()] = 2;
  }
  for (;;) {
    BezierGrid result = cut(grid, u, v);
    if (result.pieces.size() > kMostSurfacePieces)
      failInput(
          fmt::format("the surface needs more than {} flat pieces to be met exactly: "
                      "way = \"mesh\" or fewer points",
                      kMostSurfacePieces));
    std::vector<bool> cutsU(u.size(), false), cutsV(v.size(), false);
    const auto owner = [](const std::vector<size_t>& parts, size_t line) {
      size_t k = 0;
      while (line >= parts[k]) line -= parts[k++];
      return k;
    };
    for (size_t k = 0; k < result.pieces.size(); ++k) {
      const Samples samples = samplesOf(result.pieces[k]);
      if (mustCut(samples, true)) cutsU[owner(u, k % result.columns())] = true;
      if (mustCut(samples, false)) cutsV[owner(v, k / result.columns())] = true;
    }
    bool isDone = true;
    const auto raise = [&](std::vector<size_t>& parts, const std::vector<bool>& cuts) {
      for (size_t k = 0; k < parts.size(); ++k) {
        if (!cuts[k] || parts[k] >= kMostCuts) continue;
        parts[k] *= 2;
        isDone = false;
      }
    };
    raise(u, cutsU);
    raise(v, cutsV);
    if (isDone) return result;
  }
}

using Words = std::vector<glm::uvec4>;

glm::uvec4 bits(const glm::vec4& v) { return std::bit_cast<glm::uvec4>(v); }

struct Box {
  glm::dvec3 low{1e300}, high{-1e300};
  uint32_t pole = 0;  // of a piece
};

// Appends a piece to the words; returns its box.
Box addPiece(const BezierPiece& piece, double size, const glm::vec4& texture, Words& words) {
  Box box;
  glm::dvec3 origin = evaluate(piece, fraction(1, 2), fraction(1, 2)).position;
  for (int edge = 0; edge < 4; ++edge) {
    if (!isPoint(piece, edge, size)) continue;
    box.pole = uint32_t(edge) + 1;
    origin = pointOf(piece.net[edgeOf(piece, edge)[0]]);
  }
  origin = glm::dvec3(glm::vec3(origin));
  double heaviest = 0.0;
  for (const glm::dvec4& h : piece.net) heaviest = std::max(heaviest, h.w);
  std::vector<glm::vec4> net;
  for (const glm::dvec4& h : piece.net)
    net.emplace_back((glm::dvec3(h) - origin * h.w) / heaviest, h.w / heaviest);
  for (int edge = 0; edge < 4; ++edge) {
    if (!isPoint(piece, edge, size)) continue;
    for (const size_t i : edgeOf(piece, edge)) net[i] = {0.0f, 0.0f, 0.0f, net[i].w};
  }
  double radius = 0.0;
  for (const glm::vec4& h : net) {
    const glm::dvec3 local = glm::dvec3(h) / double(h.w);
    radius = std::max(radius, glm::length(local));
    box.low = glm::min(box.low, origin + local);
    box.high = glm::max(box.high, origin + local);
  }
  const glm::dvec3 largest = glm::max(glm::abs(box.low), glm::abs(box.high));
  const double pad = kPad * (radius + std::max({largest.x, largest.y, largest.z}));
  box.low -= pad;
  box.high += pad;
  const Samples samples = samplesOf(piece);
  glm::dvec3 normal(0.0);
  for (const SplinePoint& p : samples) normal += p.normal;
  double angle = 2.0;
  if (glm::length(normal) > 0.0) {
    normal = glm::normalize(normal);
    angle = 0.0;
    for (const SplinePoint& p : samples) angle = std::max(angle, angleOf(p.normal, normal));
    angle = 1.2 * angle + 0.02;
  }
  const double sine = angle < 1.4 ? std::sin(angle) : 2.0;
  words.push_back(bits(glm::vec4(origin, radius)));
  words.push_back(bits(glm::vec4(normal, sine)));
  words.push_back(bits(texture));
  for (const glm::vec4& h : net) words.push_back(bits(h));
  return box;
}

struct Node {
  Box box;
  uint32_t piece = rl::RL_INVALID;
};

struct Range {
  size_t x0, x1, y0, y1;
};

Box buildNode(size_t node, const Range& r, size_t columns, const std::vector<Box>& boxes,
              std::vector<Node>& nodes) {
  if (nodes.size() <= node) nodes.resize(node + 1);
  Box box;
  if (r.x1 - r.x0 == 1 && r.y1 - r.y0 == 1) {
    nodes[node].piece = uint32_t(r.y0 * columns + r.x0);
    box = boxes[nodes[node].piece];
  } else {
    Range low = r, high = r;
    if (r.x1 - r.x0 >= r.y1 - r.y0) {
      low.x1 = high.x0 = (r.x0 + r.x1) / 2;
    } else {
      low.y1 = high.y0 = (r.y0 + r.y1) / 2;
    }
    const Box a = buildNode(2 * node, low, columns, boxes, nodes);
    const Box b = buildNode(2 * node + 1, high, columns, boxes, nodes);
    box = {glm::min(a.low, b.low), glm::max(a.high, b.high), 0};
  }
  nodes[node].box = box;
  return box;
}

}  // namespace

std::vector<uint32_t> surfaceWords(const BezierGrid& grid) {
  const double size = sizeOf(grid.pieces);
  const BezierGrid flat = flattened(grid, size);
  Words pieces;
  std::vector<Box> boxes;
  const auto texture = [](const std::vector<double>& lines, size_t i) {
    return float((lines[i] - lines.front()) / (lines.back() - lines.front()));
  };
  for (size_t k = 0; k < flat.pieces.size(); ++k) {
    const size_t x = k % flat.columns(), y = k / flat.columns();
    boxes.push_back(addPiece(flat.pieces[k], size,
                             {texture(flat.linesU, x), texture(flat.linesV, y),
                              texture(flat.linesU, x + 1), texture(flat.linesV, y + 1)},
                             pieces));
  }
  std::vector<Node> nodes;
  const Box whole = buildNode(1, {0, flat.columns(), 0, flat.rows()}, flat.columns(), boxes, nodes);
  const glm::vec3 extent(glm::max(glm::abs(whole.low), glm::abs(whole.high)));
  const auto first = uint32_t(2 * nodes.size());
  Words words;
  words.emplace_back(flat.columns(), flat.rows(), grid.pieces[0].degreeU, grid.pieces[0].degreeV);
  words.emplace_back(glm::uvec3(bits(glm::vec4(extent, 0.0f))), first);
  for (size_t k = 1; k < nodes.size(); ++k) {
    const Node& node = nodes[k];
    words.emplace_back(glm::uvec3(bits(glm::vec4(node.box.low, 0.0f))), node.piece);
    words.emplace_back(glm::uvec3(bits(glm::vec4(node.box.high, 0.0f))), node.box.pole);
  }
  words.insert(words.end(), pieces.begin(), pieces.end());
  std::vector<uint32_t> flatWords;
  for (const glm::uvec4& w : words) flatWords.insert(flatWords.end(), {w.x, w.y, w.z, w.w});
  return flatWords;
}

BezierGrid surfaceOfWords(const std::vector<uint32_t>& words) {
  const auto vec4At = [&](size_t i) {
    return glm::dvec4(std::bit_cast<float>(words[4 * i]), std::bit_cast<float>(words[4 * i + 1]),
                      std::bit_cast<float>(words[4 * i + 2]),
                      std::bit_cast<float>(words[4 * i + 3]));
  };
  const size_t columns = words[0], rows = words[1];
  const int degreeU = int(words[2]), degreeV = int(words[3]);
  const size_t points = size_t(degreeU + 1) * size_t(degreeV + 1);
  BezierGrid grid{std::vector<double>(columns + 1), std::vector<double>(rows + 1), {}};
  size_t at = words[7];
  for (size_t k = 0; k < columns * rows; ++k) {
    const glm::dvec3 origin(vec4At(at));
    const glm::dvec4 texture = vec4At(at + 2);
    grid.linesU[k % columns] = texture.x;
    grid.linesV[k / columns] = texture.y;
    grid.linesU[k % columns + 1] = texture.z;
    grid.linesV[k / columns + 1] = texture.w;
    BezierPiece piece{degreeU, degreeV, {}};
    for (size_t i = 0; i < points; ++i) {
      const glm::dvec4 h = vec4At(at + 3 + i);
      piece.net.emplace_back(glm::dvec3(h) + origin * h.w, h.w);
    }
    grid.pieces.push_back(std::move(piece));
    at += 3 + points;
  }
  return grid;
}

std::array<glm::vec3, 2> boxOfWords(const std::vector<uint32_t>& words) {
  const auto at = [&](size_t i) {
    return glm::vec3(std::bit_cast<float>(words[i]), std::bit_cast<float>(words[i + 1]),
                     std::bit_cast<float>(words[i + 2]));
  };
  return {at(8), at(12)};
}

}  // namespace restlab
