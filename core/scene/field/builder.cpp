#include "core/scene/field/builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/error.h"

namespace restlab {

namespace {

constexpr uint32_t kPlace = rl::RL_FIELD_KINDS;         // a coordinate
constexpr uint32_t kConstant = rl::RL_FIELD_KINDS + 1;  // not yet an instruction
constexpr size_t kMostInstructions = 256, kMostNodes = 4096;

bool hasThree(uint32_t kind) { return kind == rl::RL_FIELD_GRID; }
bool hasTwo(uint32_t kind) {
  return hasThree(kind) || kind == rl::RL_FIELD_ADD || kind == rl::RL_FIELD_SUBTRACT ||
         kind == rl::RL_FIELD_MULTIPLY || kind == rl::RL_FIELD_LENGTH || kind == rl::RL_FIELD_MIN ||
         kind == rl::RL_FIELD_MAX;
}
bool hasOne(uint32_t kind) { return kind < rl::RL_FIELD_KINDS && kind != rl::RL_FIELD_PLANE; }

double checked(double value) {
  if (!(std::abs(value) <= 1e15))
    failInput(fmt::format("{:g} is not a number of at most 1e15", value));
  return value;
}

}  // namespace

FieldBuilder::FieldBuilder() {
  for (uint32_t axis = 0; axis < 3; ++axis) nodes_.push_back({kPlace, axis, 0});
}

FieldBuilder::Number FieldBuilder::make(uint32_t kind, Number a, Number b,
                                        const std::array<float, 3>& constants) {
  const std::array<uint32_t, 6> key{kind,
                                    a.node,
                                    b.node,
                                    std::bit_cast<uint32_t>(constants[0]),
                                    std::bit_cast<uint32_t>(constants[1]),
                                    std::bit_cast<uint32_t>(constants[2])};
  const auto [found, isNew] = known_.try_emplace(key, static_cast<uint32_t>(nodes_.size()));
  if (!isNew) return {found->second};
  if (nodes_.size() >= kMostNodes) failInput("too long: it has thousands of operations");
  Node node{kind, a.node, b.node, constants, {}, span_};
  if (hasThree(kind)) {
    node.c = std::bit_cast<uint32_t>(constants[0]);
    node.grid = std::bit_cast<uint32_t>(constants[1]);
  }
  // Results of those that are computed first wait in registers.
  const std::vector<uint32_t> from = operands(node);
  for (size_t i = 0; i < from.size(); ++i)
    node.registers = std::max(node.registers, nodes_[from[i]].registers + uint32_t(i));
  nodes_.push_back(node);
  return {found->second};
}

FieldBuilder::Number FieldBuilder::constant(double value) {
  const auto bits = std::bit_cast<std::array<float, 2>>(checked(value));
  const Number number = make(kConstant, {0}, {0}, {bits[0], bits[1], 0.0f});
  nodes_[number.node].value = value;
  return number;
}

std::optional<double> FieldBuilder::valueOf(Number a) const { return nodes_[a.node].value; }

FieldBuilder::Number FieldBuilder::linear(Number a, double factor, double summand) {
  if (const auto value = valueOf(a)) return constant(factor * *value + summand);
  if (checked(factor) == 0.0) return constant(summand);
  if (factor == 1.0 && summand == 0.0) return a;
  const Node& of = nodes_[a.node];
  // A product and a sum are one instruction; further ones are rounded as they are written.
  if (of.kind == rl::RL_FIELD_LINEAR && (factor == 1.0 || of.constants[1] == 0.0f)) {
    const double k = checked(factor * double(of.constants[0]));
    checked(factor * double(of.constants[1]) + summand);
    return make(rl::RL_FIELD_LINEAR, {of.a}, {0},
                {float(k), float(factor * double(of.constants[1]) + summand), 0.0f});
  }
  return make(rl::RL_FIELD_LINEAR, a, {0}, {float(factor), float(checked(summand)), 0.0f});
}

FieldBuilder::Number FieldBuilder::plane(const glm::dvec3& normal) {
  return make(rl::RL_FIELD_PLANE, {0}, {0}, {float(normal.x), float(normal.y), float(normal.z)});
}

std::vector<uint32_t> FieldBuilder::operands(const Node& node) const {
  std::vector<uint32_t> of;
  if (hasOne(node.kind)) of.push_back(node.a);
  if (hasTwo(node.kind)) of.push_back(node.b);
  if (hasThree(node.kind)) of.push_back(node.c);
  std::stable_sort(of.begin(), of.end(), [&](uint32_t x, uint32_t y) {
    return nodes_[x].registers > nodes_[y].registers;
  });
  return of;
}

FieldBuilder::Number FieldBuilder::held(Number a) {
  const auto value = valueOf(a);
  return value ? make(rl::RL_FIELD_LINEAR, {0}, {0}, {0.0f, float(*value), 0.0f}) : a;
}

FieldBuilder::Number FieldBuilder::binary(uint32_t kind, Number a, Number b) {
  a = held(a);
  return make(kind, a, held(b));
}

FieldBuilder::Number FieldBuilder::grid(uint32_t which, Number x, Number y, Number z) {
  x = held(x);
  y = held(y);
  const std::array<float, 3> more{std::bit_cast<float>(held(z).node), std::bit_cast<float>(which),
                                  0.0f};
  return make(rl::RL_FIELD_GRID, x, y, more);
}

FieldBuilder::Number FieldBuilder::add(Number a, Number b) {
  if (const auto value = valueOf(b)) return linear(a, 1.0, *value);
  if (const auto value = valueOf(a)) return linear(b, 1.0, *value);
  return make(rl::RL_FIELD_ADD, a, b);
}

FieldBuilder::Number FieldBuilder::subtract(Number a, Number b) {
  if (const auto value = valueOf(b)) return linear(a, 1.0, -*value);
  if (const auto value = valueOf(a)) return linear(b, -1.0, *value);
  return make(rl::RL_FIELD_SUBTRACT, a, b);
}

FieldBuilder::Number FieldBuilder::multiply(Number a, Number b) {
  if (const auto value = valueOf(b)) return linear(a, *value, 0.0);
  if (const auto value = valueOf(a)) return linear(b, *value, 0.0);
  if (a.node == b.node) return apply(rl::RL_FIELD_SQUARE, a);
  return make(rl::RL_FIELD_MULTIPLY, a, b);
}

FieldBuilder::Number FieldBuilder::divide(Number a, Number b) {
  if (const auto value = valueOf(b)) {
    if (*value == 0.0) failInput("a division by 0");
    return linear(a, 1.0 / *value, 0.0);
  }
  return multiply(a, make(rl::RL_FIELD_RECIPROCAL, b, {0}));
}

FieldBuilder::Number FieldBuilder::least(Number a, Number b) {
  if (valueOf(a) && valueOf(b)) return constant(std::min(*valueOf(a), *valueOf(b)));
  return binary(rl::RL_FIELD_MIN, a, b);
}

FieldBuilder::Number FieldBuilder::largest(Number a, Number b) {
  if (valueOf(a) && valueOf(b)) return constant(std::max(*valueOf(a), *valueOf(b)));
  return binary(rl::RL_FIELD_MAX, a, b);
}

FieldBuilder::Number FieldBuilder::apply(uint32_t kind, Number a) {
  if (const auto value = valueOf(a)) {
    // Programs take the root of a negative number for 0: of a constant it is an error.
    const bool isDefined = kind != rl::RL_FIELD_SQRT || *value >= 0.0;
    return constant(isDefined ? fieldValue({kind}, *value, 0.0, {}) : std::nan(""));
  }
  const Node& of = nodes_[a.node];
  const auto isSquare = [&](uint32_t n) { return nodes_[n].kind == rl::RL_FIELD_SQUARE; };
  // The root of a sum of squares is a length, whose slope has a bound at 0, too.
  if (kind == rl::RL_FIELD_SQRT && of.kind == rl::RL_FIELD_SQUARE)
    return make(rl::RL_FIELD_ABS, {of.a}, {0});
  if (kind == rl::RL_FIELD_SQRT && of.kind == rl::RL_FIELD_ADD && isSquare(of.b)) {
    const Node& rest = nodes_[of.a];
    const bool isSumOfThree = rest.kind == rl::RL_FIELD_ADD && isSquare(rest.a) && isSquare(rest.b);
    const uint32_t last = nodes_[of.b].a;
    if (isSquare(of.a)) return make(rl::RL_FIELD_LENGTH, {rest.a}, {last});
    if (isSumOfThree) return make(rl::RL_FIELD_LENGTH, apply(kind, {of.a}), {last});
  }
  return make(kind, a, {0});
}

FieldBuilder::Number FieldBuilder::power(Number a, int exponent) {
  if (exponent < 0) return divide(constant(1.0), power(a, -exponent));
  if (exponent == 0) return constant(1.0);
  if (exponent == 1) return a;
  const Number root = power(a, exponent / 2);
  const Number even = multiply(root, root);
  return exponent % 2 == 0 ? even : multiply(even, a);
}

FieldProgram FieldBuilder::program(Number result, std::vector<TextSpan>* spans) const {
  if (valueOf(result)) failInput("it does not depend on the place");
  // Children come first; of two, the one that needs more registers. A node is listed once.
  std::vector<uint32_t> order, stack{result.node};
  std::vector<uint8_t> state(nodes_.size(), 0);  // 1: its children are on the stack, 2: listed
  while (!stack.empty()) {
    const uint32_t at = stack.back();
    const Node& node = nodes_[at];
    if (state[at] != 0 || node.kind == kPlace) {
      stack.pop_back();
      if (state[at] == 1) order.push_back(at);
      state[at] = 2;
      continue;
    }
    state[at] = 1;
    const std::vector<uint32_t> children = operands(node);
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      if (state[*child] == 0) stack.push_back(*child);
  }
  if (order.size() > kMostInstructions)
    failInput(fmt::format("{} operations: at most {}", order.size(), kMostInstructions));
  std::vector<uint32_t> uses(nodes_.size(), 0);
  for (const uint32_t at : order)
    for (const uint32_t operand : operands(nodes_[at])) ++uses[operand];
  std::vector<uint32_t> registerOf(nodes_.size(), 0), free;
  for (uint32_t r = rl::RL_FIELD_REGISTERS; r-- > 3;) free.push_back(r);
  for (uint32_t axis = 0; axis < 3; ++axis) registerOf[axis] = axis;
  FieldProgram program;
  for (const uint32_t at : order) {
    const Node& node = nodes_[at];
    FieldInstruction i{node.kind, 0, 0, 0, node.constants};
    if (hasOne(node.kind)) i.a = registerOf[node.a];
    if (hasTwo(node.kind)) i.b = registerOf[node.b];
    if (hasThree(node.kind)) {
      i.c = registerOf[node.c];
      i.grid = node.grid;
    }
    for (const uint32_t operand : operands(node))
      if (--uses[operand] == 0 && operand > 2) free.push_back(registerOf[operand]);
    if (free.empty())
      failInput(fmt::format("more than {} numbers have to be kept at a time",
                            rl::RL_FIELD_REGISTERS - 3));
    i.to = registerOf[at] = free.back();
    free.pop_back();
    program.instructions.push_back(i);
    if (spans != nullptr) spans->push_back(node.span);
  }
  // A plain coordinate is no instruction.
  if (program.instructions.empty())
    program.instructions.push_back({rl::RL_FIELD_LINEAR, 3, result.node, 0, {1.0f, 0.0f, 0.0f}});
  if (spans != nullptr) spans->resize(program.instructions.size());
  return program;
}

}  // namespace restlab
