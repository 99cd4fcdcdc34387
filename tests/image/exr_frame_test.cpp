// Contents of an EXR beside its pixels: colours, windows, and channels that are not read.
#include <ImfStandardAttributes.h>

#include <array>
#include <cstring>
#include <functional>

#include "core/image/io/chromaticities.h"
#include "core/image/io/exr_contents.h"
#include "tests/image/exr_fixture.h"

namespace restlab {
namespace {

struct ForeignChannel {
  const char* name;
  Imf::PixelType type;
  float value;
  int sampling = 1;
};

// Writes constant channels of any types; `attributes` adds to the header.
void writeMixed(const fs::path& file, const Imath::Box2i& display, const Imath::Box2i& data,
                const std::vector<ForeignChannel>& channels,
                const std::function<void(Imf::Header&)>& attributes = {}) {
  Imf::Header header(display, data);
  if (attributes) attributes(header);
  const size_t width = size_t(data.max.x - data.min.x + 1);
  const size_t count = width * size_t(data.max.y - data.min.y + 1);
  std::vector<std::vector<uint32_t>> words;
  Imf::FrameBuffer frame;
  for (const ForeignChannel& channel : channels) {
    header.channels().insert(channel.name,
                             Imf::Channel(channel.type, channel.sampling, channel.sampling));
    uint32_t word = uint32_t(channel.value);
    if (channel.type == Imf::FLOAT) std::memcpy(&word, &channel.value, 4);
    words.emplace_back(count, word);
    frame.insert(channel.name, Imf::Slice::Make(channel.type, words.back().data(), data, 4,
                                                4 * width, channel.sampling, channel.sampling));
  }
  Imf::OutputFile output(file.c_str(), header);
  output.setFrameBuffer(frame);
  output.writePixels(data.max.y - data.min.y + 1);
}

std::vector<ForeignChannel> rgb(const glm::vec3& c) {
  return {{"R", Imf::FLOAT, c.x}, {"G", Imf::FLOAT, c.y}, {"B", Imf::FLOAT, c.z}};
}

void expectNear(const glm::vec3& found, const glm::dvec3& right, double tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], right[c], tolerance) << "channel " << c;
}

class ExrFrameTest : public ExrTest {
 protected:
  const Imath::Box2i window_ = box(0, 0, 3, 1);

  // Writes a file of one colour whose chromaticities are (x, y) of red, green, blue and white.
  fs::path coloured(const glm::vec3& colour, const std::array<float, 8>& xy) {
    writeMixed(path("c.exr"), window_, window_, rgb(colour), [&](Imf::Header& header) {
      Imf::addChromaticities(header, Imf::Chromaticities({xy[0], xy[1]}, {xy[2], xy[3]},
                                                         {xy[4], xy[5]}, {xy[6], xy[7]}));
    });
    return path("c.exr");
  }
};

// Expected: matrices of ITU-R BT.2087 (2020 to 709) and of IEC 61966-2-1 (XYZ to sRGB).
TEST_F(ExrFrameTest, ColoursOfOtherPrimariesBecomeRec709) {
  const std::array<float, 8> rec2020 = {0.708f, 0.292f, 0.170f,  0.797f,
                                        0.131f, 0.046f, 0.3127f, 0.3290f};
  const LayeredImage wide = readExr(coloured({1.0f, 0.0f, 0.0f}, rec2020));
  expectNear(wide.layers.at("").at(3, 1), {1.6605, -0.1246, -0.0182}, 1e-4);
  ASSERT_EQ(wide.notes.size(), 1u);
  EXPECT_NE(wide.notes[0].find("Rec. 709 from red (0.708, 0.292)"), std::string::npos);
  expectNear(readExr(coloured({0.0f, 1.0f, 0.0f}, rec2020)).layers.at("").at(0, 0),
             {-0.5876, 1.1329, -0.1006}, 1e-4);
  const float third = 1.0f / 3.0f;
  const std::array<float, 8> xyz = {1, 0, 0, 1, 0, 0, third, third};
  // No chromatic adaptation: the XYZ of D65 is white.
  expectNear(readExr(coloured({0.950456f, 1.0f, 1.089058f}, xyz)).layers.at("").at(0, 0), {1, 1, 1},
             1e-5);
  expectNear(readExr(coloured({1, 0, 0}, xyz)).layers.at("").at(0, 0), {3.2406, -0.9689, 0.0557},
             1e-3);
  // ACES AP0, whose blue has a y below 0 and whose white is D60: luminance must not change.
  const std::array<float, 8> ap0 = {0.7347f, 0.2653f, 0.0f,     1.0f,
                                    0.0001f, -0.077f, 0.32168f, 0.33767f};
  const glm::vec3 white = readExr(coloured({1, 1, 1}, ap0)).layers.at("").at(0, 0);
  EXPECT_NEAR(0.212639 * white.x + 0.715169 * white.y + 0.072192 * white.z, 1.0, 1e-4);
  EXPECT_GT(white.x, white.z) << "D60 is warmer than D65";
}

