// Makes the program of a field: what is computed twice is computed once, and constants beforehand.
#pragma once

#include <map>

#include "core/scene/field/program.h"

namespace restlab {

// The part of a text that an operation was read from.
struct TextSpan {
  size_t begin = 0, end = 0;
};

class FieldBuilder {
 public:
  // A number that depends on the place, or a constant.
  struct Number {
    uint32_t node = 0;
  };

  FieldBuilder();

  // Coordinates of the place, in the order x, y, z.
  Number coordinate(uint32_t axis) const { return {axis}; }
  Number constant(double value);
  std::optional<double> valueOf(Number a) const;  // if it is a constant

  Number linear(Number a, double factor, double summand);
  Number plane(const glm::dvec3& normal);  // dot(normal, place)
  Number add(Number a, Number b);
  Number subtract(Number a, Number b);
  Number multiply(Number a, Number b);
  Number divide(Number a, Number b);
  Number least(Number a, Number b);
  Number largest(Number a, Number b);
  // kind: an operation of one argument.
  Number apply(uint32_t kind, Number a);
  Number power(Number a, int exponent);
  // A grid of the program at a place.
  Number grid(uint32_t which, Number x, Number y, Number z);

  // The text that operations are made from until the next call.
  void from(TextSpan span) { span_ = span; }

  // Throws Error (badInput): too many operations, or too many numbers at a time. spans: of each
  // instruction.
  FieldProgram program(Number result, std::vector<TextSpan>* spans = nullptr) const;

 private:
  struct Node {
    uint32_t kind = 0;
    uint32_t a = 0, b = 0;
    std::array<float, 3> constants{};
    std::optional<double> value{};
    TextSpan span{};
    uint32_t registers = 1;  // about so many are needed to compute it
    uint32_t c = 0, grid = 0;
  };
  Number make(uint32_t kind, Number a, Number b, const std::array<float, 3>& constants = {});
  Number binary(uint32_t kind, Number a, Number b);
  // A number in a register: constants are made instructions.
  Number held(Number a);
  // Nodes that a node is computed from, the one that needs most registers first.
  std::vector<uint32_t> operands(const Node& node) const;

  std::vector<Node> nodes_;
  std::map<std::array<uint32_t, 6>, uint32_t> known_;
  TextSpan span_;
};

}  // namespace restlab
