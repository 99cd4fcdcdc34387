// Tests of the encoding of images for pages.
#include "experiments/view/image_message.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace restlab {
namespace {

template <class Number>
Number at(const Bytes& bytes, size_t offset) {
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

Image twoPixels() {
  Image image(2, 1);
  const float infinity = std::numeric_limits<float>::infinity();
  image.pixels = {{0.1f, -0.0f, std::numeric_limits<float>::quiet_NaN()}, {1e6f, infinity, 3e-8f}};
  return image;
}

TEST(ImageMessages, HoldEveryBitOfFloats) {
  const Image image = twoPixels();
  const Bytes bytes = imageMessage({3, PixelFormat::floats, 0, 0, 7, uint64_t(1) << 40}, image);
  ASSERT_EQ(bytes.size(), kImageHeaderBytes + 24);
  EXPECT_EQ(std::memcmp(bytes.data(), "RLI1", 4), 0);
  const uint32_t words[] = {3, 0, 2, 1, 7};
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(at<uint32_t>(bytes, 4 + 4 * i), words[i]) << i;
  EXPECT_EQ(at<uint64_t>(bytes, 24), uint64_t(1) << 40);
  EXPECT_EQ(std::memcmp(bytes.data() + kImageHeaderBytes, image.pixels.data(), 24), 0);
}

TEST(ImageMessages, RoundToHalves) {
  const Bytes bytes = imageMessage({0, PixelFormat::halves}, twoPixels());
  ASSERT_EQ(bytes.size(), kImageHeaderBytes + 12);
  EXPECT_EQ(at<uint32_t>(bytes, 8), 1u);
  // 0.1 is 1.6 x 2^-4, nearest to 0x2e66. 1e6 is above the largest half and becomes that. 3e-8 is
  // nearest to the smallest half, 2^-24.
  const uint16_t expected[] = {0x2e66, 0x8000, 0, 0x7bff, 0x7c00, 0x0001};
  for (size_t i = 0; i < 6; ++i) {
    const uint16_t word = at<uint16_t>(bytes, kImageHeaderBytes + 2 * i);
    if (i == 2) {
      EXPECT_TRUE((word & 0x7c00) == 0x7c00 && (word & 0x3ff) != 0) << "a NaN stays one";
    } else {
      EXPECT_EQ(word, expected[i]) << i;
    }
  }
}

}  // namespace
}  // namespace restlab
