// restlab denoise: layers, sequences, windows and errors.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <list>
#include <vector>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {
namespace {

class DenoiseTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    ASSERT_EQ(run("render cornell-box -o noisy.exr --resolution 48x48 "
                  "--aov normalW,albedo,depth,emission")
                  .code,
              0);
    ASSERT_EQ(run("render cornell-box -o right.exr --resolution 48x48 --spp 256").code, 0);
  }
  // Skips the lamp, whose edge pixels depend on the film samples.
  double errorOf(const std::string& name) const {
    const Image image = readExr(path(name)).layers.at("");
    const Image right = readExr(path("right.exr")).layers.at("");
    double sum = 0.0, pixels = 0.0;
    for (size_t p = 0; p < image.pixels.size(); ++p) {
      if (p / right.width < right.height / 3) continue;
      sum += std::pow(double(image.pixels[p].y) - right.pixels[p].y, 2.0);
      pixels += 1.0;
    }
    return sum / pixels;
  }
  LayeredImage noisy() const { return readExr(path("noisy.exr")); }
};

// Adds a channel of integers to a file, as other programs write them.
void addIntegers(const std::filesystem::path& file, const char* channel) {
  std::list<std::vector<uint32_t>> words;
  Imf::FrameBuffer frame;
  Imf::Header header;
  {
    Imf::InputFile input(file.c_str());
    header = input.header();
    const Imath::Box2i data = header.dataWindow();
    const size_t width = size_t(data.max.x - data.min.x + 1);
    const auto add = [&](const char* name, Imf::PixelType type) {
      words.emplace_back(width * size_t(data.max.y - data.min.y + 1), 7u);
      frame.insert(name, Imf::Slice::Make(type, words.back().data(), data, 4, 4 * width));
    };
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
      add(it.name(), Imf::FLOAT);
    input.setFrameBuffer(frame);
    input.readPixels(data.min.y, data.max.y);
    add(channel, Imf::UINT);
  }
  header.channels().insert(channel, Imf::Channel(Imf::UINT));
  Imf::OutputFile output(file.c_str(), header);
  output.setFrameBuffer(frame);
  output.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
}

TEST_F(DenoiseTest, LayersOfARenderedImageLowerItsError) {
  for (const char* denoiser : {"atrous", "svgf"}) {
    const ProgramResult result =
        run(std::string("denoise noisy.exr -o clean.exr --denoiser ") + denoiser);
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.err.find("no layer for motion: nothing has moved"), std::string::npos);
    EXPECT_LT(errorOf("clean.exr"), 0.3 * errorOf("noisy.exr")) << denoiser;
    EXPECT_EQ(readExr(path("clean.exr")).metadata.at("denoiser"), denoiser);
  }
}

TEST_F(DenoiseTest, LayersOfOthersHaveTheirNames) {
  LayeredImage other = noisy();
  for (const auto& [ours, theirs] : {std::pair{"normalW", "shading.n"}, {"depth", "far"}}) {
    other.layers[theirs] = other.layers.at(ours);
    other.layers.erase(ours);
  }
  writeExr(path("other.exr"), other);
  expectError(run("denoise other.exr -o b.exr"), 3, {"other.exr", "normal", "--layers normal="});
  expectError(run("denoise other.exr -o b.exr --layers normal=shading.n,depth=fat"), 3,
              {"fat", "did you mean 'far'"});
  expectError(run("denoise other.exr -o b.exr --layers norml=far"), 2, {"norml", "normal"});
  ASSERT_EQ(run("denoise other.exr -o b.exr --layers normal=shading.n,depth=far").code, 0);
  ASSERT_EQ(run("denoise noisy.exr -o a.exr").code, 0);
  EXPECT_EQ(readExr(path("a.exr")).layers.at("").pixels,
            readExr(path("b.exr")).layers.at("").pixels);
}

// Without albedo a texture counts as noise. A required layer cannot be left out.
TEST_F(DenoiseTest, LayersAreLeftOut) {
  ASSERT_EQ(run("denoise noisy.exr -o a.exr --set demodulate=none").code, 0);
  ASSERT_EQ(run("denoise noisy.exr -o b.exr --layers albedo=").code, 0);
  EXPECT_EQ(readExr(path("a.exr")).layers.at("").pixels,
            readExr(path("b.exr")).layers.at("").pixels);
  expectError(run("denoise noisy.exr -o c.exr --layers normal="), 2, {"normal", "left out"});
  const ProgramResult result = run("denoise noisy.exr -o c.exr --set svgf_resolve=4");
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.err.find("svgf_resolve has no effect"), std::string::npos) << result.err;
  const ProgramResult other = run("denoise noisy.exr -o c.exr --denoiser asvgf");
  EXPECT_EQ(other.code, 0);
  EXPECT_NE(other.err.find("light that changes is not found"), std::string::npos) << other.err;
}

