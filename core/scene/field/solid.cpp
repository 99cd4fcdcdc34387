#include "core/scene/field/solid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/scene/field/fault.h"
#include "core/scene/field/solid_tree.h"

namespace restlab {

namespace {

using Number = FieldBuilder::Number;

// Where a solid is asked for its distance: an affine map of three numbers.
struct Place {
  std::array<Number, 3> base;
  glm::dmat3 turn{1.0};
  glm::dvec3 move{0.0};
  bool isOfBox = true;  // the numbers are the coordinates
};

class Distances {
 public:
  explicit Distances(FieldBuilder& builder) : f_(builder) {}

  Number of(const Solid& solid, const Place& at) {
    const std::vector<double>& n = solid.numbers;
    switch (solid.kind) {
      case SolidKind::sphere:
        return plus(length({axis(at, 0), axis(at, 1), axis(at, 2)}), -n[0]);
      case SolidKind::box: {
        std::vector<Number> beyond;
        for (int c = 0; c < 3; ++c)
          beyond.push_back(plus(apply(rl::RL_FIELD_ABS, axis(at, c)), -n[size_t(c)]));
        return boxed(beyond);
      }
      case SolidKind::torus:
        return plus(length({plus(length({axis(at, 0), axis(at, 1)}), -n[0]), axis(at, 2)}), -n[1]);
      case SolidKind::capsule: {
        const Number beyond = atLeast(plus(apply(rl::RL_FIELD_ABS, axis(at, 2)), -0.5 * n[0]), 0.0);
        return plus(length({axis(at, 0), axis(at, 1), beyond}), -n[1]);
      }
      case SolidKind::cylinder:
        return boxed({plus(length({axis(at, 0), axis(at, 1)}), -n[1]),
                      plus(apply(rl::RL_FIELD_ABS, axis(at, 2)), -0.5 * n[0])});
      case SolidKind::plane: {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(n[0], n[1], n[2]));
        const glm::dvec3 turned = glm::transpose(at.turn) * normal;
        return plus(combined(at, turned), glm::dot(normal, at.move) - n[3]);
      }
      case SolidKind::unite:
      case SolidKind::intersect:
      case SolidKind::subtract:
      case SolidKind::smoothUnite:
      case SolidKind::smoothIntersect:
      case SolidKind::smoothSubtract:
        return joined(solid, at);
      case SolidKind::round:
        return plus(of(solid.parts[0], at), -n[0]);
      case SolidKind::shell:
        return plus(apply(rl::RL_FIELD_ABS, of(solid.parts[0], at)), -0.5 * n[0]);
      case SolidKind::scale:
        return f_.linear(of(solid.parts[0], mapped(at, glm::dmat3(1.0 / n[0]), glm::dvec3(0.0))),
                         n[0], 0.0);
      case SolidKind::translate:
        return of(solid.parts[0], mapped(at, glm::dmat3(1.0), -glm::dvec3(n[0], n[1], n[2])));
      case SolidKind::rotate: {
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), glm::radians(n[3]),
                                          glm::normalize(glm::dvec3(n[0], n[1], n[2]))));
        return of(solid.parts[0], mapped(at, glm::transpose(turn), glm::dvec3(0.0)));
      }
      case SolidKind::repeat:
        return repeated(solid, at);
      case SolidKind::twist:
        return twisted(solid, at);
      case SolidKind::grid:
        return f_.grid(numberOf(*solid.grid), axis(at, 0), axis(at, 1), axis(at, 2));
      case SolidKind::displace:
        break;
    }
    Number waves = f_.constant(n[0]);
    for (int c = 0; c < 3; ++c)
      waves = f_.multiply(waves, apply(rl::RL_FIELD_SIN, f_.linear(axis(at, c), n[1], 0.0)));
    return f_.add(of(solid.parts[0], at), waves);
  }

  const std::vector<FieldGrid>& grids() const { return grids_; }

 private:
  Number plus(Number a, double b) { return f_.linear(a, 1.0, b); }
  Number apply(uint32_t kind, Number a) { return f_.apply(kind, a); }
  Number atLeast(Number a, double b) { return f_.largest(a, f_.constant(b)); }

  Number length(const std::vector<Number>& of) {
    Number sum = apply(rl::RL_FIELD_SQUARE, of[0]);
    for (size_t i = 1; i < of.size(); ++i) sum = f_.add(sum, apply(rl::RL_FIELD_SQUARE, of[i]));
    return apply(rl::RL_FIELD_SQRT, sum);
  }

  // Distance of a box: what lies beyond each of its pairs of sides.
  Number boxed(const std::vector<Number>& beyond) {
    std::vector<Number> outside;
    Number furthest = beyond[0];
    for (const Number& b : beyond) outside.push_back(atLeast(b, 0.0));
    for (size_t i = 1; i < beyond.size(); ++i) furthest = f_.largest(furthest, beyond[i]);
    return f_.add(length(outside), f_.least(furthest, f_.constant(0.0)));
  }

  // Sum of the base times weights.
  Number combined(const Place& at, const glm::dvec3& weights) {
    int count = 0;
    for (int c = 0; c < 3; ++c) count += weights[c] != 0.0 ? 1 : 0;
    if (at.isOfBox && count > 1) return f_.plane(weights);
    std::optional<Number> sum;
    for (int c = 0; c < 3; ++c) {
      if (weights[c] == 0.0) continue;
      const Number one = f_.linear(at.base[size_t(c)], weights[c], 0.0);
      sum = sum ? f_.add(*sum, one) : one;
    }
    return sum ? *sum : f_.constant(0.0);
  }

  Number axis(const Place& at, int c) {
    return plus(combined(at, glm::transpose(at.turn)[c]), at.move[c]);
  }

  static Place mapped(Place at, const glm::dmat3& by, const glm::dvec3& move) {
    at.turn = by * at.turn;
    at.move = by * at.move + move;
    // Quarter turns leave no rests that would be instructions.
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r)
        if (std::abs(at.turn[c][r]) < 1e-14) at.turn[c][r] = 0.0;
    return at;
  }

  Number joined(const Solid& solid, const Place& at) {
    const SolidKind kind = solid.kind;
    const bool isSmooth = kind == SolidKind::smoothUnite || kind == SolidKind::smoothIntersect ||
                          kind == SolidKind::smoothSubtract;
    const bool unites = kind == SolidKind::unite || kind == SolidKind::smoothUnite;
    const bool subtracts = kind == SolidKind::subtract || kind == SolidKind::smoothSubtract;
    Number all = of(solid.parts[0], at);
    for (size_t i = 1; i < solid.parts.size(); ++i) {
      Number part = of(solid.parts[i], at);
      if (subtracts) part = f_.linear(part, -1.0, 0.0);
      const Number sharp = unites ? f_.least(all, part) : f_.largest(all, part);
      if (isSmooth) {
        // Quadratic within the radius k: h^2 / (4 k), h = max(k - |a - b|, 0).
        const double k = solid.numbers[0];
        const Number apart = apply(rl::RL_FIELD_ABS, f_.subtract(all, part));
        const Number h = atLeast(f_.linear(apart, -1.0, k), 0.0);
        all = f_.add(sharp,
                     f_.linear(apply(rl::RL_FIELD_SQUARE, h), (unites ? -0.25 : 0.25) / k, 0.0));
      } else {
        all = sharp;
      }
    }
    return all;
  }

  // Copies at these distances, each the mirror image of its neighbour: the distance has no steps.
  Number repeated(const Solid& solid, const Place& at) {
    Place folded;
    folded.isOfBox = false;
    for (int c = 0; c < 3; ++c) {
      const double period = solid.numbers[size_t(c)];
      Number x = axis(at, c);
      if (period > 0.0)
        x = f_.linear(apply(rl::RL_FIELD_FOLD, f_.linear(x, 1.0 / period, 0.5)), period,
                      -0.5 * period);
      folded.base[size_t(c)] = x;
    }
    return of(solid.parts[0], folded);
  }

  Number twisted(const Solid& solid, const Place& at) {
    const Number x = axis(at, 0), y = axis(at, 1), z = axis(at, 2);
    const Number angle = f_.linear(z, glm::radians(solid.numbers[0]), 0.0);
    const Number c = apply(rl::RL_FIELD_COS, angle), s = apply(rl::RL_FIELD_SIN, angle);
    Place turned;
    turned.isOfBox = false;
    turned.base = {f_.add(f_.multiply(c, x), f_.multiply(s, y)),
                   f_.subtract(f_.multiply(c, y), f_.multiply(s, x)), z};
    return of(solid.parts[0], turned);
  }

  uint32_t numberOf(const FieldGrid& grid) {
    for (size_t i = 0; i < grids_.size(); ++i)
      if (grids_[i].words() == grid.words()) return uint32_t(i);
    grids_.push_back(grid);
    return uint32_t(grids_.size() - 1);
  }

  FieldBuilder& f_;
  std::vector<FieldGrid> grids_;
};

