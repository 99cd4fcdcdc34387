// OpenEXR files: round trips, files of other programs, the references of the real scenes.
#include <algorithm>
#include <cstring>

#include "core/image/io/exr_contents.h"
#include "core/image/metrics/metrics.h"
#include "tests/image/exr_fixture.h"

namespace restlab {
namespace {

bool sameBits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

TEST_F(ExrTest, RoundTripKeepsEveryBitOfEveryLayer) {
  LayeredImage image;
  image.layers[""] = testImage(37, 21);
  image.layers["half0"] = testImage(37, 21, 0.7f);
  image.layers["view.normalW"] = testImage(37, 21, 0.9f);
  image.metadata["integrator"] = "path";
  image.metadata["a key that is much longer than thirty-one characters"] =
      "with\nlines, \"quotes\"";
  image.metadata["empty"] = "";
  writeExr(path("a.exr"), image);
  const LayeredImage read = readExr(path("a.exr"));
  EXPECT_EQ(read.metadata, image.metadata);
  ASSERT_EQ(read.layers.size(), 3u);
  for (const auto& [name, layer] : image.layers) {
    EXPECT_TRUE(sameBits(read.layers.at(name), layer)) << "layer '" << name << "'";
  }
  EXPECT_EQ(filesInDirectory(), 1u) << "a temporary file was left behind";
}

TEST_F(ExrTest, OnePixelAndOverwriting) {
  LayeredImage image;
  image.layers[""] = Image(1, 1, glm::vec3(2.0f));
  writeExr(path("a.exr"), image);
  image.layers[""] = Image(1, 1, glm::vec3(3.0f));
  writeExr(path("a.exr"), image);
  EXPECT_EQ(readExr(path("a.exr")).layers.at("").at(0, 0).y, 3.0f);
}

TEST_F(ExrTest, ReadsHalfOffsetWindowsTilesAndLuminance) {
  const std::map<std::string, float> rgb = {{"R", 0.25f}, {"G", 0.5f}, {"B", 1.0f}, {"A", 0.5f}};
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::PIZ_COMPRESSION,
        Imf::PXR24_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAB_COMPRESSION}) {
    for (const bool tiled : {false, true}) {
      writeForeign(path("h.exr"), box(0, 0, 99, 99), box(-7, 5, 12, 34), rgb, Imf::HALF,
                   compression, tiled);
      const LayeredImage read = readExr(path("h.exr"));
      ASSERT_EQ(read.layers.size(), 1u);
      const Image& image = read.layers.at("");
      ASSERT_EQ(image.width, 20u);
      ASSERT_EQ(image.height, 30u);
      for (const glm::vec3& pixel : image.pixels) {
        ASSERT_NEAR(pixel.x, 0.25f, 1e-3f);
        ASSERT_NEAR(pixel.y, 0.5f, 1e-3f);
        ASSERT_NEAR(pixel.z, 1.0f, 1e-3f);
      }
    }
  }
  writeForeign(path("y.exr"), box(0, 0, 4, 3), box(0, 0, 4, 3), {{"Y", 0.375f}}, Imf::FLOAT);
  EXPECT_EQ(readExr(path("y.exr")).layers.at("").at(4, 3), glm::vec3(0.375f));
  // A position beside the colour is no luminance; depth is no colour.
  writeForeign(path("n.exr"), box(0, 0, 4, 3), box(0, 0, 4, 3),
               {{"R", 1},
                {"G", 2},
                {"B", 3},
                {"N.X", 4},
                {"N.Y", 5},
                {"N.Z", 6},
                {"Z", 7},
                {"motion.X", 8},
                {"motion.Y", 9}},
               Imf::FLOAT);
  const LayeredImage read = readExr(path("n.exr"));
  ASSERT_EQ(read.layers.size(), 1u);
  EXPECT_EQ(read.layers.at("").at(0, 0), glm::vec3(1, 2, 3));
  // ExrLayers::all includes them.
  const LayeredImage all = readExr(path("n.exr"), ExrLayers::all);
  ASSERT_EQ(all.layers.size(), 4u);
  EXPECT_EQ(all.layers.at("N").at(0, 0), glm::vec3(4, 5, 6));
  EXPECT_EQ(all.layers.at("Z").at(0, 0), glm::vec3(7));
  EXPECT_EQ(all.layers.at("motion").at(4, 3), glm::vec3(8, 9, 0)) << "a vector on the film";
  // The header alone gives the same layers.
  const ExrContents contents = readExrContents(path("n.exr"), ExrLayers::all);
  EXPECT_EQ(contents.layers, (std::vector<std::string>{"", "N", "Z", "motion"}));
  EXPECT_EQ(contents.window.width, 5u);
  EXPECT_EQ(contents.window.height, 4u);
  EXPECT_EQ(readExrContents(path("n.exr")).layers, std::vector<std::string>{""});
}

