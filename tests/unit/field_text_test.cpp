// Texts of fields: what they compute, what is refused, and that errors name the place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/error.h"
#include "core/scene/field/expression.h"
#include "core/scene/field/solid.h"
#include "core/scene/field/stand_in.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

FieldProgram fieldOf(const std::string& text, float reach = 1.0f) {
  return readExpression(text, glm::vec3(-reach), glm::vec3(reach));
}

std::string fieldError(const std::function<void()>& make) {
  try {
    make();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    return error.what();
  }
  return "";
}
std::string expressionError(const std::string& text) {
  return fieldError([&] { fieldOf(text); });
}
std::string solidError(const std::string& text) {
  return fieldError([&] { readSolid(text); });
}

TEST(Expressions, MeanWhatTheySay) {
  const auto expectAt = [](const std::string& text, double (*of)(double, double, double)) {
    const FieldProgram field = fieldOf(text);
    Inputs inputs(1);
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 p(inputs.uniform(-1.0f, 1.0f), inputs.uniform(-1.0f, 1.0f),
                         inputs.uniform(-1.0f, 1.0f));
      const double expected = of(p.x, p.y, p.z);
      ASSERT_NEAR(field.at(p), expected, 1e-6 * (1.0 + std::abs(expected))) << text;
    }
  };
  expectAt("x^2 + y^2 + z^2 - 1",
           [](double x, double y, double z) { return x * x + y * y + z * z - 1.0; });
  expectAt("-x^2", [](double x, double, double) { return -x * x; });
  expectAt("2^3^2*x - 3", [](double x, double, double) { return 512.0 * x - 3.0; });
  expectAt("x - y - z", [](double x, double y, double z) { return x - y - z; });
  expectAt("x/2/4 + (y)", [](double x, double y, double) { return x / 8.0 + y; });
  expectAt("1 - -x", [](double x, double, double) { return 1.0 + x; });
  expectAt("1/(x^2 + 1) - y^-2*0 + x^5",
           [](double x, double, double) { return 1.0 / (x * x + 1.0) + std::pow(x, 5.0); });
  expectAt("sin(pi*x)*cos(y) - exp(z)", [](double x, double y, double z) {
    return std::sin(M_PI * x) * std::cos(y) - std::exp(z);
  });
  expectAt("sqrt(x^2 + y^2 + z^2)",
           [](double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); });
  expectAt("min(x, y, 0.2) + max(z, -0.5) + abs(x)", [](double x, double y, double z) {
    return std::min({x, y, double(0.2f)}) + std::max(z, -0.5) + std::abs(x);
  });
}

// A number that is needed twice is computed once, and a product of constants never.
TEST(Expressions, ComputeNothingTwice) {
  EXPECT_EQ(fieldOf("(x + y)^2 * sin((x + y)^2) + 2*3").instructions.size(), 5u);
  EXPECT_EQ(fieldOf("sqrt(x^2 + y^2 + z^2) - 1").instructions.size(), 3u);
}

TEST(Expressions, ErrorsNameThePlace) {
  EXPECT_EQ(expressionError("x + foo(y)"),
            "column 5, 'foo(y)': 'foo' is not known: x, y, z, pi, min, max, sin, cos, exp, sqrt, "
            "abs");
  EXPECT_EQ(expressionError("x + sim(y)").substr(0, 13), "column 5, 'si");
  EXPECT_EQ(expressionError("x + (y * 2"), "column 11, the end: ')' is missing");
  EXPECT_EQ(expressionError("x^0.5 - 1"),
            "column 3, '0.5 - 1': a power is a whole number from -32 to 32; sqrt() takes roots");
  EXPECT_EQ(expressionError("x^y").substr(0, 8), "column 3");
  EXPECT_EQ(expressionError("x y"), "column 3, 'y': not expected here: + - * / ^ or the end");
  EXPECT_EQ(expressionError(""),
            "column 1, the end: nothing is there: for a ball, x^2 + y^2 + z^2 - 1");
  EXPECT_EQ(expressionError("3 - pi"), "it does not depend on the place");
  EXPECT_EQ(expressionError("x + 1/0"), "column 5, '1/0': a division by 0");
  EXPECT_EQ(expressionError("x + 1e99"), "column 5, '1e99': not a number of at most 1e15");
  EXPECT_EQ(expressionError("x + min(y)"), "column 10, ')': ',' is missing");
  EXPECT_NE(expressionError(std::string(80, '(') + "x" + std::string(80, ')')).find("64 levels"),
            std::string::npos);
  std::string longer = "x";
  for (int i = 0; i < 300; ++i) longer += " + sin(x*" + std::to_string(i + 2) + ")";
  EXPECT_NE(expressionError(longer).find("at most 256"), std::string::npos);
}