// Around the solid with room for rounding.
std::array<glm::vec3, 2> boxFor(const Solid& solid) {
  const std::optional<SolidBox> bounds = boundsOf(solid);
  if (!bounds) failInput("the solid has no end: give a 'box' that cuts it off");
  if (!(bounds->low.x <= bounds->high.x)) failInput("no sample of a grid is 0 or below");
  const glm::dvec3 size = glm::max(bounds->high - bounds->low, glm::dvec3(0.0));
  const glm::dvec3 far = glm::max(glm::abs(bounds->low), glm::abs(bounds->high));
  const double margin =
      0.02 * std::max({size.x, size.y, size.z}) + 1e-3 * std::max({far.x, far.y, far.z});
  return {glm::vec3(bounds->low - margin), glm::vec3(glm::max(bounds->high, bounds->low) + margin)};
}

}  // namespace

FieldProgram readSolid(const std::string& text, const std::optional<std::array<glm::vec3, 2>>& box,
                       const GridFiles& files) {
  const Solid solid = readSolidTree(text, files);
  FieldBuilder builder;
  Place place;
  for (uint32_t c = 0; c < 3; ++c) place.base[c] = builder.coordinate(c);
  Distances distances(builder);
  FieldProgram program = builder.program(distances.of(solid, place));
  program.grids = distances.grids();
  const std::array<glm::vec3, 2> within = box ? *box : boxFor(solid);
  program.low = within[0];
  program.high = within[1];
  if (const auto fault = findFault(program))
    failInput(fmt::format("a number of the solid {} somewhere in the box", fault->why));
  program.isClosed = isFieldClosed(program);
  if (!box && !program.isClosed)
    failInput("the solid reaches beyond what its parts say: give a 'box'");
  return program;
}

}  // namespace restlab
