#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <new>

#include "core/error.h"
#include "core/file_reason.h"
#include "core/image/exr_contents.h"
#include "core/image/exr_limits.h"
#include "core/image/image.h"
#include "core/memory.h"

namespace restlab {

std::string exrReason(const std::string& message) {
  std::string reason = message;
  const size_t quote = reason.find("\". ");
  if (quote != std::string::npos) reason = reason.substr(quote + 3);
  for (char& c : reason) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return reason;
}

namespace {

namespace fs = std::filesystem;

[[noreturn]] void failExr(const fs::path& file, const std::string& what) {
  failInput(fmt::format("{}: {}", file.string(), what));
}

// OpenEXR's view of an open file; a short read is an exception, never a value made up.
class FileStream : public Imf::IStream {
 public:
  explicit FileStream(std::ifstream& stream) : Imf::IStream(""), stream_(stream) {}
  bool read(char bytes[], int size) override {
    if (!stream_.read(bytes, size)) throw std::runtime_error("the file ends too early");
    const bool more = stream_.peek() != std::ifstream::traits_type::eof();
    stream_.clear();  // having peeked at the end is no failure
    return more;
  }
  uint64_t tellg() override { return uint64_t(std::streamoff(stream_.tellg())); }
  void seekg(uint64_t offset) override {
    stream_.clear();
    stream_.seekg(std::streamoff(offset));
  }
  void clear() override { stream_.clear(); }

 private:
  std::ifstream& stream_;
};

// Attribute types whose values OpenEXR reads with a size of their own, whatever the header claims.
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

// Walks over the raw header before OpenEXR allocates anything from its numbers: attribute sizes,
// the data window and the tile size may all lie. Where OpenEXR would not take an attribute's size
// at its word it would read on elsewhere than this does, and find sizes that nobody checked:
// refused.
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

  // Names with 16 bytes each, and an empty name: OpenEXR reads to that one.
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

// The channels that make up one layer: three, or two (a third "" is 0), or one alone.
struct LayerChannels {
  std::array<std::string, 3> three;
  std::string alone;
};

// Of a layer's channels, by the last part of their names.
LayerChannels channelsOf(const std::map<std::string, std::string>& named, ExrLayers wanted) {
  const auto has = [&](const char* last) { return named.contains(last); };
  const auto three = [&](const char* a, const char* b, const char* c) -> LayerChannels {
    return {{named.at(a), named.at(b), named.at(c)}, ""};
  };
  if (has("R") && has("G") && has("B")) return three("R", "G", "B");
  const bool anyRgb = has("R") || has("G") || has("B");
  const bool isVector = has("X") || has("Z");
  // Y alone is a luminance; beside X or Z it is an axis, and RY and BY say chroma.
  if (has("Y") && !anyRgb && !isVector && !has("RY") && !has("BY")) return {{}, named.at("Y")};
  if (wanted == ExrLayers::colours) return {};
  if (has("X") && has("Y") && has("Z")) return three("X", "Y", "Z");
  // A vector on the film, as of motion.
  if (has("X") && has("Y") && named.size() == 2) return {{named.at("X"), named.at("Y"), ""}, ""};
  if (named.size() == 1) return {{}, named.begin()->second};
  return {};
}

std::map<std::string, LayerChannels> findLayers(const fs::path& file, const Imf::Header& header,
                                                ExrLayers wanted) {
  std::map<std::string, std::map<std::string, std::string>> named;
  std::string all;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    const std::string channel = it.name();
    all += (all.empty() ? "" : ", ") + channel;
    const size_t dot = channel.rfind('.');
    const std::string layer = dot == std::string::npos ? "" : channel.substr(0, dot);
    const std::string last = dot == std::string::npos ? channel : channel.substr(dot + 1);
    named[layer][last] = channel;
  }
  std::map<std::string, LayerChannels> found;
  for (const auto& [layer, channels] : named) {
    const LayerChannels of = channelsOf(channels, wanted);
    if (!of.alone.empty() || !of.three[0].empty()) found[layer] = of;
  }
  // Beside colours without a name, Z is the depth.
  const auto depth = named[""].find("Z");
  if (wanted == ExrLayers::all && found.contains("") && depth != named[""].end() &&
      !found.contains("Z"))
    found["Z"] = {{}, depth->second};
  if (found.empty()) {
    failExr(file,
            "has no layer with channels R, G, B or Y alone (channels: " + all.substr(0, 200) + ")");
  }
  return found;
}

// Largest ratio of pixels to file bytes that the compressors reach (deflate: 1032; DWA first drops
// what is constant in a block).
uint64_t maxCompressionRatio(Imf::Compression compression) {
  const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  return dwa ? 1u << 17 : 1100u;
}

void checkSizes(const fs::path& file, const Imf::Header& header, uint64_t pixels,
                uint64_t fileBytes, size_t layers) {
  if (pixels > kExrMaxPixels / layers) {
    failExr(file, fmt::format("{} layers of {} pixels (at most {} over all layers are supported)",
                              layers, pixels, kExrMaxPixels));
  }
  uint64_t bytesPerPixel = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    const uint64_t size = it.channel().type == Imf::HALF ? 2 : 4;
    bytesPerPixel += it.channel().xSampling == 1 && it.channel().ySampling == 1 ? size : 0;
  }
  const uint64_t ratio = maxCompressionRatio(header.compression());
  if (pixels * bytesPerPixel / ratio > fileBytes) {
    failExr(file, fmt::format("has {} bytes, too few for {} pixels (truncated or corrupt)",
                              fileBytes, pixels));
  }
}

