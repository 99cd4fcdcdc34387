// Images inside the report: lossless encoding, and the choice of crops.
#include "experiments/report/pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "core/base/error.h"
#include "tests/report/sample.h"

namespace restlab::report_test {
namespace {

bool sameBits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

Crop whole(const Image& image) { return {0, 0, image.width, image.height}; }

TEST(PackPixels, KeepsEveryBit) {
  // Random bit patterns, including NaN payloads and denormals.
  Image image(37, 19);
  std::mt19937 random(7);
  for (glm::vec3& pixel : image.pixels) {
    const uint32_t bits[3] = {uint32_t(random()), uint32_t(random()), uint32_t(random())};
    std::memcpy(&pixel, bits, sizeof(bits));
  }
  const std::vector<glm::vec3> special = specialPixels();
  std::copy(special.begin(), special.end(), image.pixels.begin());
  EXPECT_TRUE(sameBits(unpackPixels(packPixels(image, whole(image)), 37, 19), image));
}

TEST(PackPixels, TakesTheCrop) {
  const Image image = sampleReference(20, 12);
  const Image back = unpackPixels(packPixels(image, {7, 3, 5, 4}), 5, 4);
  for (uint32_t y = 0; y < 4; ++y) {
    for (uint32_t x = 0; x < 5; ++x) EXPECT_EQ(back.at(x, y), image.at(x + 7, y + 3));
  }
}

TEST(PackPixels, OtherSizesAndDamageAreNoticed) {
  const Image image = sampleReference(8, 4);
  std::string text = packPixels(image, whole(image));
  EXPECT_THROW(unpackPixels(text, 8, 5), Error);
  EXPECT_THROW(unpackPixels(text, 8, 3), Error);
  EXPECT_THROW(unpackPixels("<script>", 8, 4), Error);
  text[text.size() / 2] = text[text.size() / 2] == 'A' ? 'B' : 'A';
  EXPECT_THROW(unpackPixels(text, 8, 4), Error);
}

TEST(Base64, KnownAnswers) {
  // RFC 4648, section 10.
  const char* answers[][2] = {{"", ""},
                              {"f", "Zg=="},
                              {"fo", "Zm8="},
                              {"foo", "Zm9v"},
                              {"foob", "Zm9vYg=="},
                              {"fooba", "Zm9vYmE="},
                              {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : answers) {
    EXPECT_EQ(encodeBase64(bytes), text);
    EXPECT_EQ(decodeBase64(text), bytes);
  }
}

TEST(PixelLimit, IsAShareOfTheTotal) {
  EXPECT_EQ(reportPixelLimit(0), kReportImagePixels);
  EXPECT_EQ(reportPixelLimit(3), kReportImagePixels);
  EXPECT_EQ(reportPixelLimit(24), kReportTotalPixels / 24);
  EXPECT_GE(reportPixelLimit(size_t(1) << 40), 1u);
}

TEST(ChooseCrop, WholeWhereItFits) {
  const Image image = sampleReference(40, 20);
  EXPECT_EQ(chooseCrop({&image}, nullptr, 800), (Crop{0, 0, 40, 20}));
}

TEST(ChooseCrop, KeepsProportionsAndLimit) {
  const Image image = sampleReference(400, 200);
  const Crop crop = chooseCrop({&image}, nullptr, 20000);
  EXPECT_EQ(crop, (Crop{100, 50, 200, 100}));
}

TEST(ChooseCrop, LongImages) {
  for (const auto& [width, height] : {std::pair(3000u, 1u), std::pair(1u, 3000u)}) {
    const Image image(width, height);
    const Crop crop = chooseCrop({&image}, nullptr, 100);
    EXPECT_EQ(crop.width * crop.height, 100u);
    EXPECT_LE(crop.x + crop.width, width);
    EXPECT_LE(crop.y + crop.height, height);
  }
}

TEST(ChooseCrop, LooksWhereTheErrorIs) {
  const Image reference = sampleReference(160, 80);
  Image image = reference;
  for (uint32_t y = 50; y < 74; ++y) {
    for (uint32_t x = 120; x < 150; ++x) image.at(x, y) *= 1.5f;
  }
  const Crop crop = chooseCrop({&reference, &image}, &reference, 160 * 80 / 4);
  EXPECT_LE(crop.x, 120u);
  EXPECT_GE(crop.x + crop.width, 150u);
  EXPECT_LE(crop.y, 50u);
  EXPECT_GE(crop.y + crop.height, 74u);
}

TEST(ChooseCrop, OneFireflyOrNanDoesNotDecide) {
  const Image reference = sampleReference(160, 80);
  Image image = reference;
  for (uint32_t y = 0; y < 20; ++y) {
    for (uint32_t x = 0; x < 20; ++x) image.at(x, y) *= 1.5f;
  }
  image.at(150, 70) = glm::vec3(1e30f);
  image.at(151, 70) = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  const Crop crop = chooseCrop({&image, &reference}, &reference, 160 * 80 / 4);
  EXPECT_EQ(crop, (Crop{0, 0, 80, 40}));
}

}  // namespace
}  // namespace restlab::report_test