TEST(Expressions, WithoutBoundsAreRefused) {
  EXPECT_EQ(expressionError("y - 1/x"),
            "column 5: '1/x' divides by 0 or by nearly 0 somewhere in the box");
  EXPECT_EQ(expressionError("x - y/(z - 0.5)").substr(0, 9), "column 5:");
  EXPECT_EQ(expressionError("sqrt(-1 - x^2) + x").substr(0, 9), "column 1:");
  EXPECT_NE(expressionError("exp(50*x) - 1"), "");
  EXPECT_NE(expressionError("sin(10000*x)"), "");
  // The bounds of a division are looked at closely before it is refused.
  EXPECT_EQ(expressionError("1/(x^2 - x + 0.26) - 1"), "");
  EXPECT_EQ(expressionError("sqrt(1 - x^2) - z"), "");
}

TEST(Expressions, AreClosedWhereTheBoxCutsNothingOff) {
  EXPECT_TRUE(fieldOf("x^2 + y^2 + z^2 - 0.99").isClosed);
  EXPECT_FALSE(fieldOf("x^2 + y^2 + z^2 - 1.01").isClosed);
  EXPECT_FALSE(fieldOf("z").isClosed);
  EXPECT_FALSE(fieldOf("0.5 - x^2 - y^2 - z^2").isClosed);
}

TEST(Solids, ErrorsNameThePlace) {
  EXPECT_EQ(solidError("sphere(1) 2"), "column 11, '2': not expected behind the last solid");
  EXPECT_EQ(solidError("union(sphere(1))"), "column 16, ')': ',' is missing");
  EXPECT_EQ(solidError("sphere()"),
            "column 8, ')': the number 'radius' of sphere(radius) is missing");
  EXPECT_EQ(solidError("sphere(-1)"),
            "column 8, '-1)': 'radius' of sphere(radius) is -1: from 1e-06 to 1e+06");
  EXPECT_EQ(solidError("translate(1, 2, sphere(1))").substr(0, 10), "column 17,");
  EXPECT_EQ(solidError("union(sphere(1), bx(1, 1, 1))").substr(0, 20), "column 18, 'bx(1, 1,");
  EXPECT_EQ(solidError("rotate(0, 0, 0, 30, sphere(1))"),
            "column 1, 'rotate(0, 0, 0, 30, s...': the direction is 0");
  EXPECT_EQ(solidError("plane(0, 0, 1, 0)"), "the solid has no end: give a 'box' that cuts it off");
  EXPECT_EQ(solidError("difference(plane(0, 0, 1, 0), sphere(1))"),
            "the solid has no end: give a 'box' that cuts it off");
  EXPECT_EQ(solidError("intersection(plane(0, 0, 1, 0), sphere(1))"), "");
}