TEST_F(ExrFrameTest, Rec709KeepsEveryBit) {
  const glm::vec3 colour(0.1f, 1e-30f, 3e38f);
  const LayeredImage image =
      readExr(coloured(colour, {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f}));
  EXPECT_EQ(image.layers.at("").at(2, 1), colour);
  EXPECT_TRUE(image.notes.empty());
}

TEST_F(ExrFrameTest, ChromaticitiesThatAreNoColoursAreAnError) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  struct Case {
    std::array<float, 8> xy;
    const char* right;
  };
  const Case cases[] = {
      {{nan, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f}, "numbers"},
      {{0.64f, 0.33f, 0.3f, infinity, 0.15f, 0.06f, 0.3127f, 0.329f}, "numbers"},
      {{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.0f}, "white with light"},
      {{0, 0, 0, 0, 0, 0, 0, 0}, "white with light"},
      {{0.1f, 0.1f, 0.2f, 0.2f, 0.3f, 0.3f, 0.3127f, 0.329f}, "on a line"},
      {{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.47f, 0.465f}, "some of each primary"}};
  for (const Case& one : cases) {
    const std::string line = errorLine([&] { readExr(coloured({1, 1, 1}, one.xy)); });
    EXPECT_NE(line.find("'chromaticities' has red"), std::string::npos) << line;
    EXPECT_NE(line.find(one.right), std::string::npos) << line;
  }
}

TEST_F(ExrFrameTest, NormalsAndLuminanceAreNotConverted) {
  std::vector<ForeignChannel> channels = rgb({0, 0, 1});
  for (const char* name : {"normal.R", "normal.G", "normal.B", "grey.Y"})
    channels.push_back({name, Imf::FLOAT, 0.5f});
  writeMixed(path("n.exr"), window_, window_, channels, [](Imf::Header& header) {
    Imf::addChromaticities(header, Imf::Chromaticities({1, 0}, {0, 1}, {0, 0}, {0.3f, 0.3f}));
  });
  ExrSelection wanted(ExrLayers::all);
  wanted.data = {"normal"};
  const LayeredImage image = readExr(path("n.exr"), wanted);
  EXPECT_EQ(image.layers.at("normal").at(0, 0), glm::vec3(0.5f));
  EXPECT_EQ(image.layers.at("grey").at(0, 0), glm::vec3(0.5f));
  EXPECT_NE(image.layers.at("").at(0, 0), glm::vec3(0, 0, 1));
}

TEST_F(ExrFrameTest, WindowsAndPixelsOfAFileAreKept) {
  writeMixed(path("w.exr"), box(0, 0, 9, 9), box(-2, 3, 4, 5), rgb({1, 2, 3}),
             [](Imf::Header& header) { header.pixelAspectRatio() = 2.0f; });
  EXPECT_EQ(readExrContents(path("w.exr")).window, (PixelWindow{{-2, 3}, 7, 3}));
  LayeredImage image = readExr(path("w.exr"));
  EXPECT_EQ(image.layers.at("").origin, glm::ivec2(-2, 3));
  writeExr(path("again.exr"), image);
  const LayeredImage again = readExr(path("again.exr"));
  EXPECT_EQ(again.frame.origin, glm::ivec2(-2, 3));
  EXPECT_EQ(again.frame.display, glm::ivec4(0, 0, 9, 9));
  EXPECT_EQ(again.frame.pixelAspectRatio, 2.0f);
  EXPECT_EQ(again.layers.at("").pixels, image.layers.at("").pixels);
}

TEST_F(ExrFrameTest, ChannelsThatNobodyAskedForAreNotOpened) {
  std::vector<ForeignChannel> channels = rgb({1, 2, 3});
  for (const char* name : {"A", "id.R", "id.G", "id.B", "crypto.id"})
    channels.push_back({name, Imf::UINT, 7.0f});
  channels.push_back({"proxy.Y", Imf::FLOAT, 1.0f, 2});
  writeMixed(path("m.exr"), box(0, 0, 3, 1), box(0, 0, 3, 1), channels);
  const LayeredImage image = readExr(path("m.exr"), {ExrLayers::colours, {"", "absent"}});
  ASSERT_EQ(image.layers.size(), 1u);
  EXPECT_EQ(image.layers.at("").at(3, 1), glm::vec3(1, 2, 3));
  EXPECT_TRUE(readExr(path("m.exr"), {ExrLayers::colours, {"absent"}}).layers.empty());
  const auto read = [&](const char* layer) {
    return errorLine([&] { readExr(path("m.exr"), {ExrLayers::colours, {layer}}); });
  };
  EXPECT_NE(read("id").find("id.R holds integers"), std::string::npos);
  EXPECT_NE(read("proxy").find("proxy.Y is subsampled"), std::string::npos);
}

}  // namespace
}  // namespace restlab
