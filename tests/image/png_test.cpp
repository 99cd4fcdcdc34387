// The PNG preview, decoded again.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <string>

#include "core/image/image.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace restlab {
namespace {

TEST(Png, SrgbKnownValues) {
  std::string folder = (std::filesystem::temp_directory_path() / "restlab-png-XXXXXX").string();
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  const std::string file = folder + "/a.png";

  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  // Radiance, and the bytes of IEC 61966-2-1 for twice the radiance (exposure 2).
  struct Case {
    glm::vec3 radiance;
    int bytes[3];
  };
  const Case cases[] = {
      {{0.0f, 0.5f, 7.0f}, {0, 255, 255}},      {{0.09f, 0.25f, 0.1f}, {118, 188, 124}},
      {{0.00156f, 0.0005f, -3.0f}, {10, 3, 0}}, {{kInfinity, -kInfinity, 0.0f}, {255, 0, 0}},
      {{0.2f, kNan, 0.2f}, {255, 0, 255}},      {{0.105f, 0.405f, 0.4975f}, {126, 232, 254}}};
  Image image(2, 3);
  for (size_t i = 0; i < 6; ++i) image.pixels[i] = cases[i].radiance;
  writePng(file, image, 2.0f);

  int width = 0, height = 0, channels = 0;
  unsigned char* bytes = stbi_load(file.c_str(), &width, &height, &channels, 0);
  ASSERT_NE(bytes, nullptr);
  EXPECT_EQ(width, 2);
  EXPECT_EQ(height, 3);
  ASSERT_EQ(channels, 3);
  for (size_t i = 0; i < 6; ++i) {
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(int(bytes[3 * i + c]), cases[i].bytes[c]) << "pixel " << i << " channel " << c;
    }
  }
  stbi_image_free(bytes);
  std::filesystem::remove_all(folder);
}

// Returns the texts of a PNG by keyword: tEXt, and iTXt without compression.
std::map<std::string, std::string> textsOf(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  std::map<std::string, std::string> texts;
  for (size_t at = 8; at + 12 <= bytes.size();) {
    size_t length = 0;
    for (size_t i = 0; i < 4; ++i) length = length << 8 | uint8_t(bytes[at + i]);
    const std::string type = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, length);
    const size_t end = data.find('\0');
    if (type == "tEXt") texts[data.substr(0, end)] = data.substr(end + 1);
    // Skip a flag, a method, and two empty texts, each ended by a zero.
    if (type == "iTXt") texts[data.substr(0, end)] = "iTXt " + data.substr(end + 5);
    at += 12 + length;
  }
  return texts;
}

TEST(Png, HasTheMetadataOfItsImage) {
  std::string folder = (std::filesystem::temp_directory_path() / "restlab-png-XXXXXX").string();
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  const std::string file = folder + "/a.png";
  const std::string longKey(90, 'k');
  writePng(file, Image(3, 2, glm::vec3(0.5f)), 1.0f,
           {{"version", "1.2"},
            {"scene", "cornell-box"},
            {"empty", ""},
            {"health", "a\nb"},
            {"camera",
             "K\xc3\xbc"
             "che"},
            {longKey, "v"}});
  const auto texts = textsOf(file);
  EXPECT_EQ(texts, (std::map<std::string, std::string>{{"Software", "restlab 1.2"},
                                                       {"restlab:version", "1.2"},
                                                       {"restlab:scene", "cornell-box"},
                                                       {"restlab:empty", " "},
                                                       {"restlab:health", "a\nb"},
                                                       {"restlab:camera",
                                                        "iTXt K\xc3\xbc"
                                                        "che"},
                                                       {"restlab:more", longKey + "=v"}}));
  int width = 0, height = 0, channels = 0;
  EXPECT_TRUE(stbi_info(file.c_str(), &width, &height, &channels)) << "texts are no pixels";
  EXPECT_EQ(width, 3);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace restlab
