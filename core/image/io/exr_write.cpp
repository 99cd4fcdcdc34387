#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImathBox.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/image.h"
#include "core/image/io/atomic_file.h"
#include "core/image/io/exr_limits.h"

namespace restlab {
namespace {

// Lets OpenEXR write through an AtomicFile, whose commit() sees every failed write: OpenEXR's own
// stream loses the errors of its last flush. No member throws, as OpenEXR also writes from a
// destructor.
class FileSink : public Imf::OStream {
 public:
  explicit FileSink(std::ofstream& stream) : Imf::OStream(""), stream_(stream) {}
  void write(const char bytes[], int size) override {
    stream_.write(bytes, size);
    position_ += uint64_t(size);
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t offset) override {
    stream_.seekp(std::streamoff(offset));
    position_ = offset;
  }

 private:
  std::ofstream& stream_;
  uint64_t position_ = 0;
};

// Returns the first layer. Throws unless all layers have the same size and at least one pixel.
const Image& checkedFirstLayer(const std::filesystem::path& file, const LayeredImage& image) {
  if (image.layers.empty()) failInput(fmt::format("{}: image has no layer", file.string()));
  const auto& [firstName, first] = *image.layers.begin();
  for (const auto& [name, layer] : image.layers) {
    if (layer.width != first.width || layer.height != first.height) {
      failInput(fmt::format("{}: layer '{}' is {}x{} but layer '{}' is {}x{}", file.string(), name,
                            layer.width, layer.height, firstName, first.width, first.height));
    }
    if (layer.pixels.size() != size_t(layer.width) * layer.height) {
      failInput(fmt::format("{}: layer '{}' is {}x{} but holds {} pixels", file.string(), name,
                            layer.width, layer.height, layer.pixels.size()));
    }
  }
  if (first.pixels.empty() || first.width > kExrMaxSide || first.height > kExrMaxSide ||
      first.pixels.size() > kExrMaxPixels / image.layers.size()) {
    failInput(fmt::format(
        "{}: cannot write {} layers of {}x{} pixels (1 to {} a side, at most {} "
        "over all layers)",
        file.string(), image.layers.size(), first.width, first.height, kExrMaxSide, kExrMaxPixels));
  }
  return first;
}

}  // namespace

void requireExrSize(const std::string& what, uint32_t width, uint32_t height, uint32_t layers) {
  const double limit = double(kExrMaxPixels / layers);
  const double pixels = double(width) * double(height);
  if (pixels <= limit) return;
  const double scale = std::sqrt(limit / pixels);
  const auto fitting = [&](uint32_t side) { return std::max(1.0, std::floor(side * scale)); };
  failUsage(fmt::format(
      "{}: {}x{} pixels in {} layers are more than an EXR file may hold ({} pixels over "
      "all layers); at most {:.0f}x{:.0f} would do",
      what, width, height, layers, kExrMaxPixels, fitting(width), fitting(height)));
}

void writeExr(const std::filesystem::path& file, const LayeredImage& image) {
  const Image& first = checkedFirstLayer(file, image);
  const int width = int(first.width);
  const int height = int(first.height);

  AtomicFile output(file);
  try {
    const glm::ivec2 origin = image.frame.origin;
    const Imath::Box2i data({origin.x, origin.y}, {origin.x + width - 1, origin.y + height - 1});
    const glm::ivec4 shown =
        image.frame.display.value_or(glm::ivec4(data.min.x, data.min.y, data.max.x, data.max.y));
    Imf::Header header(Imath::Box2i({shown.x, shown.y}, {shown.z, shown.w}), data,
                       image.frame.pixelAspectRatio);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [key, value] : image.metadata) {
      header.insert(kExrMetadataPrefix + key, Imf::StringAttribute(value));
    }
    Imf::FrameBuffer frame;
    for (const auto& [name, layer] : image.layers) {
      for (int c = 0; c < 3; ++c) {
        const std::string channel =
            (name.empty() ? std::string() : name + ".") + std::string(1, "RGB"[c]);
        header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
        frame.insert(channel, Imf::Slice::Make(Imf::FLOAT, &layer.pixels[0][c], data,
                                               sizeof(glm::vec3), sizeof(glm::vec3) * layer.width));
      }
    }
    FileSink stream(output.stream());
    Imf::OutputFile exr(stream, header);
    exr.setFrameBuffer(frame);
    exr.writePixels(height);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    failInput(fmt::format("{}: cannot be written: {}", file.string(), exrReason(error.what())));
  }
  output.commit();
}

}  // namespace restlab
