#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <new>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "core/base/memory.h"
#include "core/image/image.h"
#include "core/image/io/chromaticities.h"
#include "core/image/io/exr_contents.h"
#include "core/image/io/exr_header.h"
#include "core/image/io/exr_layers.h"
#include "core/image/io/exr_limits.h"

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

// Reads an open file for OpenEXR; a short read throws and never makes up values.
class FileSource : public Imf::IStream {
 public:
  explicit FileSource(std::ifstream& stream) : Imf::IStream(""), stream_(stream) {}
  bool read(char bytes[], int size) override {
    if (!stream_.read(bytes, size)) throw std::runtime_error("the file ends too early");
    const bool more = stream_.peek() != std::ifstream::traits_type::eof();
    stream_.clear();  // peeking at the end is no failure
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

Chromaticities chromaticitiesOf(const Imf::Chromaticities& c) {
  return {{c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
}

// Converts colour layers to Rec. 709. Luminance alone is grey in any primaries, and data layers
// stay unchanged.
void convertColours(const fs::path& file, const Imf::Header& header,
                    const std::map<std::string, LayerChannels>& layers,
                    const std::set<std::string>& data, LayeredImage& image) {
  if (!Imf::hasChromaticities(header)) return;
  const Chromaticities colours = chromaticitiesOf(Imf::chromaticities(header));
  std::vector<Image*> converted;
  for (const auto& [name, channels] : layers) {
    if (channels.isColour && !data.contains(name)) converted.push_back(&image.layers.at(name));
  }
  if (converted.empty() || isRec709(colours)) return;
  if (const std::string why = whyNoColours(colours); !why.empty()) {
    failExr(file, fmt::format("attribute 'chromaticities' has {}: {}", textOf(colours), why));
  }
  const glm::dmat3 matrix = toRec709(colours);
  for (Image* layer : converted) convert(matrix, layer->pixels);
  image.notes.push_back(
      fmt::format("{}: colours are converted to Rec. 709 from {}", file.string(), textOf(colours)));
}

EnvironmentKind environmentOf(const Imf::Header& header) {
  if (!Imf::hasEnvmap(header)) return EnvironmentKind::none;
  const Imf::Envmap kind = Imf::envmap(header);
  return kind == Imf::ENVMAP_LATLONG ? EnvironmentKind::latLong
         : kind == Imf::ENVMAP_CUBE  ? EnvironmentKind::cube
                                     : EnvironmentKind::unknown;
}

PixelWindow windowOf(const Imf::Header& header) {
  const Imath::Box2i& window = header.dataWindow();
  return {{window.min.x, window.min.y},
          uint32_t(window.max.x - window.min.x + 1),
          uint32_t(window.max.y - window.min.y + 1)};
}

ExrFrame frameOf(const Imf::Header& header) {
  const Imath::Box2i& display = header.displayWindow();
  return {windowOf(header).origin,
          glm::ivec4(display.min.x, display.min.y, display.max.x, display.max.y),
          header.pixelAspectRatio(), environmentOf(header)};
}

// Opens only the channels of `layers`.
void readLayers(const fs::path& file, Imf::InputFile& exr,
                const std::map<std::string, LayerChannels>& layers, LayeredImage& result) {
  const PixelWindow window = windowOf(exr.header());
  Imf::FrameBuffer frame;
  for (const auto& [name, channels] : layers) {
    Image& layer = result.layers[name];
    layer = Image(window.width, window.height);
    layer.origin = window.origin;
    float* first = &layer.pixels[0].x;
    if (!channels.alone.empty()) {
      addSlice(file, frame, exr.header(), channels.alone, first);
    } else {
      for (size_t c = 0; c < 3; ++c) {
        if (!channels.three[c].empty())
          addSlice(file, frame, exr.header(), channels.three[c], first + c);
      }
    }
  }
  if (layers.empty()) return;
  exr.setFrameBuffer(frame);
  exr.readPixels(exr.header().dataWindow().min.y, exr.header().dataWindow().max.y);
  for (const auto& [name, channels] : layers) {
    if (channels.alone.empty()) continue;
    for (glm::vec3& pixel : result.layers[name].pixels) pixel = glm::vec3(pixel.x);
  }
}

LayeredImage readOpened(const fs::path& file, std::ifstream& stream, uint64_t fileBytes,
                        const ExrSelection& wanted) {
  const uint64_t pixels = checkExrHeader(file, stream, fileBytes);
  FileSource exrStream(stream);
  exrStream.seekg(0);
  Imf::InputFile exr(exrStream);
  const Imf::Header& header = exr.header();
  auto layers = findExrLayers(file, header, wanted.kind);
  if (wanted.names)
    std::erase_if(layers, [&](const auto& one) { return !wanted.names->contains(one.first); });
  checkSizes(file, header, pixels, fileBytes, std::max<size_t>(layers.size(), 1));
  if (!exr.isComplete()) failExr(file, "is incomplete (truncated or still being written)");
  MemoryGuard().take(
      fmt::format("{}: {} layers of {} pixels", file.string(), layers.size(), pixels),
      layers.size() * pixels * sizeof(glm::vec3));

  LayeredImage result;
  result.frame = frameOf(header);
  readLayers(file, exr, layers, result);
  convertColours(file, header, layers, wanted.data, result);
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

// Opens the file and calls `read` with the stream and the file size. Errors name the file.
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

LayeredImage readExr(const fs::path& file, const ExrSelection& wanted) {
  return withOpened(file, [&](std::ifstream& stream, uint64_t fileBytes) {
    return readOpened(file, stream, fileBytes, wanted);
  });
}

ExrContents readExrContents(const fs::path& file, ExrLayers wanted) {
  return withOpened(file, [&](std::ifstream& stream, uint64_t fileBytes) {
    checkExrHeader(file, stream, fileBytes);
    FileSource exrStream(stream);
    exrStream.seekg(0);
    const Imf::InputFile exr(exrStream);
    ExrContents contents;
    contents.window = windowOf(exr.header());
    for (const auto& layer : findExrLayers(file, exr.header(), wanted))
      contents.layers.push_back(layer.first);
    return contents;
  });
}

}  // namespace restlab
