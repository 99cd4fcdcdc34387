// Radiance HDR: the keywords of its header, and its runs of both kinds.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/textures/image_decode.h"

namespace restlab {
namespace {

constexpr const char* kRgbe = "FORMAT=32-bit_rle_rgbe\n";

DecodedHdr decoded(const std::string& header, const std::string& size, const std::string& pixels) {
  const std::string file = "#?RADIANCE\n" + header + "\n" + size + "\n" + pixels;
  DecodedHdr image;
  EXPECT_EQ(decodeHdr({file.begin(), file.end()}, image), "") << header << size;
  return image;
}

std::string problem(const std::string& header, const std::string& size, const std::string& pixels) {
  const std::string file = "#?RADIANCE\n" + header + "\n" + size + "\n" + pixels;
  DecodedHdr image;
  return decodeHdr({file.begin(), file.end()}, image);
}

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += char(value);
  return text;
}

// RGBE of (0.5, 0.25, 1).
const std::string kPixel = bytes({64, 32, 128, 129});

void expectNear(const glm::vec3& found, const glm::dvec3& right, double tolerance = 1e-6) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], right[c], tolerance) << "channel " << c;
}

TEST(Hdr, ExposuresAndColourCorrectionsAreDividedOut) {
  const auto one = [](const std::string& header) {
    return decoded(header + kRgbe, "-Y 1 +X 1", kPixel).pixels.at(0);
  };
  EXPECT_EQ(one(""), glm::vec3(0.5f, 0.25f, 1.0f));
  EXPECT_EQ(one("EXPOSURE=2.0\n"), glm::vec3(0.25f, 0.125f, 0.5f));
  expectNear(one("EXPOSURE= 2.000000e+00\nSOFTWARE=x\nEXPOSURE=+5\r\n"), {0.05, 0.025, 0.1});
  expectNear(one("COLORCORR=2 0.5 1\nEXPOSURE=0.1\nCOLORCORR= 1 0.5 4\n"), {2.5, 10, 2.5});
  // Indented lines belong to a program's input, not to this file.
  EXPECT_EQ(one("pcomb a.hdr\n\tEXPOSURE=8\n"), glm::vec3(0.5f, 0.25f, 1.0f));
}

TEST(Hdr, ColoursOfOtherPrimariesBecomeRec709) {
  const std::string red = bytes({128, 0, 0, 129});
  const std::string rec2020 =
      "PRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n" + std::string(kRgbe);
  const DecodedHdr wide = decoded(rec2020, "-Y 1 +X 1", red);
  expectNear(wide.pixels[0], {1.6605, -0.1246, -0.0182}, 1e-4);
  EXPECT_TRUE(wide.isConverted);
  EXPECT_EQ(wide.notes.size(), 1u);
  // Exposure applies to the file's own channels.
  expectNear(decoded("COLORCORR=2 1 1\n" + rec2020, "-Y 1 +X 1", red).pixels[0],
             {0.8302, -0.0623, -0.0091}, 1e-4);
  // Programs that do not know the primaries write eight zeros.
  const DecodedHdr unknown =
      decoded("GAMMA=1\nPRIMARIES=0 0 0 0 0 0 0 0\n" + std::string(kRgbe), "-Y 1 +X 1", red);
  EXPECT_EQ(unknown.pixels[0], glm::vec3(1, 0, 0));
  EXPECT_TRUE(unknown.notes.empty());
  const DecodedHdr xyz = decoded("FORMAT=32-bit_rle_xyze\n", "-Y 1 +X 1", red);
  expectNear(xyz.pixels[0], {3.2410, -0.9692, 0.0556}, 1e-3);
  EXPECT_TRUE(xyz.isConverted);
}

TEST(Hdr, RunsOfTheOldKind) {
  // 300 pixels: one, its 43 = 0x2b repetitions and 256 more, in digits to base 256.
  const std::string other = bytes({128, 0, 0, 129});
  const DecodedHdr image =
      decoded(kRgbe, "-Y 2 +X 300",
              kPixel + bytes({1, 1, 1, 43, 1, 1, 1, 1}) +             // 1 + 43 + 256
                  kPixel + other + bytes({1, 1, 1, 0, 1, 1, 1, 1}) +  // 1 + 1 + 0 + 256
                  kPixel + bytes({1, 1, 1, 40}) + other);             // 1 + 40 + 1
  ASSERT_EQ(image.pixels.size(), 600u);
  for (size_t x = 0; x < 300; ++x) ASSERT_EQ(image.pixels[x], glm::vec3(0.5f, 0.25f, 1.0f)) << x;
  EXPECT_EQ(image.pixels[300], glm::vec3(0.5f, 0.25f, 1.0f));
  for (size_t x = 301; x < 558; ++x) ASSERT_EQ(image.pixels[x], glm::vec3(1, 0, 0)) << x;
  for (size_t x = 558; x < 599; ++x) ASSERT_EQ(image.pixels[x], glm::vec3(0.5f, 0.25f, 1.0f)) << x;
  EXPECT_EQ(image.pixels[599], glm::vec3(1, 0, 0));
  EXPECT_NE(problem(kRgbe, "-Y 1 +X 4", kPixel + bytes({1, 1, 1, 4}))
                .find("row 0 has a run of 4 pixels from pixel 1 on, and 4 pixels in all"),
            std::string::npos);
  EXPECT_NE(problem(kRgbe, "-Y 1 +X 4", bytes({1, 1, 1, 4}) + kPixel).find("begins with a run"),
            std::string::npos);
}

