#include "core/scene/field/program.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace restlab {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

double fromEven(double x) { return x - 2.0 * std::floor(x * 0.5 + 0.5); }

FieldRange ordered(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

FieldRange product(const FieldRange& a, const FieldRange& b) {
  const std::array<double, 4> all{a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  return {*std::min_element(all.begin(), all.end()), *std::max_element(all.begin(), all.end())};
}

FieldRange squared(const FieldRange& a) {
  const FieldRange v = ordered(a.low * a.low, a.high * a.high);
  return {a.low <= 0.0 && a.high >= 0.0 ? 0.0 : v.low, v.high};
}

bool holds(const FieldRange& a, double period, double offset) {
  return std::floor((a.high - offset) / period) >= std::ceil((a.low - offset) / period);
}

FieldRange wave(const FieldRange& a, double (*of)(double), double top) {
  FieldRange v = ordered(of(a.low), of(a.high));
  if (holds(a, 2.0 * kPi, top)) v.high = 1.0;
  if (holds(a, 2.0 * kPi, top + kPi)) v.low = -1.0;
  return v;
}

FieldRange bounded(const FieldInstruction& i, const FieldRange& a, const FieldRange& b,
                   const std::array<FieldRange, 3>& p) {
  const double k = i.constants[0], m = i.constants[1], n = i.constants[2];
  const auto times = [](double f, const FieldRange& r) { return ordered(f * r.low, f * r.high); };
  switch (i.kind) {
    case rl::RL_FIELD_LINEAR: {
      const FieldRange v = times(k, a);
      return {v.low + m, v.high + m};
    }
    case rl::RL_FIELD_PLANE: {
      const FieldRange x = times(k, p[0]), y = times(m, p[1]), z = times(n, p[2]);
      return {x.low + y.low + z.low, x.high + y.high + z.high};
    }
    case rl::RL_FIELD_ADD:
      return {a.low + b.low, a.high + b.high};
    case rl::RL_FIELD_SUBTRACT:
      return {a.low - b.high, a.high - b.low};
    case rl::RL_FIELD_MULTIPLY:
      return product(a, b);
    case rl::RL_FIELD_RECIPROCAL:
      if (a.low <= 0.0 && a.high >= 0.0) return {-kInfinity, kInfinity};
      return ordered(1.0 / a.low, 1.0 / a.high);
    case rl::RL_FIELD_MIN:
      return {std::min(a.low, b.low), std::min(a.high, b.high)};
    case rl::RL_FIELD_MAX:
      return {std::max(a.low, b.low), std::max(a.high, b.high)};
    case rl::RL_FIELD_SQUARE:
      return squared(a);
    case rl::RL_FIELD_LENGTH: {
      const FieldRange x = squared(a), y = squared(b);
      return {std::sqrt(x.low + y.low), std::sqrt(x.high + y.high)};
    }
    case rl::RL_FIELD_SQRT:
      return {std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0))};
    case rl::RL_FIELD_ABS:
      if (a.low >= 0.0) return a;
      if (a.high <= 0.0) return {-a.high, -a.low};
      return {0.0, std::max(-a.low, a.high)};
    case rl::RL_FIELD_SIN:
      return wave(a, std::sin, 0.5 * kPi);
    case rl::RL_FIELD_COS:
      return wave(a, std::cos, 0.0);
    case rl::RL_FIELD_EXP:
      return {std::exp(a.low), std::exp(a.high)};
    default: {
      FieldRange v = ordered(std::abs(fromEven(a.low)), std::abs(fromEven(a.high)));
      if (holds(a, 2.0, 0.0)) v.low = 0.0;
      if (holds(a, 2.0, 1.0)) v.high = 1.0;
      return v;
    }
  }
}

// Whether the field is above 0 on a rectangle, which is halved where its bounds do not tell.
bool isAbove(const FieldProgram& program, const glm::dvec3& low, const glm::dvec3& high,
             int depth) {
  if (program.over(low, high).low > 0.0) return true;
  if (depth == 0) return false;
  const glm::dvec3 size = high - low;
  const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
  glm::dvec3 middleHigh = high, middleLow = low;
  middleHigh[axis] = middleLow[axis] = 0.5 * (low[axis] + high[axis]);
  return isAbove(program, low, middleHigh, depth - 1) &&
         isAbove(program, middleLow, high, depth - 1);
}

}  // namespace

double fieldValue(const FieldInstruction& i, double a, double b, const glm::dvec3& p) {
  const double k = i.constants[0], m = i.constants[1], n = i.constants[2];
  switch (i.kind) {
    case rl::RL_FIELD_LINEAR:
      return k * a + m;
    case rl::RL_FIELD_PLANE:
      return k * p.x + m * p.y + n * p.z;
    case rl::RL_FIELD_ADD:
      return a + b;
    case rl::RL_FIELD_SUBTRACT:
      return a - b;
    case rl::RL_FIELD_MULTIPLY:
      return a * b;
    case rl::RL_FIELD_RECIPROCAL:
      return 1.0 / a;
    case rl::RL_FIELD_MIN:
      return std::min(a, b);
    case rl::RL_FIELD_MAX:
      return std::max(a, b);
    case rl::RL_FIELD_SQUARE:
      return a * a;
    case rl::RL_FIELD_SQRT:
      return std::sqrt(std::max(a, 0.0));
    case rl::RL_FIELD_LENGTH:
      return std::sqrt(a * a + b * b);
    case rl::RL_FIELD_ABS:
      return std::abs(a);
    case rl::RL_FIELD_SIN:
      return std::sin(a);
    case rl::RL_FIELD_COS:
      return std::cos(a);
    case rl::RL_FIELD_EXP:
      return std::exp(a);
    default:
      return std::abs(fromEven(a));
  }
}