// A motion layer finds pixels that have moved by three.
TEST_F(DenoiseTest, ASequenceFollowsItsMotion) {
  const auto shifted = [](const Image& image, uint32_t by) {
    Image moved = image;
    for (uint32_t y = 0; y < image.height; ++y) {
      for (uint32_t x = 0; x < image.width; ++x)
        moved.pixels[size_t(y) * image.width + x] =
            image.pixels[size_t(y) * image.width + (x + by) % image.width];
    }
    return moved;
  };
  for (uint32_t i = 0; i < 6; ++i) {
    const std::string name = "still-" + std::to_string(i) + ".exr";
    ASSERT_EQ(run("render cornell-box --resolution 48x48 --aov normalW,albedo,depth,emission "
                  "--seed " +
                  std::to_string(i + 1) + " -o " + name)
                  .code,
              0);
    LayeredImage image = readExr(path(name));
    for (auto& [layer, pixels] : image.layers) pixels = shifted(pixels, 3 * i);
    writeExr(path("blind-" + std::to_string(i) + ".exr"), image);
    image.layers["motion"] = image.layers.at("");
    for (glm::vec3& pixel : image.layers.at("motion").pixels) pixel = glm::vec3(3.0F, 0.0F, 0.0F);
    writeExr(path("moving-" + std::to_string(i) + ".exr"), image);
  }
  for (const char* name : {"still", "blind", "moving"}) {
    const std::string files = name;
    ASSERT_EQ(run("denoise " + files + "-#.exr -o clean-" + files + "-#.exr").code, 0);
  }
  const Image right = shifted(readExr(path("clean-still-5.exr")).layers.at(""), 15);
  const auto differs = [&](const char* name) {
    const Image image = readExr(path(name)).layers.at("");
    double sum = 0.0;
    // Only columns that are in view in all frames.
    for (uint32_t y = 0; y < image.height; ++y) {
      for (uint32_t x = 0; x + 16 < image.width; ++x) {
        const size_t p = size_t(y) * image.width + x;
        sum += std::abs(double(image.pixels[p].y) - right.pixels[p].y);
      }
    }
    return sum;
  };
  EXPECT_LT(differs("clean-moving-5.exr"), 0.3 * differs("clean-blind-5.exr"));
}

// Frames of a sequence are one history; without its wavelets svgf only accumulates.
TEST_F(DenoiseTest, ASequenceIsDenoisedInOrder) {
  for (int i = 8; i < 13; ++i) {
    const std::string name = "frame-" + std::to_string(1000 + i).substr(1) + ".exr";
    ASSERT_EQ(run("render cornell-box --resolution 48x48 --aov normalW,albedo,depth,emission "
                  "--seed " +
                  std::to_string(i) + " -o " + name)
                  .code,
              0);
  }
  ASSERT_EQ(run("denoise frame-###.exr -o clean-###.exr --set svgf_iterations=0").code, 0);
  EXPECT_LT(errorOf("clean-012.exr"), 0.4 * errorOf("clean-008.exr"));
  std::filesystem::remove(path("frame-010.exr"));
  expectError(run("denoise frame-###.exr -o again-###.exr"), 3, {"frame-010.exr", "missing"});
  EXPECT_FALSE(std::filesystem::exists(path("again-008.exr")));
}

// Keeps the window of a part of a larger picture, and ignores integer channels.
TEST_F(DenoiseTest, WindowsAreKeptAndOtherChannelsLeftAlone) {
  LayeredImage image = noisy();
  image.frame.origin = {5, 3};
  image.frame.display = {0, 0, 99, 79};
  image.frame.pixelAspectRatio = 1.5f;
  writeExr(path("part.exr"), image);
  addIntegers(path("part.exr"), "object_id");
  const ProgramResult result = run("denoise part.exr -o clean.exr");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("its pixelAspectRatio is 1.5"), std::string::npos) << result.err;
  const LayeredImage clean = readExr(path("clean.exr"));
  EXPECT_EQ(clean.frame.origin, glm::ivec2(5, 3));
  EXPECT_EQ(clean.frame.display, glm::ivec4(0, 0, 99, 79));
  EXPECT_EQ(clean.frame.pixelAspectRatio, 1.5f);
  ASSERT_EQ(run("denoise noisy.exr -o whole.exr").code, 0);
  EXPECT_EQ(clean.layers.at("").pixels, readExr(path("whole.exr")).layers.at("").pixels);
  // All frames of a sequence must have one window.
  writeExr(path("p-1.exr"), noisy());
  writeExr(path("p-2.exr"), image);
  expectError(run("denoise p-#.exr -o q-#.exr"), 3, {"p-2.exr: is 48x48 from pixel (5, 3) on"});
}

// An output with another pattern may be the input of a later frame.
TEST_F(DenoiseTest, NoInputIsWrittenOver) {
  for (const char* name : {"a-9.exr", "a-10.exr"})
    std::filesystem::copy_file(path("noisy.exr"), path(name));
  expectError(run("denoise a-#.exr -o a-##.exr"), 2, {"a-10.exr", "is an input"});
  EXPECT_FALSE(std::filesystem::exists(path("a-09.exr")));
}

