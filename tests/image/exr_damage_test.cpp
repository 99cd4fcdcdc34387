// Damaged and false files: one line of error, no crash, no memory allocated from an unchecked
// header.
#include <sys/resource.h>
#include <unistd.h>

#include <cstring>

#include "tests/image/exr_fixture.h"

// Sanitizers reserve terabytes of address space: they allow no limit.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define RL_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define RL_SANITIZED 1
#endif
#endif
#ifndef RL_SANITIZED
#define RL_SANITIZED 0
#endif

namespace restlab {
namespace {

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
  // Smooth, so that the data are stored compressed and with a checksum.
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

// Position of the value of a header's attribute.
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
  const Lie lies[] = {{1 << 30, 1 << 30, "data window"}, {32768, 15, "data window"},
                      {15, 0x7fffffff, "data window"},   {-1, 15, "data window"},
                      {15, -2000000000, "data window"},  {32767, 32767, "data window"},
                      {16383, 16383, "too few"},         {32767, 8191, "too few"}};
  // Limit the address space: 3 GiB of pixels would not fit.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
#if !RL_SANITIZED
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
  // An attribute that claims 2 GiB, also at places that only OpenEXR would reach: inside a value
  // that claims more bytes than its type has, and after channels that continue beyond their size.
  std::string lying = bytes;
  putInt(lying, attributeValue(bytes, "restlab:note", "string") - 4, 0x7ffffff0);
  writeBytes(path("lie.exr"), lying);
  EXPECT_NE(errorLine([&] { readExr(path("lie.exr")); }).find("restlab:note"), std::string::npos);
  const auto attribute = [](const std::string& name, const std::string& type, uint32_t size,
                            const std::string& value) {
    std::string raw = name + '\0' + type + '\0' + std::string(4, '\0') + value;
    putInt(raw, name.size() + type.size() + 2, int32_t(size));
    return raw;
  };
  const std::string big = attribute("note", "string", 0x7ffffff0, "");
  const std::string channel = std::string("R") + '\0' + std::string(16, '\1');
  const size_t first = 8;  // behind the magic number and the version
  for (const std::string& hiding :
       {attribute("gain", "float", uint32_t(4 + big.size()), "1234" + big),
        attribute("weights", "floatvector", 7 + uint32_t(big.size()), "1234567" + big),
        attribute("more", "chlist", 1 + uint32_t(big.size()), '\0' + big),
        attribute("more", "chlist", uint32_t(channel.size()), channel + '\0' + big),
        attribute("more", "chlist", uint32_t(channel.size()), channel + channel)}) {
    lying = bytes;
    lying.insert(first, hiding);
    writeBytes(path("lie.exr"), lying);
    const std::string line = errorLine([&] { readExr(path("lie.exr")); });
    EXPECT_NE(line.find("bytes where"), std::string::npos) << line;
  }
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
}

TEST_F(ExrTest, OtherKindsAreRefusedByName) {
  LayeredImage image;
  image.layers[""] = testImage(16, 16);
  writeExr(path("whole.exr"), image);
  const auto errorOfVersion = [&](int byte, int bits) {
    std::string bytes = readBytes(path("whole.exr"));
    bytes[size_t(byte)] = char(bytes[size_t(byte)] | bits);
    writeBytes(path("other.exr"), bytes);
    return errorLine([&] { readExr(path("other.exr")); });
  };
  EXPECT_NE(errorOfVersion(4, 1).find("file version 3 is not supported"), std::string::npos);
  EXPECT_NE(errorOfVersion(5, 0x08).find("deep OpenEXR images"), std::string::npos);
  EXPECT_NE(errorOfVersion(5, 0x10).find("multi-part OpenEXR images"), std::string::npos);
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

}  // namespace
}  // namespace restlab
