// Environment files that declare more than pixels: cubes, windows, colours.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/error.h"
#include "core/image/image.h"
#include "core/scene/scene.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

namespace fs = std::filesystem;

void writeWith(const fs::path& file, const Image& image,
               const std::function<void(Imf::Header&)>& attributes) {
  Imf::Header header(int(image.width), int(image.height));
  attributes(header);
  Imf::FrameBuffer frame;
  for (int c = 0; c < 3; ++c) {
    const std::string name(1, "RGB"[c]);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, &image.pixels[0][c], header.dataWindow(),
                                        sizeof(glm::vec3), sizeof(glm::vec3) * image.width));
  }
  Imf::OutputFile output(file.c_str(), header);
  output.setFrameBuffer(frame);
  output.writePixels(int(image.height));
}

std::string errorOf(const fs::path& file) {
  try {
    loadEnvironment(file);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    return error.what();
  }
  return "";
}

// Radiance towards a point in OpenEXR's convention: the middle of a map is +Z, its left half +X and
// its top +Y.
glm::vec3 towards(const EnvironmentMap& map, double u, double v) {
  return map.radiance.at(size_t(v * map.height) * map.width + size_t(u * map.width));
}

class EnvironmentFiles : public testing::Test {
 protected:
  fs::path file() const { return directory_.path() / "sky.exr"; }
  void writeCube(const Image& cube) const {
    writeWith(file(), cube, [](Imf::Header& header) { Imf::addEnvmap(header, Imf::ENVMAP_CUBE); });
  }
  test::TempDirectory directory_;
};

TEST_F(EnvironmentFiles, CubesAreDrawnAsSixFaces) {
  Image cube(8, 48);
  for (uint32_t y = 0; y < 48; ++y)
    for (uint32_t x = 0; x < 8; ++x) cube.at(x, y) = glm::vec3(float(1 + y / 8));
  writeCube(cube);
  const EnvironmentMap map = loadEnvironment(file());
  EXPECT_EQ(map.width, 32u);
  EXPECT_EQ(map.height, 16u);
  const float right[] = {towards(map, 0.25, 0.5).x, towards(map, 0.75, 0.5).x,
                         towards(map, 0.5, 0.05).x, towards(map, 0.5, 0.95).x,
                         towards(map, 0.5, 0.5).x,  towards(map, 0.01, 0.5).x};
  for (int face = 0; face < 6; ++face) EXPECT_EQ(right[face], float(1 + face)) << face;
  // A face covers a sixth of the sphere.
  double light = 0.0, area = 0.0;
  for (uint32_t y = 0; y < map.height; ++y) {
    const double ring = std::sin((y + 0.5) / map.height * 3.14159265);
    for (uint32_t x = 0; x < map.width; ++x, area += ring)
      light += ring * map.radiance[size_t(y) * map.width + x].x;
  }
  EXPECT_NEAR(light / area, 3.5, 0.05);
  ASSERT_EQ(map.warnings.size(), 1u);
  EXPECT_NE(map.warnings[0].find("faces of 8x8 pixels"), std::string::npos) << map.warnings[0];
}

// Rows of the face +Z go down from +Y, and its columns from +X to -X (ImfEnvmap.h).
TEST_F(EnvironmentFiles, FacesOfACubeStandUpright) {
  Image cube(16, 96);
  for (uint32_t y = 0; y < 96; ++y)
    for (uint32_t x = 0; x < 16; ++x) cube.at(x, y) = {float(x), float(y % 16), 0.0f};
  writeCube(cube);
  const EnvironmentMap map = loadEnvironment(file());
  const glm::vec3 high = towards(map, 0.5, 0.35), low = towards(map, 0.5, 0.65);
  EXPECT_LT(high.y, 5.0f);
  EXPECT_GT(low.y, 10.0f);
  const glm::vec3 left = towards(map, 0.4, 0.5), right = towards(map, 0.6, 0.5);
  EXPECT_LT(left.x, 4.0f);
  EXPECT_GT(right.x, 11.0f);
}

TEST_F(EnvironmentFiles, WhatIsNoWholeMapIsAnError) {
  writeCube(Image(4, 23, glm::vec3(1.0f)));
  EXPECT_NE(errorOf(file()).find("cube, of 4x23 pixels; six square faces"), std::string::npos);
  const Image image(8, 4, glm::vec3(1.0f));
  writeWith(file(), image, [](Imf::Header& header) { header.displayWindow().max.x = 15; });
  EXPECT_NE(errorOf(file()).find("its data window (0, 0) - (7, 3) is not its display window (0, 0) "
                                 "- (15, 3)"),
            std::string::npos)
      << errorOf(file());
  writeWith(file(), image, [](Imf::Header& header) { Imf::addEnvmap(header, Imf::Envmap(7)); });
  EXPECT_NE(errorOf(file()).find("'envmap' is neither"), std::string::npos) << errorOf(file());
  // A whole map whose window is not at the origin.
  writeWith(file(), image, [](Imf::Header& header) {
    header.displayWindow() = header.dataWindow() = {{5, 5}, {12, 8}};
  });
  EXPECT_EQ(errorOf(file()), "");
}

TEST_F(EnvironmentFiles, ColoursOutOfReachAreCutAndCounted) {
  Image image(8, 4, glm::vec3(0.5f));
  image.at(3, 1) = {0.0f, 1.0f, 0.0f};
  writeWith(file(), image, [](Imf::Header& header) {
    Imf::addChromaticities(header, Imf::Chromaticities({0.708f, 0.292f}, {0.17f, 0.797f},
                                                       {0.131f, 0.046f}, {0.3127f, 0.329f}));
  });
  const EnvironmentMap map = loadEnvironment(file());
  EXPECT_NEAR(map.radiance.at(0).x, 0.5f, 1e-5f) << "grey stays grey";
  EXPECT_EQ(map.radiance.at(11).x, 0.0f);
  EXPECT_NEAR(map.radiance.at(11).y, 1.1329f, 1e-3f);
  ASSERT_EQ(map.warnings.size(), 2u);
  EXPECT_NE(map.warnings[1].find("1 of 32 pixels have colours outside of Rec. 709"),
            std::string::npos)
      << map.warnings[1];
}

}  // namespace
}  // namespace restlab