TEST_F(DenoiseTest, FramesOfASequenceAreAlike) {
  ASSERT_EQ(run("render cornell-box --resolution 16x16 --aov normalW,depth -o b-2.exr").code, 0);
  ASSERT_EQ(run("render cornell-box --resolution 16x16 --aov normalW,depth,albedo -o b-1.exr").code,
            0);
  const ProgramResult finished = run("denoise b-#.exr -o c-#.exr");
  EXPECT_EQ(finished.code, 0);
  EXPECT_NE(finished.err.find("b-2.exr: no layer for albedo"), std::string::npos) << finished.err;
  ASSERT_EQ(run("render cornell-box --resolution 16x8 --aov normalW,depth -o b-2.exr").code, 0);
  expectError(run("denoise b-#.exr -o c-#.exr"), 3, {"b-2.exr", "16x8", "16x16"});
}

// Other programs prefix layers with the name of a view.
TEST_F(DenoiseTest, LayersAreFoundAfterAPrefix) {
  LayeredImage other;
  for (const auto& [name, layer] : noisy().layers)
    other.layers["View." + (name.empty() ? "Combined" : name)] = layer;
  writeExr(path("other.exr"), other);
  ASSERT_EQ(run("denoise other.exr -o b.exr").code, 0);
  ASSERT_EQ(run("denoise noisy.exr -o a.exr").code, 0);
  EXPECT_EQ(readExr(path("a.exr")).layers.at("").pixels,
            readExr(path("b.exr")).layers.at("").pixels);
  other.layers["Second.normalW"] = other.layers.at("View.normalW");
  writeExr(path("other.exr"), other);
  expectError(run("denoise other.exr -o b.exr"), 3,
              {"more than one layer for normal", "Second.normalW", "View.normalW"});
}

// Nothing is written if a later frame lacks a layer.
TEST_F(DenoiseTest, AllFramesAreLookedAtFirst) {
  std::filesystem::copy_file(path("noisy.exr"), path("d-1.exr"));
  LayeredImage later = noisy();
  later.layers.erase("depth");
  writeExr(path("d-2.exr"), later);
  expectError(run("denoise d-#.exr -o e-#.exr"), 3, {"d-2.exr", "no layer for depth"});
  EXPECT_FALSE(std::filesystem::exists(path("e-1.exr")));
}

TEST_F(DenoiseTest, TheFileSaysWhatWasDone) {
  ASSERT_EQ(run("denoise noisy.exr -o a.exr --png --set svgf_cap=7").code, 0);
  const auto before = noisy().metadata, after = readExr(path("a.exr")).metadata;
  EXPECT_EQ(after.at("input"), "noisy.exr");
  EXPECT_EQ(after.at("parameter.svgf_cap"), "7");
  EXPECT_EQ(after.at("scene"), before.at("scene"));
  EXPECT_NE(after.at("command").find("denoise"), std::string::npos) << after.at("command");
  EXPECT_NE(before.at("command").find("render"), std::string::npos);
  EXPECT_TRUE(after.contains("denoiser_health") && after.contains("denoiser_time_s"));
  EXPECT_TRUE(std::filesystem::exists(path("a.png")));
}

// Only svgf_restir needs to know over how many frames the radiance was averaged.
TEST_F(DenoiseTest, RadianceFramesAreNotIgnoredInSilence) {
  const auto says = [&](const std::string& arguments, const char* text) {
    const ProgramResult result = run("denoise noisy.exr -o a.exr " + arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.err.find(text) != std::string::npos;
  };
  EXPECT_TRUE(says("--radiance-frames 4", "--radiance-frames has no effect"));
  EXPECT_FALSE(says("", "radiance-frames"));
  EXPECT_TRUE(says("--denoiser svgf_restir", "without --radiance-frames"));
  EXPECT_FALSE(says("--denoiser svgf_restir --radiance-frames 4", "radiance-frames"));
}

TEST_F(DenoiseTest, WhatIsWrongIsSaid) {
  expectError(run("denoise noisy.exr -o noisy.exr"), 2, {"is an input"});
  expectError(run("denoise " + path("noisy.exr").string() + " -o ./noisy.exr"), 2, {"is an input"});
  expectError(run("denoise noisy.exr -o clean.png"), 2, {"clean.png", "*.exr"});
  expectError(run("denoise noisy.exr -o clean-#.exr"), 2, {"#"});
  expectError(run("denoise a-##.exr -o clean-##.exr"), 3, {"a-##.exr", "no such files"});
  expectError(run("denoise absent.exr -o clean.exr"), 3, {"absent.exr", "no such file"});
  expectError(run("denoise noisy.exr -o clean.exr --denoiser svgff"), 2, {"svgff", "svgf"});
  expectError(run("denoise noisy.exr -o clean.exr --set svgf_kap=3"), 2, {"svgf_kap", "svgf_cap"});
  expectError(run("denoise noisy.exr -o clean.exr --denoiser accumulate"), 2,
              {"accumulate", "asks the scene", "svgf"});
  expectError(run("denoise noisy.exr -o clean.exr --denoiser asvgf --set validate_every=4"), 2,
              {"validate_every", "image"});
  expectError(run("denoise noisy.exr -o clean.exr --layers depth"), 2, {"depth=NAME"});
  EXPECT_FALSE(std::filesystem::exists(path("clean.exr")));
}

}  // namespace
}  // namespace restlab::cli_test
