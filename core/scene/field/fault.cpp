#include "core/scene/field/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace restlab {

namespace {

constexpr double kMostValue = 1e15, kMostAngle = 8000.0;

// Asks whether all of the program has a value in a part of its box, by halves where bounds do not
// tell. bad: the instruction that has none. left: parts that may still be asked.
bool hasValues(const FieldProgram& program, const glm::dvec3& low, const glm::dvec3& high,
               int depth, size_t& bad, int& left) {
  bool isSure = true;
  program.over(low, high, [&](size_t n, FieldRange of) {
    const uint32_t kind = program.instructions[n].kind;
    const double size = std::max(-of.low, of.high);
    const bool isBad =
        !(size <= kMostValue) ||
        (kind == rl::RL_FIELD_RECIPROCAL && of.low <= 1.0 / kMostValue &&
         of.high >= -1.0 / kMostValue) ||
        (kind == rl::RL_FIELD_SQRT && of.high < 0.0) ||
        (kind == rl::RL_FIELD_EXP && of.high > std::log(kMostValue)) ||
        ((kind == rl::RL_FIELD_SIN || kind == rl::RL_FIELD_COS || kind == rl::RL_FIELD_FOLD) &&
         size > kMostAngle);
    if (isBad) {
      bad = n;
      isSure = false;
    }
    return isBad;
  });
  if (isSure) return true;
  if (depth == 0 || --left < 0) return false;
  const glm::dvec3 size = high - low;
  const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
  glm::dvec3 middleHigh = high, middleLow = low;
  middleHigh[axis] = middleLow[axis] = 0.5 * (low[axis] + high[axis]);
  return hasValues(program, low, middleHigh, depth - 1, bad, left) &&
         hasValues(program, middleLow, high, depth - 1, bad, left);
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
  int left = 100'000;
  const glm::dvec3 low(program.low), high(program.high);
  if (hasValues(asked, low, high, 18, bad, left)) return std::nullopt;
  return FieldFault{std::min(bad, program.instructions.size() - 1),
                    whyBad(asked.instructions[bad].kind)};
}

}  // namespace restlab
