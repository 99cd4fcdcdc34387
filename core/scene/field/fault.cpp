#include "core/scene/field/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace restlab {

namespace {

constexpr double kMostValue = 1e15, kMostAngle = 8000.0;
constexpr int kHalvings = 20;

// Bounds of the argument of an instruction.
FieldRange argumentOf(const FieldProgram& program, const glm::dvec3& low, const glm::dvec3& high,
                      size_t instruction) {
  FieldRange argument;
  program.over(low, high, [&](size_t n, FieldRange of) {
    argument = of;
    return n == instruction;
  });
  return argument;
}

// The axis along which an argument changes most.
int axisOf(const FieldProgram& program, const glm::dvec3& low, const glm::dvec3& high,
           size_t instruction) {
  int axis = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 3; ++c) {
    glm::dvec3 from = low, to = high;
    from[c] = to[c] = 0.5 * (low[c] + high[c]);
    const FieldRange rest = argumentOf(program, from, to, instruction);
    if (!(rest.high - rest.low < least)) continue;
    least = rest.high - rest.low;
    axis = c;
  }
  return axis;
}

bool isBadArgument(uint32_t kind, const FieldRange& of) {
  const double size = std::max(-of.low, of.high);
  if (!(size <= kMostValue)) return true;
  switch (kind) {
    case rl::RL_FIELD_RECIPROCAL:
      return of.low <= 1.0 / kMostValue && of.high >= -1.0 / kMostValue;
    case rl::RL_FIELD_SQRT:
      return of.high < 0.0;
    case rl::RL_FIELD_EXP:
      return of.high > std::log(kMostValue);
    case rl::RL_FIELD_SIN:
    case rl::RL_FIELD_COS:
    case rl::RL_FIELD_FOLD:
      return size > kMostAngle;
    default:
      return false;
  }
}

// Asks whether all of the program has a value in a part of its box, by halves where bounds do not
// tell. bad: the instruction that has none. left: parts that may still be asked.
bool hasValues(const FieldProgram& program, const glm::dvec3& low, const glm::dvec3& high,
               int halvings, size_t& bad, int& left) {
  bool isSure = true;
  program.over(low, high, [&](size_t n, FieldRange of) {
    if (!isBadArgument(program.instructions[n].kind, of)) return false;
    bad = n;
    isSure = false;
    return true;
  });
  if (isSure) return true;
  if (halvings == 0 || --left < 0) return false;
  const int axis = axisOf(program, low, high, bad);
  glm::dvec3 middleHigh = high, middleLow = low;
  middleHigh[axis] = middleLow[axis] = 0.5 * (low[axis] + high[axis]);
  return hasValues(program, low, middleHigh, halvings - 1, bad, left) &&
         hasValues(program, middleLow, high, halvings - 1, bad, left);
}

std::string whyBad(uint32_t kind) {
  if (kind == rl::RL_FIELD_RECIPROCAL) return "divides by 0 or by nearly 0";
  if (kind == rl::RL_FIELD_SQRT) return "is the root of a number below 0";
  if (kind == rl::RL_FIELD_SIN || kind == rl::RL_FIELD_COS)
    return fmt::format("is of an angle above {:g} radians", kMostAngle);
  return fmt::format("is not below {:g}", kMostValue);
}

}  // namespace

std::optional<FieldFault> findFault(const FieldProgram& program) {
  // The result of the last instruction is the argument of one more.
  FieldProgram asked = program;
  asked.instructions.push_back({rl::RL_FIELD_LINEAR, 3, asked.instructions.back().to, 0, {}});
  size_t bad = 0;
  int left = 10'000;
  const glm::dvec3 low(program.low), high(program.high);
  if (hasValues(asked, low, high, kHalvings, bad, left)) return std::nullopt;
  return FieldFault{std::min(bad, program.instructions.size() - 1),
                    whyBad(asked.instructions[bad].kind)};
}

}  // namespace restlab
