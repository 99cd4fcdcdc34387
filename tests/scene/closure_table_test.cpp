// Tables of BRDFs: MERL's files and EXR, and every way in which they can be wrong.
#include "core/scene/closure_table/closure_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/base/error.h"
#include "core/image/image.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

constexpr size_t kHeader = 12, kCells = 90 * 90 * 180;

glm::dvec3 lobe(const glm::dvec3& wo, const glm::dvec3& wi) {
  const double cosH = glm::normalize(wo + wi).z;
  return glm::dvec3(0.1, 0.2, 0.3) + std::pow(cosH, 20.0);
}

class ClosureTableFile : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& name) { return directory_.path() / name; }
  std::string errorOf(const std::filesystem::path& path) {
    try {
      readClosureTable(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      return error.what();
    }
    return "no error";
  }
  void expectError(const std::filesystem::path& path, const std::string& part) {
    const std::string line = errorOf(path);
    EXPECT_NE(line.find(part), std::string::npos) << line;
    EXPECT_EQ(line.rfind(path.string() + ": ", 0), 0u) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  // MERL's bytes of a table, with some of them replaced.
  std::string merlBytes() {
    writeMerl(file("whole.binary"), tabulate(lobe, TableAngles::half, kMerlSizes));
    std::ifstream stream(file("whole.binary"), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  static void put(std::string& bytes, size_t value, double with) {
    std::memcpy(bytes.data() + kHeader + value * sizeof(double), &with, sizeof with);
  }
  test::TempDirectory directory_;
};

TEST_F(ClosureTableFile, MerlComesBackAsItWas) {
  const ClosureTable written = tabulate(lobe, TableAngles::half, kMerlSizes);
  EXPECT_EQ(merlBytes().size(), kHeader + 3 * kCells * sizeof(double));
  const ClosureTable read = readClosureTable(file("whole.binary"));
  ASSERT_EQ(read.values.size(), written.values.size());
  EXPECT_EQ(read.sizes, kMerlSizes);
  float largest = 0.0f;
  size_t below = 0;
  for (size_t i = 0; i < read.values.size(); ++i) {
    if (read.values[i] == glm::vec3(0.0f)) {
      ++below;
      continue;
    }
    const glm::vec3 d = glm::abs(read.values[i] - written.values[i]);
    largest = std::max({largest, d.x, d.y, d.z});
  }
  EXPECT_LT(largest, 1e-6f);
  EXPECT_GT(below, 0u) << "some cells lie below the surface";
  EXPECT_LT(below, kCells / 2);
}

TEST_F(ClosureTableFile, FaultsOfMerlFiles) {
  const std::string whole = merlBytes();
  const size_t top = 10 * 180 + 3;  // theta_h 0, theta_d 10.5 degrees: above the surface
  expectError(directory_.write("short.binary", whole.substr(0, 1000)), "ends too early");
  expectError(directory_.write("long.binary", whole + "x"), "goes on after its");
  expectError(directory_.write("empty.binary", ""), "it begins with 0 0 0");
  std::string bytes = whole;
  bytes[0] = 91;
  expectError(directory_.write("sizes.binary", bytes), "it begins with 91 90 180");
  for (const double value : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    bytes = whole;
    put(bytes, kCells + top, value);
    expectError(directory_.write("value.binary", bytes), "green of cell (0, 10, 3) is ");
  }
  bytes = whole;
  put(bytes, kCells - 1, -1.0);  // theta_h and theta_d near 90 degrees
  EXPECT_EQ(errorOf(directory_.write("below.binary", bytes)), "no error");
  expectError(directory_.write("table.txt", whole), ".binary (MERL) or .exr");
  expectError(file("none.binary"), "");
}

TEST_F(ClosureTableFile, ExrComesBackAsItWas) {
  for (const TableAngles angles : {TableAngles::half, TableAngles::directions}) {
    const ClosureTable written = tabulate(lobe, angles, {8u, 8u, 12u});
    writeTableExr(file("table.exr"), written);
    const ClosureTable read = readClosureTable(file("table.exr"));
    EXPECT_EQ(read.angles, angles);
    EXPECT_EQ(read.sizes, written.sizes);
    ASSERT_EQ(read.values.size(), written.values.size());
    for (size_t i = 0; i < read.values.size(); ++i) {
      if (read.values[i].y == 0.0f) continue;  // below the surface
      EXPECT_NEAR(read.values[i].y, written.values[i].y, 1e-6f) << i;
    }
  }
}

TEST_F(ClosureTableFile, FaultsOfExrTables) {
  LayeredImage image;
  image.layers[""] = Image(4, 4, glm::vec3(0.1f));
  const auto expect = [&](const std::string& angles, const std::string& sizes,
                          const std::string& part) {
    image.metadata = {{"table", angles}, {"sizes", sizes}};
    writeExr(file("table.exr"), image);
    expectError(file("table.exr"), part);
  };
  expect("quarter", "2 2 4", "angles 'quarter'; half or directions expected");
  expect("half", "2 2", "sizes '2 2'; three numbers expected");
  expect("half", "2 2 4 1", "three numbers expected");
  expect("half", "1 4 4", "2 to 4096 expected");
  expect("half", "4096 4096 4096", "cells; at most");
  expect("half", "2 2 5", "its pixels disagree with sizes '2 2 5': 5x4 R, G, B expected");
  expect("directions", "2 4 4", "disagree: wo and wi have the same angles");
  image.metadata.clear();
  writeExr(file("table.exr"), image);
  expectError(file("table.exr"), "no attribute 'restlab:table'");
  image.layers[""].pixels[0].x = -0.5f;
  expect("directions", "2 2 4", "red of cell (0, 0, 0) is -0.5");
}

// Asymmetric values are made symmetric on reading: f(wi, wo) = f(wo, wi) by construction.
TEST_F(ClosureTableFile, DirectionsAreReciprocal) {
  ClosureTable table = tabulate(
      [](const glm::dvec3& wo, const glm::dvec3& wi) { return glm::dvec3(wo.z + 3.0 * wi.z); },
      TableAngles::directions, {4u, 4u, 3u});
  ASSERT_NE(table.at(0, 2, 1), table.at(2, 0, 1));
  writeTableExr(file("table.exr"), table);
  const ClosureTable read = readClosureTable(file("table.exr"));
  EXPECT_EQ(read.at(0, 2, 1), read.at(2, 0, 1));
  EXPECT_FLOAT_EQ(read.at(0, 2, 1).x, 0.5f * (table.at(0, 2, 1).x + table.at(2, 0, 1).x));
}

}  // namespace
}  // namespace restlab
