// Strands of scene files and of Mitsuba's scenes: what is read, and what is refused with which
// line.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/curves/curve_words.h"
#include "core/scene/scene.h"
#include "core/scene/shapes/shape_info.h"
#include "tests/scene/mitsuba_builder.h"

namespace restlab {
namespace {

class CurveFiles : public ::testing::Test {
 protected:
  Scene load(const std::string& keys) {
    folder_.write("x.scene.toml", "[[shape]]\nkind = \"curves\"\n" + keys);
    return loadScene((folder_.path() / "x.scene.toml").string());
  }
  std::string errorOf(const std::string& keys) {
    try {
      load(keys);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      std::string line = error.what();
      const std::string folder = folder_.path().string() + "/";
      for (size_t at; (at = line.find(folder)) != std::string::npos;) line.erase(at, folder.size());
      return line;
    }
    return "no error";
  }
  std::string errorOfText(const std::string& text, const std::string& basis = "linear") {
    folder_.write("hair.txt", text);
    return errorOf("file = \"hair.txt\"\nbasis = \"" + basis + "\"\n");
  }
  static std::vector<StrandPiece> piecesOf(const Scene& scene) {
    const std::vector<uint32_t>& words = scene.geometries.at(0).shape->words;
    std::vector<StrandPiece> pieces;
    for (size_t i = 0; i < curvePieces(words); ++i) pieces.push_back(curvePiece(words, i));
    return pieces;
  }
  test::MitsubaFolder folder_;
};

TEST_F(CurveFiles, PointsAreThoseOfTheFile) {
  const Scene inside = load(
      "basis = \"linear\"\nstrands = [2, 3]\n"
      "points = [[0, 0, 0, 0.1], [1, 0, 0, 0.2], [0, 1, 0, 0.1], [1, 1, 0, 0.1], [2, 1, 0, "
      "0.3]]\n");
  EXPECT_EQ(piecesOf(inside).size(), 3u);
  folder_.write("hair.txt", "\n0 0 0 .1\n1 0 0 2e-1\r\n \t\n\n 0 1 0 0.1\n1 1 0 0.1\n2 1 0 0.3");
  const std::string keys = "basis = \"linear\"\nfile = \"hair.txt\"\n";
  const Scene scene = load(keys);
  EXPECT_EQ(scene.geometries.at(0).shape->words, inside.geometries.at(0).shape->words);
  folder_.write("hair.txt", "0 0 0 .1\n1 0 0 .2\n");
  EXPECT_NE(load(keys).contentHash, scene.contentHash);
  const ShapeGeometry& shape = *scene.geometries.at(0).shape;
  EXPECT_TRUE(shape.info->isInside(shape, {0.5, 0.1, 0.0}));
  EXPECT_TRUE(shape.info->isInside(shape, {-0.09, 0.0, 0.0})) << "ends are round";
  EXPECT_FALSE(shape.info->isInside(shape, {0.5, 0.5, 0.0}));
}

TEST_F(CurveFiles, EachBasisHasItsEnds) {
  const std::string points =
      "points = [[0, 0, 0, 0.1], [1, 0, 0, 0.1], [2, 1, 0, 0.1], [3, 0, 0, 0.1]]\n";
  const auto endsOf = [&](const std::string& keys) {
    float low = 9.0f, high = -9.0f;
    for (const StrandPiece& piece : piecesOf(load(points + keys))) {
      low = std::min(low, piece.start.x);
      high = std::max(high, piece.end.x);
    }
    return glm::vec2(low, high);
  };
  EXPECT_EQ(endsOf("basis = \"linear\"\n"), glm::vec2(0.0f, 3.0f));
  EXPECT_EQ(endsOf("basis = \"bezier\"\n"), glm::vec2(0.0f, 3.0f));
  EXPECT_EQ(endsOf(""), glm::vec2(1.0f, 2.0f)) << "a B-spline";
  EXPECT_EQ(endsOf("basis = \"catmull-rom\"\n"), glm::vec2(1.0f, 2.0f));
  EXPECT_GT(piecesOf(load(points + "error = 0.001\n")).size(), 2 * piecesOf(load(points)).size());
}

TEST_F(CurveFiles, ErrorsSayWhatIsWrong) {
  EXPECT_EQ(errorOf(""),
            "x.scene.toml:1:1: [[shape]] of kind 'curves' has no 'points', as [[x, y, z, radius], "
            "...], and no 'file' of such lines");
  EXPECT_EQ(errorOf("points = [[0, 0, 0, 1], [1, 0, 0, 0]]\n"),
            "x.scene.toml:3:10: point 1 of 'points': radius 0 is out of range; 1e-15 to "
            "1e+09 expected");
  EXPECT_EQ(errorOf("points = [[0, 0, 0, 1], [1, 0, 0, 1]]\n"),
            "x.scene.toml:3:10: a strand of 2 points: at least 4 expected of basis 'bspline'");
  const std::string two = "basis = \"linear\"\npoints = [[0, 0, 0, 1], [1, 0, 0, 1]]\n";
  EXPECT_EQ(errorOf(two + "strands = [3]\n"),
            "x.scene.toml:5:11: 'strands' has the number of points of each strand: their sum is 3, "
            "and there are 2 points");
  EXPECT_EQ(errorOf(two + "strands = [1, 1]\n"),
            "x.scene.toml:5:11: a strand of 1 points: at least 2 expected");
  EXPECT_EQ(errorOf(two + "error = 0\n").substr(0, 17), "x.scene.toml:5:9:");
  EXPECT_EQ(errorOf("basis = \"beziers\"\n").substr(0, 17), "x.scene.toml:3:9:");
  EXPECT_EQ(errorOf("points = [[nan, 0, 0, 1]]\n").substr(0, 18), "x.scene.toml:3:12:");
  EXPECT_NE(errorOf("basis = \"linear\"\npoints = [[1e5, 0, 0, 1], [1e5, 1, 0, 1]]\n")
                .find("x.scene.toml:4:10: strand 0 is too thin for single precision"),
            std::string::npos);
  EXPECT_NE(errorOf("basis = \"linear\"\npoints = [[0, 0, 0, 1e-8], [1e3, 0, 0, 1e-8]]\n")
                .find("need more than 4194304 pieces"),
            std::string::npos);
  EXPECT_NE(errorOf("basis = \"catmull-rom\"\n"
                    "points = [[0, 0, 0, 9], [1, 0, 0, 0.1], [2, 0, 0, 0.1], [3, 0, 0, 9]]\n")
                .find("the radius falls to -"),
            std::string::npos);
  EXPECT_EQ(errorOfText("0 0 0 1\n1 0 0\n"), "hair.txt:2: 3 numbers; x, y, z and radius expected");
  EXPECT_EQ(errorOfText("0 0 0 1 5\n"),
            "hair.txt:1: more than four numbers; x, y, z and radius expected");
  EXPECT_EQ(errorOfText("0 0 0 1\n1 0 x 1\n"), "hair.txt:2: 'x' is not a finite number");
  EXPECT_EQ(errorOfText("0 0 nan 1\n"), "hair.txt:1: 'nan' is not a finite number");
  EXPECT_EQ(errorOfText("0 0 0 -1\n"),
            "hair.txt:1: radius -1 is out of range; 1e-15 to 1e+09 expected");
  EXPECT_EQ(errorOfText("0 2e9 0 1\n"),
            "hair.txt:1: coordinate 2e+09 is out of range; -1e+09 to 1e+09 expected");
  EXPECT_EQ(errorOfText("0 0 0 1\n1 0 0 1\n\n2 0 0 1\n\n"),
            "hair.txt:4: a strand of 1 points: at least 2 expected");
  EXPECT_EQ(errorOfText("0 0 0 1\n1 0 0 1\n2 0 0 1\n3 0 0 1\n4 0 0 1\n", "bezier"),
            "hair.txt:1: a strand of 5 points: 4, 7, 10, ... expected of basis 'bezier'");
  EXPECT_EQ(errorOfText(" \n\n"),
            "hair.txt: it has no points; lines of x, y, z and radius expected");
  EXPECT_EQ(errorOf("file = \"hair.txt\"\npoints = [[0, 0, 0, 1]]\n"),
            "x.scene.toml:4:10: 'points' beside 'file': the points are here or there, not both");
  EXPECT_NE(errorOf("file = \"../hair.txt\"\n").find("x.scene.toml:3:8"), std::string::npos);
}

// Mitsuba takes points to the world and leaves their radii.
TEST_F(CurveFiles, MitsubasCurvesAreRead) {
  folder_.write("wire.txt", "0 0 0 0.1\n1 0 0 0.1\n1 1 0 0.1\n2 1 0 0.1\n");
  const auto scene = [&](const std::string& type) {
    return folder_.load("<shape type=\"" + type +
                        "\"><string name=\"filename\" value=\"wire.txt\"/><transform "
                        "name=\"to_world\"><scale value=\"3\"/><translate y=\"100\"/></transform>"
                        "</shape>");
  };
  const Scene linear = scene("linearcurve");
  ASSERT_EQ(linear.geometries.size(), 1u);
  const ShapeGeometry& shape = *linear.geometries[0].shape;
  EXPECT_EQ(curvePieces(shape.words), 3u);
  const auto isInside = [&](const glm::dvec3& posW) {
    return shape.info->isInside(
        shape, glm::inverse(linear.instances.at(0).objectToWorld) * glm::dvec4(posW, 1.0));
  };
  EXPECT_TRUE(isInside({1.0, 100.09, 0.0}));
  EXPECT_FALSE(isInside({1.0, 100.11, 0.0}));
  EXPECT_TRUE(isInside({6.05, 103.0, 0.0}));
  EXPECT_GT(curvePieces(scene("bsplinecurve").geometries.at(0).shape->words), 3u);
  EXPECT_NE(folder_.error("<shape type=\"bsplinecurve\"/>").find("has no 'filename'"),
            std::string::npos);
  folder_.write("bad.txt", "0 0 0 0\n");
  EXPECT_NE(folder_
                .error("<shape type=\"linearcurve\"><string name=\"filename\" "
                       "value=\"bad.txt\"/></shape>")
                .find("bad.txt:1: radius 0"),
            std::string::npos);
}

// Kinds of shapes that Mitsuba does not have are unknown there: they have keys that it cannot give.
TEST_F(CurveFiles, OurOwnKindsAreNotMitsubas) {
  for (const char* type : {"nurbs", "sdf", "implicit", "torus", "plane", "curves", "cone"})
    EXPECT_NE(
        folder_.error(std::string("<shape type=\"") + type + "\"/>").find("is unknown; one of"),
        std::string::npos)
        << type;
}

}  // namespace
}  // namespace restlab
