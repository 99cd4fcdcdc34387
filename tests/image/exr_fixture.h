// Common parts of the image file tests: a temporary folder, awkward images, foreign and damaged
// files.
#pragma once

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/image/image.h"

namespace restlab {

namespace fs = std::filesystem;

class ExrTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "restlab-exr-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    directory_ = pattern;
  }
  void TearDown() override { fs::remove_all(directory_); }

  fs::path path(const std::string& name) const { return directory_ / name; }
  size_t filesInDirectory() const {
    return size_t(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()));
  }

  fs::path directory_;
};

// Image with distinct, awkward values: negative, denormal, beyond half's range, infinite, NaN.
inline Image testImage(uint32_t width, uint32_t height, float seed = 0.5f) {
  Image image(width, height);
  float value = seed;
  for (glm::vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      value = std::fmod(value * 1.37f + 0.11f * float(c) + 0.01f, 3.0f);
      pixel[c] = value;
    }
  }
  image.pixels[0] = {-1.5f, 1e-42f, 3e38f};
  image.pixels.back() = {std::numeric_limits<float>::infinity(), 0.0f,
                         std::numeric_limits<float>::quiet_NaN()};
  return image;
}

// Returns the line of the Error that `action` must throw.
template <class F>
std::string errorLine(F action, ExitCode code = ExitCode::badInput) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(int(error.code()), int(code)) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no Error was thrown";
  return "";
}

inline std::string readBytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void writeBytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

// Writes channels of one value each with OpenEXR itself, as another program would.
inline void writeForeign(const fs::path& file, const Imath::Box2i& display,
                         const Imath::Box2i& data, const std::map<std::string, float>& channels,
                         Imf::PixelType type, Imf::Compression compression = Imf::ZIP_COMPRESSION,
                         bool tiled = false) {
  Imf::Header header(display, data);
  header.compression() = compression;
  const size_t width = size_t(data.max.x - data.min.x + 1);
  const size_t height = size_t(data.max.y - data.min.y + 1);
  std::map<std::string, std::vector<float>> floats;
  std::map<std::string, std::vector<Imath::half>> halves;
  std::map<std::string, std::vector<uint32_t>> integers;
  Imf::FrameBuffer frame;
  for (const auto& [name, value] : channels) {
    header.channels().insert(name, Imf::Channel(type));
    void* memory;
    size_t size = 4;
    if (type == Imf::FLOAT) {
      memory = floats.emplace(name, std::vector<float>(width * height, value)).first->second.data();
    } else if (type == Imf::HALF) {
      memory = halves.emplace(name, std::vector<Imath::half>(width * height, Imath::half(value)))
                   .first->second.data();
      size = 2;
    } else {
      memory = integers.emplace(name, std::vector<uint32_t>(width * height, uint32_t(value)))
                   .first->second.data();
    }
    frame.insert(name, Imf::Slice::Make(type, memory, data, size, size * width));
  }
  if (tiled) {
    header.setTileDescription(Imf::TileDescription(8, 8, Imf::ONE_LEVEL));
    Imf::TiledOutputFile output(file.c_str(), header);
    output.setFrameBuffer(frame);
    output.writeTiles(0, output.numXTiles() - 1, 0, output.numYTiles() - 1);
  } else {
    Imf::OutputFile output(file.c_str(), header);
    output.setFrameBuffer(frame);
    output.writePixels(int(height));
  }
}

inline Imath::Box2i box(int x0, int y0, int x1, int y1) { return {{x0, y0}, {x1, y1}}; }

}  // namespace restlab
