#include "core/scene/field/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/error.h"
#include "core/scene/field/fault.h"
#include "core/scene/field/reader.h"

namespace restlab {

namespace {

using Number = FieldBuilder::Number;

constexpr int kMostPower = 32;

const std::vector<std::pair<std::string, uint32_t>>& functionsOfOne() {
  static const std::vector<std::pair<std::string, uint32_t>> kAll{{"sin", rl::RL_FIELD_SIN},
                                                                  {"cos", rl::RL_FIELD_COS},
                                                                  {"exp", rl::RL_FIELD_EXP},
                                                                  {"sqrt", rl::RL_FIELD_SQRT},
                                                                  {"abs", rl::RL_FIELD_ABS}};
  return kAll;
}

// Descends by precedence: sums, products, signs, powers, atoms.
class Expression {
 public:
  explicit Expression(const std::string& text) : reader_(text) {}

  Number read() {
    if (reader_.isAtEnd()) reader_.fail(0, "nothing is there: for a ball, x^2 + y^2 + z^2 - 1");
    const Number all = sum();
    if (!reader_.isAtEnd())
      reader_.fail(reader_.place(), "not expected here: + - * / ^ or the end");
    return all;
  }
  FieldBuilder& builder() { return builder_; }

 private:
  // Errors of constants, as 1/0, name the place.
  template <class Step>
  Number made(size_t begin, const Step& step) {
    builder_.from(reader_.since(begin));
    try {
      return step();
    } catch (const Error& error) {
      reader_.fail(begin, error.what());
    }
  }

  Number sum() {
    const FieldReader::Level level(reader_);
    const size_t begin = reader_.place();
    Number all = product();
    for (;;) {
      const bool adds = reader_.take('+');
      if (!adds && !reader_.take('-')) return all;
      const Number next = product();
      all = made(begin,
                 [&] { return adds ? builder_.add(all, next) : builder_.subtract(all, next); });
    }
  }

  Number product() {
    const size_t begin = reader_.place();
    Number all = sign();
    for (;;) {
      const bool multiplies = reader_.take('*');
      if (!multiplies && !reader_.take('/')) return all;
      const Number next = sign();
      all = made(begin, [&] {
        return multiplies ? builder_.multiply(all, next) : builder_.divide(all, next);
      });
    }
  }

  Number sign() {
    const FieldReader::Level level(reader_);
    const size_t begin = reader_.place();
    if (reader_.take('+')) return sign();
    if (!reader_.take('-')) return power();
    const Number of = sign();
    return made(begin, [&] { return builder_.linear(of, -1.0, 0.0); });
  }

  Number power() {
    const size_t begin = reader_.place();
    const Number base = atom();
    if (!reader_.take('^')) return base;
    const size_t at = reader_.place();
    const auto exponent = builder_.valueOf(sign());
    if (!exponent || *exponent != std::round(*exponent) || std::abs(*exponent) > kMostPower)
      reader_.fail(at, fmt::format("a power is a whole number from {} to {}; sqrt() takes roots",
                                   -kMostPower, kMostPower));
    return made(begin, [&] { return builder_.power(base, int(*exponent)); });
  }

  Number atom() {
    const size_t begin = reader_.place();
    if (reader_.take('(')) {
      const Number inner = sum();
      reader_.expect(')');
      return inner;
    }
    if (reader_.isAtNumber()) {
      const double value = reader_.number();
      return made(begin, [&] { return builder_.constant(value); });
    }
    if (!reader_.isAtName()) reader_.fail(begin, "a number, x, y, z, a function or '(' is missing");
    const std::string name = reader_.name();
    if (name == "x" || name == "y" || name == "z")
      return builder_.coordinate(static_cast<uint32_t>(name[0] - 'x'));
    if (name == "pi") return builder_.constant(std::numbers::pi);
    return function(name, begin);
  }

  Number function(const std::string& name, size_t begin) {
    std::vector<std::string> names{"x", "y", "z", "pi", "min", "max"};
    for (const auto& [known, kind] : functionsOfOne()) {
      names.push_back(known);
      if (name != known) continue;
      reader_.expect('(');
      const Number of = sum();
      reader_.expect(')');
      return made(begin, [&, k = kind] { return builder_.apply(k, of); });
    }
    if (name != "min" && name != "max")
      reader_.fail(begin, fmt::format("'{}' is not known: {}{}", name, fmt::join(names, ", "),
                                      didYouMean(name, names)));
    reader_.expect('(');
    Number all = sum();
    do {
      reader_.expect(',');
      const Number next = sum();
      all = made(begin, [&] {
        return name == "min" ? builder_.least(all, next) : builder_.largest(all, next);
      });
    } while (reader_.next() == ',');
    reader_.expect(')');
    return all;
  }

  FieldReader reader_;
  FieldBuilder builder_;
};

}  // namespace

FieldProgram readExpression(const std::string& text, const glm::vec3& low, const glm::vec3& high) {
  Expression expression(text);
  const Number all = expression.read();
  std::vector<TextSpan> spans;
  FieldProgram program = expression.builder().program(all, &spans);
  program.low = low;
  program.high = high;
  if (const auto fault = findFault(program)) {
    const TextSpan span = spans.at(fault->instruction);
    failInput(fmt::format("column {}: '{}' {} somewhere in the box", span.begin + 1,
                          spanText(text, span), fault->why));
  }
  program.isClosed = isFieldClosed(program);
  return program;
}

}  // namespace restlab