double FieldProgram::at(const glm::dvec3& p) const {
  std::array<double, rl::RL_FIELD_REGISTERS> regs{p.x, p.y, p.z};
  double v = p.x;
  for (const FieldInstruction& i : instructions) {
    v = i.kind == rl::RL_FIELD_GRID ? grids[i.grid].at({regs[i.a], regs[i.b], regs[i.c]})
                                    : fieldValue(i, regs[i.a], regs[i.b], p);
    regs[i.to] = v;
  }
  return v;
}

glm::dvec3 FieldProgram::gradientAt(const glm::dvec3& p) const {
  const glm::dvec3 size(high - low);
  const double step = 1e-6 * std::max({size.x, size.y, size.z});
  glm::dvec3 slope;
  for (int c = 0; c < 3; ++c) {
    glm::dvec3 d(0.0);
    d[c] = step;
    slope[c] = (at(p + d) - at(p - d)) / (2.0 * step);
  }
  return slope;
}

FieldRange FieldProgram::over(const glm::dvec3& from, const glm::dvec3& to,
                              const Check& refuses) const {
  const std::array<FieldRange, 3> place{FieldRange{from.x, to.x}, {from.y, to.y}, {from.z, to.z}};
  std::array<FieldRange, rl::RL_FIELD_REGISTERS> regs{place[0], place[1], place[2]};
  FieldRange v = place[0];
  for (size_t n = 0; n < instructions.size(); ++n) {
    const FieldInstruction& i = instructions[n];
    const FieldRange a = regs[i.a], b = regs[i.b];
    if (refuses && refuses(n, a)) return {-kInfinity, kInfinity};
    const FieldRange c = regs[i.c];
    v = i.kind == rl::RL_FIELD_GRID
            ? grids[i.grid].over({a.low, b.low, c.low}, {a.high, b.high, c.high})
            : bounded(i, a, b, place);
    regs[i.to] = v;
  }
  return v;
}

std::vector<uint32_t> fieldWords(const FieldProgram& program) {
  const auto bits = [](float v) { return std::bit_cast<uint32_t>(v); };
  const glm::vec3 low = program.low, high = program.high;
  std::vector<uint32_t> words{
      bits(low.x),  bits(low.y),  bits(low.z),  static_cast<uint32_t>(program.instructions.size()),
      bits(high.x), bits(high.y), bits(high.z), program.isClosed ? 1u : 0u};
  // Grids stand behind the instructions, which say where.
  std::vector<uint32_t> places;
  size_t place = program.instructions.size();
  for (const FieldGrid& grid : program.grids) {
    places.push_back(static_cast<uint32_t>(place));
    place += grid.size() / 4;
  }
  for (const FieldInstruction& i : program.instructions) {
    words.push_back(i.kind | i.to << 8 | i.a << 16 | i.b << 24);
    if (i.kind == rl::RL_FIELD_GRID) {
      words.insert(words.end(), {i.c, places[i.grid], 0u});
    } else {
      for (const float constant : i.constants) words.push_back(bits(constant));
    }
  }
  words.reserve(4 * (rl::RL_FIELD_HEADER + place));
  for (const FieldGrid& grid : program.grids)
    words.insert(words.end(), grid.words(), grid.words() + grid.size());
  return words;
}

FieldProgram fieldProgram(const std::vector<uint32_t>& words) {
  const auto number = [&](size_t i) { return std::bit_cast<float>(words.at(i)); };
  FieldProgram program;
  program.low = {number(0), number(1), number(2)};
  program.high = {number(4), number(5), number(6)};
  program.isClosed = words.at(7) != 0;
  for (size_t i = 0; i < words.at(3); ++i) {
    const size_t at = 4 * (rl::RL_FIELD_HEADER + i);
    const uint32_t head = words.at(at);
    FieldInstruction made{head & 255u, head >> 8 & 255u, head >> 16 & 255u, head >> 24, {}};
    if (made.kind == rl::RL_FIELD_GRID) {
      const uint32_t* grid = words.data() + 4 * (rl::RL_FIELD_HEADER + words.at(at + 2));
      made.c = words.at(at + 1);
      made.grid = static_cast<uint32_t>(
          std::find_if(program.grids.begin(), program.grids.end(),
                       [&](const FieldGrid& known) { return known.words() == grid; }) -
          program.grids.begin());
      if (made.grid == program.grids.size()) program.grids.emplace_back(grid);
    } else {
      made.constants = {number(at + 1), number(at + 2), number(at + 3)};
    }
    program.instructions.push_back(made);
  }
  return program;
}

bool isFieldClosed(const FieldProgram& program) {
  constexpr int kTimes = 14;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool isHigh : {false, true}) {
      glm::dvec3 low(program.low), high(program.high);
      (isHigh ? low : high)[axis] = isHigh ? high[axis] : low[axis];
      if (!isAbove(program, low, high, kTimes)) return false;
    }
  }
  return true;
}

}  // namespace restlab