// Distances of solids, against the same by hand.
TEST(Solids, HaveTheirDistances) {
  const auto distance = [](const std::string& text, const glm::dvec3& p) {
    return readSolid(text, std::array{glm::vec3(-5.0f), glm::vec3(5.0f)}).at(p);
  };
  const glm::dvec3 p(0.7, -0.4, 1.3);
  EXPECT_NEAR(distance("sphere(1)", p), glm::length(p) - 1.0, 1e-6);
  EXPECT_NEAR(distance("box(0.5, 0.5, 0.5)", p), std::hypot(0.2, 0.8), 1e-6);
  EXPECT_NEAR(distance("box(1, 0.5, 2)", p), -0.1, 1e-6);
  EXPECT_NEAR(distance("torus(1, 0.2)", p), std::hypot(std::hypot(0.7, 0.4) - 1.0, 1.3) - 0.2,
              1e-6);
  EXPECT_NEAR(distance("capsule(2, 0.3)", p), std::sqrt(0.49 + 0.16 + 0.09) - 0.3, 1e-6);
  EXPECT_NEAR(distance("cylinder(2, 0.5)", p), std::hypot(std::hypot(0.7, 0.4) - 0.5, 0.3), 1e-6);
  EXPECT_NEAR(distance("plane(0, 0, 2, 0.3)", p), 1.0, 1e-6);
  EXPECT_NEAR(distance("translate(0.7, -0.4, 1, sphere(0.1))", p), 0.2, 1e-6);
  EXPECT_NEAR(distance("scale(3, box(0.5, 5, 5))", p), 0.7 - 1.5, 1e-6);
  EXPECT_NEAR(distance("rotate(0, 0, 1, 90, box(0.1, 9, 9))", p), 0.3, 1e-6);
  EXPECT_NEAR(distance("rotate(0, 0, 1, 30, plane(1, 0, 0, 0))", p),
              0.7 * std::cos(M_PI / 6.0) - 0.4 * 0.5, 1e-6);
  EXPECT_NEAR(distance("shell(0.2, sphere(1))", p), std::abs(glm::length(p) - 1.0) - 0.1, 1e-6);
  EXPECT_NEAR(distance("round(0.2, sphere(1))", p), glm::length(p) - 1.2, 1e-6);
  EXPECT_NEAR(distance("repeat(0, 0, 1, sphere(0.2))", p), std::sqrt(0.49 + 0.16 + 0.09) - 0.2,
              1e-6);
  EXPECT_NEAR(distance("twist(90, plane(1, 0, 0, 0))", {0.7, -0.4, 1.0}), -0.4, 1e-6);
  EXPECT_NEAR(distance("union(sphere(1), plane(0, 0, 1, 1.2))", p), 0.1, 1e-6);
  EXPECT_NEAR(distance("difference(sphere(2), plane(0, 0, 1, 1.2))", p),
              std::max(glm::length(p) - 2.0, -0.1), 1e-6);
  EXPECT_NEAR(distance("intersection(sphere(2), plane(0, 0, 1, 1.2))", p), 0.1, 1e-6);
  const double a = glm::length(p) - 1.0, b = 0.3, h = std::max(0.5 - std::abs(a - b), 0.0);
  EXPECT_NEAR(distance("smooth_union(0.5, sphere(1), plane(0, 0, 1, 1))", p),
              std::min(a, b) - h * h / 2.0, 1e-6);
  EXPECT_NEAR(distance("displace(0.1, 2, sphere(1))", p),
              a + 0.1 * std::sin(1.4) * std::sin(-0.8) * std::sin(2.6), 1e-6);
}

// Boxes that follow from the parts hold all of the surface, which a mesh of a larger box shows.
TEST(Solids, FitIntoTheirBoxes) {
  for (const char* text :
       {"twist(80, translate(0.4, 0, 0, box(0.2, 0.3, 1)))",
        "smooth_union(0.5, sphere(0.5), translate(0.8, 0, 0, sphere(0.4)), capsule(2, 0.2))",
        "displace(0.1, 12, torus(1, 0.3))", "rotate(1, 2, 3, 50, scale(2, cylinder(1, 0.3)))",
        "translate(3, 0, 0, shell(0.1, sphere(1)))"}) {
    const FieldProgram own = readSolid(text);
    EXPECT_TRUE(own.isClosed) << text;
    const FieldProgram wide = readSolid(text, std::array{glm::vec3(-6.0f), glm::vec3(6.0f)});
    for (const glm::vec3& p : fieldStandIn(wide).positions) {
      EXPECT_TRUE(glm::all(glm::greaterThan(p, own.low)) && glm::all(glm::lessThan(p, own.high)))
          << text;
    }
  }
}

TEST(FieldWords, AreReadBack) {
  const FieldProgram field = readSolid("smooth_union(0.3, sphere(1), box(0.4, 0.5, 1.4))");
  const FieldProgram back = fieldProgram(fieldWords(field));
  EXPECT_EQ(back.isClosed, field.isClosed);
  EXPECT_EQ(back.low, field.low);
  EXPECT_EQ(back.high, field.high);
  Inputs inputs(2);
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 p(inputs.direction());
    EXPECT_EQ(back.at(p), field.at(p));
  }
}

}  // namespace
}  // namespace restlab::unit
