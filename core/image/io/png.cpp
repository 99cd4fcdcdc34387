#include "core/image/io/png.h"

#include <fmt/format.h>
#include <spng.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "core/base/error.h"
#include "core/image/image.h"
#include "core/image/io/atomic_file.h"
#include "core/image/io/exr_limits.h"
#include "core/image/io/srgb.h"

namespace restlab {
namespace {

bool isAscii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x80; });
}

// PNG keywords have 1 to 79 printable characters, no blank at either end and no two in a row.
bool isKeyword(const std::string& key) {
  const bool isPrintable =
      std::all_of(key.begin(), key.end(), [](unsigned char c) { return c >= 0x20 && c < 0x7f; });
  return isPrintable && !key.empty() && key.size() <= 79 && key.front() != ' ' &&
         key.back() != ' ' && key.find("  ") == std::string::npos;
}

struct Text {
  std::string keyword, text;
};

std::vector<Text> textsOf(const std::map<std::string, std::string>& metadata) {
  std::vector<Text> texts;
  if (const auto version = metadata.find("version"); version != metadata.end())
    texts.push_back({"Software", "restlab " + version->second});
  for (const auto& [key, value] : metadata) {
    const std::string keyword = kExrMetadataPrefix + key;
    const bool fits = isKeyword(keyword);
    texts.push_back({fits ? keyword : fmt::format("{}more", kExrMetadataPrefix),
                     fits ? value : fmt::format("{}={}", key, value)});
    // PNG ends a text at the first byte 0.
    std::string& text = texts.back().text;
    std::replace(text.begin(), text.end(), '\0', ' ');
    if (text.empty()) text.push_back(' ');  // libspng rejects empty texts
  }
  return texts;
}

void setTexts(spng_ctx* context, std::vector<Text>& texts) {
  static char none[] = "";
  std::vector<spng_text> list;
  for (Text& one : texts) {
    spng_text& text = list.emplace_back();
    text = {};
    std::copy(one.keyword.begin(), one.keyword.end(), text.keyword);
    text.type = isAscii(one.text) ? SPNG_TEXT : SPNG_ITXT;
    text.text = one.text.data();
    text.length = one.text.size();
    text.language_tag = text.translated_keyword = none;
  }
  if (list.empty()) return;
  if (const int error = spng_set_text(context, list.data(), uint32_t(list.size())))
    failInput(fmt::format("texts of a PNG: {}", spng_strerror(error)));
}

struct Free {
  void operator()(void* bytes) const { std::free(bytes); }
};

}  // namespace

std::string encodePng(const std::string& what, uint32_t width, uint32_t height,
                      const uint8_t* bytes, const std::map<std::string, std::string>& metadata,
                      uint32_t channels) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(SPNG_CTX_ENCODER),
                                                                    &spng_ctx_free);
  if (!context) throw std::bad_alloc();
  spng_ihdr header = {};
  header.width = width;
  header.height = height;
  header.bit_depth = 8;
  header.color_type = channels == 4 ? SPNG_COLOR_TYPE_TRUECOLOR_ALPHA : SPNG_COLOR_TYPE_TRUECOLOR;
  spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  int error = spng_set_ihdr(context.get(), &header);
  if (error == 0) error = spng_set_srgb(context.get(), 0);
  // libspng keeps pointers to the texts until the image is encoded.
  std::vector<Text> texts = textsOf(metadata);
  if (error == 0) setTexts(context.get(), texts);
  const size_t size = size_t(width) * height * channels;
  if (error == 0)
    error = spng_encode_image(context.get(), bytes, size, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  size_t length = 0;
  std::unique_ptr<void, Free> file;
  if (error == 0) file.reset(spng_get_png_buffer(context.get(), &length, &error));
  if (error == SPNG_EMEM) throw std::bad_alloc();
  if (error != 0 || !file) {
    failInput(fmt::format("{}: cannot write a PNG of {}x{} pixels: {}", what, width, height,
                          spng_strerror(error)));
  }
  return {static_cast<const char*>(file.get()), length};
}

void writePng(const std::filesystem::path& file, const Image& image, float exposure,
              const std::map<std::string, std::string>& metadata) {
  if (image.pixels.empty() || image.pixels.size() != size_t(image.width) * image.height) {
    failInput(fmt::format("{}: cannot write a PNG of {}x{} pixels", file.string(), image.width,
                          image.height));
  }
  const std::vector<uint8_t> bytes = srgbBytes(image, exposure);
  AtomicFile output(file);
  const std::string encoded =
      encodePng(file.string(), image.width, image.height, bytes.data(), metadata);
  output.stream().write(encoded.data(), std::streamsize(encoded.size()));
  output.commit();
}

}  // namespace restlab