TEST_F(ExrTest, RowZeroIsTheTopWhateverTheWindow) {
  Imf::Header header(box(0, 0, 9, 9), box(2, 3, 2, 4));
  const float values[2] = {10.0f, 20.0f};
  Imf::FrameBuffer frame;
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values, header.dataWindow(), 4, 4));
  }
  {
    Imf::OutputFile output(path("w.exr").c_str(), header);
    output.setFrameBuffer(frame);
    output.writePixels(2);
  }
  const Image image = readExr(path("w.exr")).layers.at("");
  EXPECT_EQ(image.at(0, 0).x, 10.0f);
  EXPECT_EQ(image.at(0, 1).x, 20.0f);
}

TEST_F(ExrTest, ForeignChannelsThatCannotBeReadAreNamed) {
  const Imath::Box2i window = box(0, 0, 3, 3);
  writeForeign(path("u.exr"), window, window, {{"R", 1}, {"G", 2}, {"B", 3}}, Imf::UINT);
  EXPECT_NE(errorLine([&] { readExr(path("u.exr")); }).find("holds integers"), std::string::npos);
  writeForeign(path("d.exr"), window, window, {{"Z", 1}, {"R", 1}}, Imf::FLOAT);
  const std::string line = errorLine([&] { readExr(path("d.exr")); });
  EXPECT_NE(line.find("d.exr"), std::string::npos);
  EXPECT_NE(line.find("R, Z"), std::string::npos) << line;
}

// Folder of the real scenes with their reference images.
fs::path sceneFolder() {
  const char* given = std::getenv("RESTLAB_SCENES");
  return given != nullptr && *given != '\0' ? fs::path(given)
                                            : fs::path(RESTLAB_SOURCE_DIR) / "../shared/scenes";
}

TEST(RealReferences, AllAreReadAndPlausible) {
  const fs::path gates = sceneFolder() / "gates";
  if (!fs::is_directory(gates)) {
    GTEST_SKIP() << "SKIPPED: no real scenes at " << sceneFolder().string()
                 << " (set RESTLAB_SCENES)";
  }
  size_t count = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(gates)) {
    if (entry.path().extension() != ".exr") continue;
    ++count;
    const LayeredImage image = readExr(entry.path());
    for (const auto& [name, layer] : image.layers) {
      EXPECT_EQ(countNonfinite(layer), 0u) << entry.path() << " layer '" << name << "'";
      const glm::dvec3 means = channelMeans(layer);
      const bool isVariance = entry.path().stem().string().find("var") != std::string::npos;
      if (!isVariance) {
        EXPECT_GT(std::min({means.x, means.y, means.z}), 1e-3) << entry.path();
      }
      EXPECT_LT(std::max({means.x, means.y, means.z}), 1e3) << entry.path();
    }
  }
  EXPECT_GT(count, 0u) << gates;
  if (fs::exists(gates / "cornell-d8/reference.exr")) {
    const glm::dvec3 means =
        channelMeans(readExr(gates / "cornell-d8/reference.exr").layers.at(""));
    EXPECT_NEAR(means.x, 0.19590, 5e-6);
    EXPECT_NEAR(means.y, 0.12730, 5e-6);
    EXPECT_NEAR(means.z, 0.03641, 5e-6);
  }
}

}  // namespace
}  // namespace restlab
