// JPEG by libjpeg-turbo.
#include <fmt/format.h>
#include <turbojpeg.h>

#include <memory>
#include <string_view>

#include "core/scene/textures/image_formats.h"

namespace restlab {

namespace {

class Decoder {
 public:
  explicit Decoder(const std::vector<uint8_t>& bytes)
      : bytes_(bytes), handle_(tjInitDecompress(), [](void* handle) { tjDestroy(handle); }) {
    if (!handle_) throw std::bad_alloc();
  }

  std::string readHeader(ImageSize& size) {
    int width = 0, height = 0, subsampling = 0;
    if (tjDecompressHeader3(handle_.get(), bytes_.data(), bytes_.size(), &width, &height,
                            &subsampling, &colourSpace_) != 0)
      return message();
    const std::string problem = checkPixelCount(uint64_t(width), uint64_t(height));
    if (problem.empty()) size = {uint32_t(width), uint32_t(height)};
    return problem;
  }

  // Decodes to four bytes per pixel: RGBA, or CMYK if the file is CMYK.
  std::string read(const ImageSize& size, std::vector<uint32_t>& texels) {
    // TJFLAG_LIMITSCANS refuses 500 scans: each may touch all pixels but costs a file a dozen
    // bytes.
    constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS;
    const auto decode = [&](int flags) {
      return tjDecompress2(handle_.get(), bytes_.data(), bytes_.size(),
                           reinterpret_cast<unsigned char*>(texels.data()), int(size.width), 0,
                           int(size.height), isCmyk() ? TJPF_CMYK : TJPF_RGBA, flags) == 0;
    };
    if (decode(kFlags | TJFLAG_STOPONWARNING)) return "";
    // Extra bytes between segments are harmless; every other warning of the decoder means lost
    // pixels.
    const bool isHarmless = reason().find("extraneous bytes") != std::string_view::npos;
    return isHarmless && decode(kFlags) ? "" : message();
  }

  bool isCmyk() const { return colourSpace_ == TJCS_CMYK || colourSpace_ == TJCS_YCCK; }

 private:
  std::string_view reason() const { return tjGetErrorStr2(handle_.get()); }
  std::string message() const {
    for (const char* words : {"remature end", "Empty input"}) {
      if (reason().find(words) != std::string_view::npos) return "truncated";
    }
    return fmt::format("cannot be decoded ({})", reason());
  }

  const std::vector<uint8_t>& bytes_;
  std::unique_ptr<void, void (*)(void*)> handle_;
  int colourSpace_ = 0;
};

// An 8 x 8 block takes at least one bit, in the first scan of a progressive file.
uint64_t fewestBytes(const ImageSize& size) {
  return uint64_t(size.width) * size.height / (64 * 8);
}

}  // namespace

std::string checkJpegHeader(const std::vector<uint8_t>& bytes, ImageSize& size) {
  if (std::string problem = Decoder(bytes).readHeader(size); !problem.empty()) return problem;
  return checkFileSize(bytes.size(), fewestBytes(size), size);
}

std::string decodeJpeg(const std::vector<uint8_t>& bytes, DecodedImage& image) {
  Decoder decoder(bytes);
  ImageSize size;
  if (std::string problem = decoder.readHeader(size); !problem.empty()) return problem;
  if (std::string problem = decoder.read(size, image.texels); !problem.empty()) return problem;
  if (!decoder.isCmyk()) return "";
  // Adobe's programs store CMYK inverted.
  for (uint32_t& texel : image.texels) {
    const uint32_t black = texel >> 24;
    const auto times = [&](uint32_t ink) { return ((ink & 0xffu) * black + 127u) / 255u; };
    texel = packRgba(times(texel), times(texel >> 8), times(texel >> 16), 255u);
  }
  return "";
}

}  // namespace restlab
