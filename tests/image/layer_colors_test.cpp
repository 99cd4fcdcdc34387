#include "core/image/io/layer_colors.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>

#include "core/image/io/srgb.h"

namespace restlab {
namespace {

TEST(LayerColors, EachNameHasAColourOfItsOwn) {
  Image names(64, 64);
  for (size_t i = 0; i < names.pixels.size(); ++i) names.pixels[i] = glm::vec3(float(i / 2));
  const std::vector<uint8_t> bytes = srgbBytes(falseColors(names), 1.0f);
  std::set<std::array<uint8_t, 3>> colors;
  for (size_t i = 0; i < names.pixels.size(); ++i) {
    const std::array<uint8_t, 3> color = {bytes[3 * i], bytes[3 * i + 1], bytes[3 * i + 2]};
    const bool isDark = color[0] < 40 || color[1] < 40 || color[2] < 40;
    EXPECT_EQ(isDark, i < 2) << "0 alone is black";
    colors.insert(color);
  }
  EXPECT_GE(colors.size(), 2040u) << "of 2048 names";
}

TEST(LayerColors, NumbersAreEvenStepsOfGrey) {
  Image numbers(257, 1);
  for (uint32_t x = 0; x < 256; ++x) numbers.at(x, 0) = glm::vec3(-3.0f + 0.5f * float(x));
  numbers.at(256, 0) = glm::vec3(std::numeric_limits<float>::infinity());
  const ValueRange range = valueRange(numbers);
  EXPECT_EQ(range.least, -3.0f);
  EXPECT_EQ(range.greatest, 124.5f);
  const std::vector<uint8_t> bytes = srgbBytes(scaledTo(numbers, range), 1.0f);
  for (uint32_t x = 0; x < 256; ++x) EXPECT_EQ(bytes[3 * x], x);
}

TEST(LayerColors, WithoutARangeAllIsBlack) {
  const Image flat(4, 4, glm::vec3(7.0f)), nothing(1, 1, glm::vec3(std::nanf("")));
  EXPECT_EQ(valueRange(nothing).greatest, 0.0f);
  for (const glm::vec3& pixel : scaledTo(flat, valueRange(flat)).pixels)
    EXPECT_EQ(pixel, glm::vec3(0.0f));
}

}  // namespace
}  // namespace restlab