TEST(Hdr, RunsOfTheNewKindBesideOthers) {
  const std::string runs = bytes({2, 2, 0, 9}) + bytes({0x80 + 9, 64}) +  // red: one run
                           bytes({2, 1, 2, 0x80 + 7, 32}) +               // green: two, then a run
                           bytes({9, 0, 1, 2, 3, 4, 5, 6, 7, 8}) + bytes({0x80 + 9, 129});
  const DecodedHdr image = decoded(kRgbe, "-Y 2 +X 9", runs + kPixel + bytes({1, 1, 1, 8}));
  EXPECT_EQ(image.pixels[0], glm::vec3(0.5f, 1 / 128.0f, 0.0f));
  EXPECT_EQ(image.pixels[8], glm::vec3(0.5f, 0.25f, 8 / 128.0f));
  EXPECT_EQ(image.pixels[17], glm::vec3(0.5f, 0.25f, 1.0f));
  EXPECT_EQ(problem(kRgbe, "-Y 2 +X 9", runs), "truncated");
  EXPECT_NE(problem(kRgbe, "-Y 1 +X 8", runs).find("row 0 says it has 9 pixels, the image has 8"),
            std::string::npos);
  std::string wrong = runs;
  wrong[4] = char(0x80 + 10);
  EXPECT_NE(problem(kRgbe, "-Y 1 +X 9", wrong).find("row 0 has a run of 10 pixels"),
            std::string::npos);
  wrong[4] = 0;
  EXPECT_NE(problem(kRgbe, "-Y 1 +X 9", wrong).find("a run of no pixels"), std::string::npos);
}

// One image, 1 2 3 above 4 5 6, in all eight orders.
TEST(Hdr, RowsOfEveryOrder) {
  const auto pixels = [](const std::string& order) {
    std::string text;
    for (const char c : order) text += bytes({128, 0, 0, 128 + (c - '0')});
    return text;
  };
  const std::pair<const char*, const char*> orders[] = {
      {"-Y 2 +X 3", "123456"}, {"-Y 2 -X 3", "321654"}, {"+Y 2 +X 3", "456123"},
      {"+Y 2 -X 3", "654321"}, {"+X 3 -Y 2", "142536"}, {"+X 3 +Y 2", "415263"},
      {"-X 3 -Y 2", "362514"}, {"-X 3 +Y 2", "635241"}};
  for (const auto& [size, order] : orders) {
    const DecodedHdr image = decoded(kRgbe, size, pixels(order));
    ASSERT_EQ(image.width, 3u) << size;
    ASSERT_EQ(image.height, 2u) << size;
    for (int i = 0; i < 6; ++i)
      EXPECT_EQ(image.pixels[size_t(i)].x, std::ldexp(1.0f, i)) << size << ", pixel " << i;
  }
}

TEST(Hdr, HeadersThatSayNothingAreAnError) {
  const std::pair<std::string, const char*> cases[] = {
      {"EXPOSURE=0\n", "'EXPOSURE=0': a number above 0"},
      {"EXPOSURE=-1\n", "a number above 0"},
      {"EXPOSURE=nan\n", "a number above 0"},
      {"EXPOSURE=two\n", "a number above 0"},
      {"EXPOSURE=1e-20\nEXPOSURE=1e-20\n", "1e-40 in all"},
      {"COLORCORR=1 1\n", "three numbers above 0"},
      {"COLORCORR=1 0 1\n", "three numbers above 0"},
      {"PRIMARIES=1 2 3\n", "eight numbers"},
      {"PRIMARIES=.1 .1 .2 .2 .3 .3 .3 .3\n", "do not lie on a line"},
      {"FORMAT=32-bit_float\n", "32-bit_rle_rgbe or 32-bit_rle_xyze expected"}};
  for (const auto& [header, right] : cases)
    EXPECT_NE(problem(header + kRgbe, "-Y 1 +X 1", kPixel).find(right), std::string::npos)
        << header << problem(header + kRgbe, "-Y 1 +X 1", kPixel);
  EXPECT_NE(problem("", "-Y 1 +X 1", kPixel).find("has no line 'FORMAT="), std::string::npos);
  for (const char* size : {"-Y 1 +Y 1", "-Y 1", "1 1", "-Y 1 +X 1 +X 1", "-Z 1 +X 1", ""})
    EXPECT_NE(problem(kRgbe, size, kPixel).find("two axes"), std::string::npos) << size;
}

}  // namespace
}  // namespace restlab
