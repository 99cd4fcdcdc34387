#include "core/image/io/exr_header.h"

#include <fmt/format.h>

#include <array>
#include <map>

#include "core/base/error.h"
#include "core/image/io/exr_limits.h"

namespace restlab {

namespace fs = std::filesystem;

void failExr(const fs::path& file, const std::string& what) {
  failInput(fmt::format("{}: {}", file.string(), what));
}

namespace {

// Attribute types whose values OpenEXR reads with a fixed size, whatever the header claims.
const std::map<std::string, uint32_t>& fixedSizes() {
  static const std::map<std::string, uint32_t> sizes = {{"box2f", 16},
                                                        {"box2i", 16},
                                                        {"chromaticities", 32},
                                                        {"compression", 1},
                                                        {"deepImageState", 1},
                                                        {"double", 8},
                                                        {"envmap", 1},
                                                        {"float", 4},
                                                        {"int", 4},
                                                        {"keycode", 28},
                                                        {"lineOrder", 1},
                                                        {"m33d", 72},
                                                        {"m33f", 36},
                                                        {"m44d", 128},
                                                        {"m44f", 64},
                                                        {"rational", 8},
                                                        {"tiledesc", 9},
                                                        {"timecode", 8},
                                                        {"v2d", 16},
                                                        {"v2f", 8},
                                                        {"v2i", 8},
                                                        {"v3d", 24},
                                                        {"v3f", 12},
                                                        {"v3i", 12}};
  return sizes;
}

class HeaderGuard {
 public:
  HeaderGuard(const fs::path& file, std::ifstream& stream, uint64_t fileBytes)
      : file_(file), stream_(stream), fileBytes_(fileBytes) {}

  void check() {
    const uint32_t magic = readWord();
    if (magic != 20000630u) failExr(file_, "is not an OpenEXR image");
    const uint32_t version = readWord();
    if ((version & 0xffu) != 2u) {
      failExr(file_, fmt::format("OpenEXR file version {} is not supported", version & 0xffu));
    }
    if (version & 0x800u) failExr(file_, "deep OpenEXR images are not supported");
    if (version & 0x1000u) failExr(file_, "multi-part OpenEXR images are not supported");
    while (checkAttribute()) {
    }
    if (!windowSeen_) failExr(file_, "OpenEXR header has no data window");
    if (tile_[0] != 0) {
      const uint64_t tiles =
          ((width_ + tile_[0] - 1) / tile_[0]) * ((height_ + tile_[1] - 1) / tile_[1]);
      if (tiles * 8 > fileBytes_) {
        failExr(file_, "is too short for its table of tiles (truncated or corrupt)");
      }
    }
  }

  uint64_t pixelCount() const { return width_ * height_; }

 private:
  bool checkAttribute() {
    const std::string name = readName();
    if (name.empty()) return false;
    const std::string type = readName();
    const uint32_t size = readWord();
    const uint64_t begin = uint64_t(std::streamoff(stream_.tellg()));
    if (size > fileBytes_ - begin) {
      failExr(file_, fmt::format("OpenEXR attribute '{}' claims {} bytes, more than the file has "
                                 "left (truncated or corrupt)",
                                 name, size));
    }
    const auto fixed = fixedSizes().find(type);
    if (fixed != fixedSizes().end() && size != fixed->second) {
      failSize(name, size, fmt::format("{} has {}", type, fixed->second));
    }
    if (type == "floatvector" && size % 4 != 0) failSize(name, size, "floats have 4 each");
    if (type == "chlist") checkChannels(name, begin, size);
    if (name == "dataWindow" && type == "box2i") checkWindow();
    if (name == "tiles" && type == "tiledesc") checkTiles();
    stream_.seekg(std::streamoff(begin + size));
    return true;
  }

  // Channels are names with 16 bytes each, ended by an empty name; OpenEXR reads up to that one.
  void checkChannels(const std::string& name, uint64_t begin, uint32_t size) {
    while (!readName().empty()) stream_.ignore(16);
    if (!stream_) failShort();
    const uint64_t bytes = uint64_t(std::streamoff(stream_.tellg())) - begin;
    if (bytes != size) failSize(name, size, fmt::format("its channels take {}", bytes));
  }

  [[noreturn]] void failSize(const std::string& name, uint32_t size, const std::string& right) {
    failExr(file_, fmt::format("OpenEXR attribute '{}' claims {} bytes where {} (corrupt)", name,
                               size, right));
  }

  void checkWindow() {
    std::array<int64_t, 4> box;
    for (int64_t& side : box) side = int32_t(readWord());
    const int64_t width = box[2] - box[0] + 1;
    const int64_t height = box[3] - box[1] + 1;
    if (width < 1 || height < 1 || width > kExrMaxSide || height > kExrMaxSide ||
        uint64_t(width * height) > kExrMaxPixels) {
      failExr(file_,
              fmt::format("data window of {}x{} pixels (1 to {} a side and at most {} pixels "
                          "are supported)",
                          width, height, kExrMaxSide, kExrMaxPixels));
    }
    width_ = uint64_t(width);
    height_ = uint64_t(height);
    windowSeen_ = true;
  }

  void checkTiles() {
    tile_ = {readWord(), readWord()};
    if (tile_[0] < 1 || tile_[1] < 1 || tile_[0] > kExrMaxSide || tile_[1] > kExrMaxSide) {
      failExr(file_, fmt::format("tiles of {}x{} pixels (1 to {} a side are supported)", tile_[0],
                                 tile_[1], kExrMaxSide));
    }
  }

  [[noreturn]] void failShort() { failExr(file_, "OpenEXR header is truncated"); }

  uint32_t readWord() {
    std::array<unsigned char, 4> b;
    if (!stream_.read(reinterpret_cast<char*>(b.data()), 4)) failShort();
    return uint32_t(b[0]) | uint32_t(b[1]) << 8 | uint32_t(b[2]) << 16 | uint32_t(b[3]) << 24;
  }

  std::string readName() {
    std::string name;
    for (char c; stream_.get(c);) {
      if (c == '\0') return name;
      if (name.size() == 255) failExr(file_, "OpenEXR header is corrupt");
      name += c;
    }
    failShort();
  }

  const fs::path& file_;
  std::ifstream& stream_;
  uint64_t fileBytes_;
  uint64_t width_ = 0, height_ = 0;
  std::array<uint64_t, 2> tile_{0, 0};
  bool windowSeen_ = false;
};

}  // namespace

uint64_t checkExrHeader(const fs::path& file, std::ifstream& stream, uint64_t fileBytes) {
  HeaderGuard guard(file, stream, fileBytes);
  guard.check();
  return guard.pixelCount();
}

}  // namespace restlab