void addSlice(const fs::path& file, Imf::FrameBuffer& frame, const Imf::Header& header,
              const std::string& name, float* target) {
  const Imf::Channel& channel = header.channels()[name.c_str()];
  if (channel.type == Imf::UINT) {
    failExr(file, "channel " + name + " holds integers; half or float is wanted");
  }
  if (channel.xSampling != 1 || channel.ySampling != 1) {
    failExr(file, "channel " + name + " is subsampled; one value a pixel is wanted");
  }
  const Imath::Box2i& window = header.dataWindow();
  const size_t width = size_t(window.max.x - window.min.x + 1);
  frame.insert(name, Imf::Slice::Make(Imf::FLOAT, target, window, sizeof(glm::vec3),
                                      sizeof(glm::vec3) * width));
}

LayeredImage readOpened(const fs::path& file, std::ifstream& stream, uint64_t fileBytes,
                        ExrLayers wanted) {
  HeaderGuard guard(file, stream, fileBytes);
  guard.check();
  FileStream exrStream(stream);
  exrStream.seekg(0);
  Imf::InputFile exr(exrStream);
  const Imf::Header& header = exr.header();
  const Imath::Box2i window = header.dataWindow();
  const auto layers = findLayers(file, header, wanted);
  checkSizes(file, header, guard.pixelCount(), fileBytes, layers.size());
  if (!exr.isComplete()) failExr(file, "is incomplete (truncated or still being written)");
  MemoryGuard().take(
      fmt::format("{}: {} layers of {} pixels", file.string(), layers.size(), guard.pixelCount()),
      layers.size() * guard.pixelCount() * sizeof(glm::vec3));

  LayeredImage result;
  Imf::FrameBuffer frame;
  for (const auto& [name, channels] : layers) {
    Image& layer = result.layers[name];
    layer =
        Image(uint32_t(window.max.x - window.min.x + 1), uint32_t(window.max.y - window.min.y + 1));
    float* first = &layer.pixels[0].x;
    if (!channels.alone.empty()) {
      addSlice(file, frame, header, channels.alone, first);
    } else {
      for (size_t c = 0; c < 3; ++c) {
        if (!channels.three[c].empty()) addSlice(file, frame, header, channels.three[c], first + c);
      }
    }
  }
  exr.setFrameBuffer(frame);
  exr.readPixels(window.min.y, window.max.y);
  for (const auto& [name, channels] : layers) {
    if (channels.alone.empty()) continue;
    for (glm::vec3& pixel : result.layers[name].pixels) pixel = glm::vec3(pixel.x);
  }
  const std::string prefix = kExrMetadataPrefix;
  for (auto it = header.begin(); it != header.end(); ++it) {
    const std::string key = it.name();
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute());
    if (text != nullptr && key.rfind(prefix, 0) == 0) {
      result.metadata[key.substr(prefix.size())] = text->value();
    }
  }
  return result;
}

// `read` takes the file and its size once it is open. What goes wrong names the file.
template <class Read>
auto withOpened(const fs::path& file, const Read& read) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) failExr(file, unreadableReason(file));
  if (!fs::is_regular_file(status)) failExr(file, "is not a regular file");
  const uint64_t fileBytes = fs::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error) failExr(file, "cannot be read: " + error.message());
  if (!stream) failExr(file, unreadableReason(file));
  try {
    return read(stream, fileBytes);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    failExr(file, "not enough memory to read it");
  } catch (const std::exception& reason) {
    failExr(file, "cannot be read: " + exrReason(reason.what()));
  }
}

}  // namespace

LayeredImage readExr(const fs::path& file, ExrLayers wanted) {
  return withOpened(file, [&](std::ifstream& stream, uint64_t fileBytes) {
    return readOpened(file, stream, fileBytes, wanted);
  });
}

ExrContents readExrContents(const fs::path& file, ExrLayers wanted) {
  return withOpened(file, [&](std::ifstream& stream, uint64_t fileBytes) {
    HeaderGuard(file, stream, fileBytes).check();
    FileStream exrStream(stream);
    exrStream.seekg(0);
    const Imf::InputFile exr(exrStream);
    const Imath::Box2i window = exr.header().dataWindow();
    ExrContents contents;
    contents.width = uint32_t(window.max.x - window.min.x + 1);
    contents.height = uint32_t(window.max.y - window.min.y + 1);
    for (const auto& layer : findLayers(file, exr.header(), wanted))
      contents.layers.push_back(layer.first);
    return contents;
  });
}

}  // namespace restlab
