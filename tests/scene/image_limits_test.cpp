// Images with false headers: refused by the size of the file, before memory is allocated for the
// pixels.
#include <gtest/gtest.h>

#include "core/scene/textures/image_decode.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

std::vector<uint8_t> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

std::string problemOf(const std::string& file) {
  DecodedImage image;
  return decodeImage(bytesOf(file), image);
}

std::string hdrProblem(const std::string& file) {
  DecodedHdr image;
  return decodeHdr(bytesOf(file), image);
}

std::string bigEndian(uint32_t value, int bytes = 4) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i));
  return text;
}

std::string pngOfSize(uint32_t width, uint32_t height) {
  return test::tinyPng().replace(16, 8, bigEndian(width) + bigEndian(height));
}

TEST(ImageLimits, PngThatClaimsMorePixels) {
  EXPECT_EQ(problemOf(test::tinyPng()), "");
  // 2^28 pixels of four bytes each compress to 1 MiB at best.
  EXPECT_NE(problemOf(pngOfSize(16384, 16384)).find("16384x16384 pixels in "), std::string::npos);
  EXPECT_NE(problemOf(pngOfSize(16384, 16384)).find("at least 1040"), std::string::npos)
      << problemOf(pngOfSize(16384, 16384));
  EXPECT_NE(problemOf(pngOfSize(100000, 100000)), "");
  EXPECT_NE(problemOf(pngOfSize(0xffffffff, 0xffffffff)), "");
  EXPECT_NE(problemOf(pngOfSize(0, 1)), "");
}

TEST(ImageLimits, PngChunkThatClaimsTheRest) {
  // Replace the length of the IDAT chunk, which follows the signature and the IHDR chunk of 25
  // bytes.
  std::string png = test::tinyPng();
  ASSERT_EQ(png.substr(37, 4), "IDAT");
  EXPECT_EQ(problemOf(png.replace(33, 4, bigEndian(1u << 30))), "truncated");
}

TEST(ImageLimits, PngWhoseLastPieceHasAWrongSum) {
  std::string png = test::tinyPng();
  const size_t pieceBytes = uint8_t(png[36]);
  png[41 + pieceBytes] = char(png[41 + pieceBytes] ^ 1);
  EXPECT_NE(problemOf(png), "");
}

// The PNG specification allows empty IDAT chunks.
TEST(ImageLimits, PngThatBeginsWithAnEmptyChunkOfPixels) {
  std::string png = test::tinyPng();
  png.insert(33, std::string("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12));
  EXPECT_EQ(problemOf(png), "");
}

// More than a thousand texts, the internal limit of libspng.
TEST(ImageLimits, PngOfManyChunks) {
  std::string png = test::tinyPng();
  const std::string text("\0\0\0\x03tEXta\0b\xdc\x49\xa2\x3b", 15);
  std::string texts;
  for (int i = 0; i < 3000; ++i) texts += text;
  png.insert(33, texts);
  EXPECT_EQ(problemOf(png), "");
}

// JPEG of one grey component, baseline or progressive, with `scans` scans.
std::string jpeg(uint32_t width, uint32_t height, size_t scans, bool progressive = false) {
  const auto segment = [](uint8_t marker, const std::string& data) {
    return std::string{'\xff', static_cast<char>(marker)} +
           bigEndian(static_cast<uint32_t>(data.size()) + 2, 2) + data;
  };
  const std::string oneCode = std::string(1, '\1') + std::string(16, '\0');
  std::string file =
      "\xff\xd8" + segment(0xdb, std::string(1, '\0') + std::string(64, '\1')) +
      segment(progressive ? 0xc2 : 0xc0,
              '\10' + bigEndian(height, 2) + bigEndian(width, 2) + std::string("\1\1\x11\0", 4)) +
      segment(0xc4, std::string(1, '\0') + oneCode) + segment(0xc4, '\x10' + oneCode);
  for (size_t i = 0; i < scans; ++i) {
    file +=
        segment(0xda, std::string("\1\1\0\0", 4) + (progressive ? '\0' : '\x3f') + '\0') + "\x3f";
  }
  return file + "\xff\xd9";
}

TEST(ImageLimits, JpegThatClaimsMorePixels) {
  EXPECT_EQ(problemOf(jpeg(8, 8, 1)), "");
  EXPECT_NE(problemOf(jpeg(16384, 16384, 1)).find("at least 524288 expected"), std::string::npos)
      << problemOf(jpeg(16384, 16384, 1));
  EXPECT_NE(problemOf(jpeg(65535, 65535, 1)), "");
}

TEST(ImageLimits, JpegOfManyScans) {
  EXPECT_EQ(problemOf(jpeg(8, 8, 500, true)), "");
  const std::string problem = problemOf(jpeg(8, 8, 501, true));
  EXPECT_NE(problem.find("has more than 500 scans"), std::string::npos) << problem;
  // An image inside a segment, as cameras store it, does not count as a scan.
  const std::string inside = jpeg(8, 8, 501, true);
  std::string file = jpeg(8, 8, 1);
  file.insert(2, "\xff\xe1" + bigEndian(static_cast<uint32_t>(inside.size()) + 2, 2) + inside);
  EXPECT_EQ(problemOf(file), "");
}

TEST(ImageLimits, JpegOfTooManyCodes) {
  // Two codes of each length except the longest, which has 255.
  const std::string good = jpeg(8, 8, 1);
  const size_t table = good.find("\xff\xc4");
  std::string file = good;
  file.replace(table, 2 + 2 + 1 + 16 + 1,
               "\xff\xc4" + bigEndian(2 + 1 + 16 + 285, 2) + '\0' + std::string(15, '\2') + '\xff' +
                   std::string(285, '\0'));
  EXPECT_EQ(problemOf(file), "cannot be decoded (Bogus Huffman table definition)");
}

TEST(ImageLimits, HdrThatClaimsMorePixels) {
  const auto hdr = [](const std::string& size, const std::string& pixels) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + pixels;
  };
  // Eight pixels of one colour: a row of four runs.
  const std::string row = std::string("\2\2\0\10", 4) + "\x88\1\x88\1\x88\1\x88\1";
  EXPECT_EQ(hdrProblem(hdr("-Y 1 +X 8", row)), "");
  // Runs that end at the end of the file.
  EXPECT_EQ(hdrProblem(hdr("-Y 2 +X 8", row + std::string("\2\2\0\10\x88\1", 6))), "truncated");
  // At least 16384 rows of one pixel and two marks that repeat it.
  EXPECT_NE(hdrProblem(hdr("-Y 16384 +X 16384", row)).find("at least 196608 expected"),
            std::string::npos)
      << hdrProblem(hdr("-Y 16384 +X 16384", row));
  for (const char* size : {"-Y 100000 +X 100000", "-Y -1 +X 8", "-Y 1 +X -8", "-Y 99999999999 +X 1",
                           "-Y 0 +X 0", "+Y 1 -Y 8"}) {
    EXPECT_NE(hdrProblem(hdr(size, row)), "") << size;
  }
}

}  // namespace
}  // namespace restlab
