// OpenEXR and PNG files: round trips, foreign files, damaged files, outputs that cannot be written.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/error.h"
#include "core/image/atomic_file.h"
#include "core/image/image.h"
#include "core/image/metrics.h"

namespace restlab {
namespace {

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

// Distinct, awkward values: negative, denormal, beyond half's range, infinite, NaN.
Image testImage(uint32_t width, uint32_t height, float seed = 0.5f) {
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

bool sameBits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

// The line of the Error that `action` must throw.
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

std::string readBytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void writeBytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

// Writes channels of one value each with OpenEXR itself, as another program would.
void writeForeign(const fs::path& file, const Imath::Box2i& display, const Imath::Box2i& data,
                  const std::map<std::string, float>& channels, Imf::PixelType type,
                  Imf::Compression compression = Imf::ZIP_COMPRESSION, bool tiled = false) {
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

Imath::Box2i box(int x0, int y0, int x1, int y1) { return {{x0, y0}, {x1, y1}}; }

TEST_F(ExrTest, RoundTripKeepsEveryBitOfEveryLayer) {
  LayeredImage image;
  image.layers[""] = testImage(37, 21);
  image.layers["half0"] = testImage(37, 21, 0.7f);
  image.layers["view.normalW"] = testImage(37, 21, 0.9f);
  image.metadata["integrator"] = "path";
  image.metadata["a key that is much longer than thirty-one characters"] = "with\nlines, \"quotes\"";
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

TEST_F(ExrTest, SymbolicLinkIsFollowed) {
  fs::create_directory(path("elsewhere"));
  writeTextFile(path("elsewhere/real.exr"), "old");
  fs::create_symlink(path("elsewhere/real.exr"), path("link.exr"));
  LayeredImage image;
  image.layers[""] = Image(2, 2, glm::vec3(1.0f));
  writeExr(path("link.exr"), image);
  EXPECT_TRUE(fs::is_symlink(path("link.exr")));
  EXPECT_EQ(readExr(path("elsewhere/real.exr")).layers.at("").width, 2u);
}

TEST_F(ExrTest, ReadsHalfOffsetWindowsTilesAndLuminance) {
  const std::map<std::string, float> rgb = {{"R", 0.25f}, {"G", 0.5f}, {"B", 1.0f}, {"A", 0.5f}};
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::PIZ_COMPRESSION,
        Imf::PXR24_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAB_COMPRESSION}) {
    for (const bool tiled : {false, true}) {
      writeForeign(path("h.exr"), box(0, 0, 99, 99), box(-7, 5, 12, 34), rgb, Imf::HALF, compression,
                   tiled);
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
               {{"R", 1}, {"G", 2}, {"B", 3}, {"N.X", 4}, {"N.Y", 5}, {"N.Z", 6}, {"Z", 7}},
               Imf::FLOAT);
  const LayeredImage read = readExr(path("n.exr"));
  ASSERT_EQ(read.layers.size(), 1u);
  EXPECT_EQ(read.layers.at("").at(0, 0), glm::vec3(1, 2, 3));
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

TEST_F(ExrTest, TruncatedAnywhereIsOneLine) {
  LayeredImage image;
  image.layers[""] = testImage(64, 48);
  image.layers["variance"] = testImage(64, 48, 0.3f);
  image.metadata["note"] = std::string(300, 'x');
  writeExr(path("whole.exr"), image);
  writeForeign(path("tiles.exr"), box(0, 0, 63, 47), box(0, 0, 63, 47),
               {{"R", 1}, {"G", 2}, {"B", 3}}, Imf::HALF, Imf::PIZ_COMPRESSION, true);
  for (const char* name : {"whole.exr", "tiles.exr"}) {
    const std::string bytes = readBytes(path(name));
    for (size_t part = 0; part < 16; ++part) {
      const fs::path file = path("cut-" + std::to_string(part) + ".exr");
      writeBytes(file, bytes.substr(0, bytes.size() * part / 16));
      const std::string line = errorLine([&] { readExr(file); });
      EXPECT_EQ(line.rfind(file.string() + ": ", 0), 0u) << line;
    }
    writeBytes(path("cut.exr"), bytes.substr(0, bytes.size() - 1));
    errorLine([&] { readExr(path("cut.exr")); });
  }
}

TEST_F(ExrTest, FlippedBytesNeverCrash) {
  LayeredImage image;
  // Smooth, hence stored compressed and with a checksum.
  image.layers[""] = Image(32, 16);
  for (uint32_t x = 0; x < 32; ++x) image.layers[""].at(x, x % 16) = glm::vec3(float(x));
  image.metadata["note"] = "text";
  writeExr(path("whole.exr"), image);
  const std::string bytes = readBytes(path("whole.exr"));
  size_t refused = 0;
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (const int flip : {0xff, 0x80, 0x01}) {
      std::string damaged = bytes;
      damaged[i] = char(damaged[i] ^ flip);
      writeBytes(path("damaged.exr"), damaged);
      try {
        const LayeredImage read = readExr(path("damaged.exr"));
        for (const auto& [name, layer] : read.layers) {
          ASSERT_EQ(layer.pixels.size(), size_t(layer.width) * layer.height);
        }
      } catch (const Error& error) {
        ASSERT_EQ(int(error.code()), int(ExitCode::badInput));
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, bytes.size());  // text, windows and chromaticities cannot be checked
}

// Where the value of a header's attribute begins.
size_t attributeValue(const std::string& bytes, const std::string& name, const std::string& type) {
  const std::string key = name + '\0' + type + '\0';
  const size_t at = bytes.find(key);
  EXPECT_NE(at, std::string::npos);
  return at + key.size() + 4;
}

void putInt(std::string& bytes, size_t at, int32_t value) { std::memcpy(&bytes[at], &value, 4); }

TEST_F(ExrTest, LyingHeadersAreRefusedBeforeAllocation) {
  LayeredImage image;
  image.layers[""] = testImage(16, 16);
  image.metadata["note"] = "text";
  writeExr(path("whole.exr"), image);
  const std::string bytes = readBytes(path("whole.exr"));
  const size_t window = attributeValue(bytes, "dataWindow", "box2i");
  struct Lie {
    int32_t xMax, yMax;
    const char* what;
  };
  const Lie lies[] = {{1 << 30, 1 << 30, "data window"},   {32768, 15, "data window"},
                      {15, 0x7fffffff, "data window"},     {-1, 15, "data window"},
                      {15, -2000000000, "data window"},    {32767, 32767, "data window"},
                      {16383, 16383, "too few"},           {32767, 8191, "too few"}};
  // The address space is the witness: 3 GiB of pixels would not fit.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  rlimit tight = before;
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  tight.rlim_cur = pages * rlim_t(::sysconf(_SC_PAGESIZE)) + (rlim_t(1) << 29);
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &tight), 0);
#endif
  for (const Lie& lie : lies) {
    std::string lying = bytes;
    putInt(lying, window + 8, lie.xMax);
    putInt(lying, window + 12, lie.yMax);
    writeBytes(path("lie.exr"), lying);
    const std::string line = errorLine([&] { readExr(path("lie.exr")); });
    const bool named = line.find(lie.what) != std::string::npos ||
                       line.find("truncated") != std::string::npos ||
                       line.find("cannot be read") != std::string::npos;
    EXPECT_TRUE(named) << line;
    EXPECT_EQ(line.find("memory"), std::string::npos) << line;
  }
  // An attribute that claims 2 GiB.
  std::string lying = bytes;
  putInt(lying, attributeValue(bytes, "restlab:note", "string") - 4, 0x7ffffff0);
  writeBytes(path("lie.exr"), lying);
  EXPECT_NE(errorLine([&] { readExr(path("lie.exr")); }).find("restlab:note"), std::string::npos);
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
}

TEST_F(ExrTest, NotAnImage) {
  EXPECT_NE(errorLine([&] { readExr(path("absent.exr")); }).find("no such file"),
            std::string::npos);
  EXPECT_NE(errorLine([&] { readExr(directory_); }).find("not a regular file"), std::string::npos);
  writeBytes(path("empty.exr"), "");
  errorLine([&] { readExr(path("empty.exr")); });
  writeBytes(path("text.exr"), "this is no image, but it is longer than any magic number");
  EXPECT_NE(errorLine([&] { readExr(path("text.exr")); }).find("not an OpenEXR image"),
            std::string::npos);
}

TEST_F(ExrTest, ImagesThatCannotBeWritten) {
  LayeredImage none;
  errorLine([&] { writeExr(path("a.exr"), none); });
  LayeredImage empty;
  empty.layers[""] = Image();
  errorLine([&] { writeExr(path("a.exr"), empty); });
  LayeredImage unequal;
  unequal.layers[""] = Image(2, 2);
  unequal.layers["x"] = Image(2, 3);
  EXPECT_NE(errorLine([&] { writeExr(path("a.exr"), unequal); }).find("'x' is 2x3"),
            std::string::npos);
  LayeredImage inconsistent;
  inconsistent.layers[""] = Image(2, 2);
  inconsistent.layers[""].pixels.resize(3);
  errorLine([&] { writeExr(path("a.exr"), inconsistent); });
  errorLine([&] { writePng(path("a.png"), Image()); });
  EXPECT_EQ(filesInDirectory(), 0u);
}

TEST_F(ExrTest, OutputsThatCannotBeCreated) {
  LayeredImage image;
  image.layers[""] = Image(2, 2);
  writeTextFile(path("file"), "");
  for (const fs::path& output :
       {directory_, path("absent/a.exr"), path("file/a.exr"), fs::path("/dev/null"), fs::path(),
        path(""), path(std::string(300, 'n') + ".exr"), fs::path("/proc/a.exr")}) {
    errorLine([&] { checkWritable(output); });
    errorLine([&] { writeExr(output, image); });
    errorLine([&] { writePng(output, image.layers.at("")); });
  }
  if (::geteuid() != 0) {  // root may write anywhere
    fs::create_directory(path("locked"));
    fs::permissions(path("locked"), fs::perms::owner_read | fs::perms::owner_exec);
    errorLine([&] { checkWritable(path("locked/a.exr")); });
    fs::permissions(path("locked"), fs::perms::owner_all);
    fs::remove(path("locked"));
  }
  checkWritable(path("fine.exr"));
  EXPECT_EQ(filesInDirectory(), 1u) << "checkWritable left something behind";
}

TEST_F(ExrTest, FullDiskLeavesTheOldFile) {
  LayeredImage small;
  small.layers[""] = Image(2, 2, glm::vec3(1.0f));
  writeExr(path("a.exr"), small);
  LayeredImage large;
  large.layers[""] = testImage(256, 256);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  for (const rlim_t limit : {rlim_t(100), rlim_t(5000), rlim_t(100000)}) {
    rlimit tight = before;
    tight.rlim_cur = limit;
    auto* oldHandler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
    const std::string line = errorLine([&] { writeExr(path("a.exr"), large); });
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, oldHandler);
    EXPECT_NE(line.find("a.exr: cannot be written"), std::string::npos) << line;
    EXPECT_EQ(readExr(path("a.exr")).layers.at("").width, 2u);
    EXPECT_EQ(filesInDirectory(), 1u);
  }
}

TEST_F(ExrTest, PngIsWrittenWhole) {
  Image image(3, 2, glm::vec3(0.5f));
  image.at(1, 0).y = std::numeric_limits<float>::quiet_NaN();
  image.at(2, 1).x = -std::numeric_limits<float>::infinity();
  writePng(path("a.png"), image, 2.0f);
  const std::string bytes = readBytes(path("a.png"));
  ASSERT_GT(bytes.size(), 40u);
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_EQ(uint8_t(bytes[19]), 3);  // width and height of IHDR
  EXPECT_EQ(uint8_t(bytes[23]), 2);
  EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND");
  EXPECT_EQ(filesInDirectory(), 1u);
}

// The reference images that come with the real scenes.
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
    const glm::dvec3 means = channelMeans(readExr(gates / "cornell-d8/reference.exr").layers.at(""));
    EXPECT_NEAR(means.x, 0.19590, 5e-6);
    EXPECT_NEAR(means.y, 0.12730, 5e-6);
    EXPECT_NEAR(means.z, 0.03641, 5e-6);
  }
}

}  // namespace
}  // namespace restlab
