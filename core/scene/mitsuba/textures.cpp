#include "core/scene/mitsuba/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/image/color.h"
#include "core/image/image.h"
#include "core/scene/textures/image_decode.h"
#include "core/scene/textures/image_formats.h"

namespace restlab::mitsuba {
namespace fs = std::filesystem;
namespace {

constexpr uint64_t kMostImageBytes = uint64_t(1) << 31;

uint32_t byteOf(double unit) { return uint32_t(std::lround(255.0 * std::clamp(unit, 0.0, 1.0))); }

uint32_t texelOf(const glm::dvec3& linear) {
  return packRgba(byteOf(encodeSrgb(linear.x)), byteOf(encodeSrgb(linear.y)),
                  byteOf(encodeSrgb(linear.z)), 255u);
}

double largest(const glm::dvec3& c) { return std::max({c.x, c.y, c.z}); }

// A factor and two bytes of sRGB that stand for two values: of all bytes that the larger value may
// have, so that the factor is at most `mostFactor`, the one that rounds the smaller one least.
struct TwoValues {
  double factor = 1.0;
  uint32_t a = 0, b = 0;
};
TwoValues twoValues(double a, double b, double mostFactor) {
  const double most = std::max(a, b), least = std::min(a, b);
  TwoValues best;
  if (!(most > 0.0)) return best;
  double smallestError = 2.0;
  for (uint32_t byte = 255; byte >= 128; --byte) {
    const double factor = most / decodeSrgb(byte / 255.0);
    if (byte < 255 && factor > mostFactor) break;
    const uint32_t other = byteOf(encodeSrgb(least / factor));
    const double error =
        least > 0.0 ? std::abs(factor * decodeSrgb(other / 255.0) / least - 1.0) : 0.0;
    if (!(error < smallestError)) continue;
    smallestError = error;
    best = a >= b ? TwoValues{factor, byte, other} : TwoValues{factor, other, byte};
  }
  return best;
}

// A channel of a texel as the use reads it.
double channelOf(const TextureUse& use, uint32_t texel, uint32_t channel) {
  const double encoded = double((texel >> (8 * channel)) & 255u) / 255.0;
  return use.srgb ? decodeSrgb(encoded) : encoded;
}

std::string lowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace

uint32_t Textures::add(const TextureUse& use) {
  context_.scene.textureUses.push_back(use);
  return uint32_t(context_.scene.textureUses.size() - 1);
}

// The parameters of both bitmaps and checkerboards: to_uv, or scales and offsets of version 0.6.
TextureUse Textures::useOf(Parameters& parameters) {
  TextureUse use;
  const glm::dmat4 m = parameters.transform("to_uv", true);
  const double us = parameters.number("uscale", 1.0, -1e6, 1e6),
               vs = parameters.number("vscale", 1.0, -1e6, 1e6),
               uo = parameters.number("uoffset", 0.0, -1e6, 1e6),
               vo = parameters.number("voffset", 0.0, -1e6, 1e6);
  use.uvRow0 = glm::dvec3(m[0].x * us, m[1].x * vs, m[3].x + m[0].x * uo + m[1].x * vo);
  use.uvRow1 = glm::dvec3(m[0].y * us, m[1].y * vs, m[3].y + m[0].y * uo + m[1].y * vo);
  return use;
}

// Reads an image once. Images of floats become sRGB of 8 bits, over their largest value.
uint32_t Textures::imageOf(const fs::path& file, const Element& element, bool& isFloat,
                           double& scale) {
  if (const auto known = loaded_.find(file); known != loaded_.end()) {
    isFloat = known->second.isFloat;
    scale = known->second.scale;
    return known->second.image;
  }
  const std::vector<uint8_t> bytes = context_.files.read(file, element.place, kMostImageBytes);
  Report& report = context_.report;
  const auto fail = [&](const std::string& text) {
    report.fail(element.place, fmt::format("{}: {}", file.string(), text));
  };
  TextureImage image{file.filename().string(), 0, 0, {}};
  std::vector<glm::vec3> pixels;
  if (lowerExtension(file) == ".exr") {
    LayeredImage read = readExr(file, {ExrLayers::colours, {""}});
    const auto layer = read.layers.find("");
    if (layer == read.layers.end()) fail("has no channels R, G, B (or Y)");
    image.width = layer->second.width;
    image.height = layer->second.height;
    pixels = std::move(layer->second.pixels);
  } else if (sniffImageType(bytes) == "image/vnd.radiance") {
    ImageSize size;
    if (checkHdrHeader(bytes, size).empty())
      report.takeMemory(file.string(), 16ull * size.width * size.height);
    DecodedHdr decoded;
    if (const std::string problem = decodeHdr(bytes, decoded); !problem.empty())
      fail(problem + "; a complete Radiance HDR image expected");
    image.width = decoded.width;
    image.height = decoded.height;
    pixels = std::move(decoded.pixels);
  } else {
    ImageSize size;
    if (checkImageHeader(bytes, size).empty())
      report.takeMemory(file.string(), 16ull * size.width * size.height);
    DecodedImage decoded;
    if (const std::string problem = decodeImage(bytes, decoded); !problem.empty())
      fail(problem + "; a complete PNG, JPEG, EXR or HDR expected");
    if (decoded.roundedFrom16Bit)
      report.warn("16-bit image", element.place, file.string() + " is rounded from 16 to 8 bits");
    image.width = decoded.width;
    image.height = decoded.height;
    image.texels = std::move(decoded.texels);
  }
  isFloat = !pixels.empty();
  scale = 1.0;
  if (isFloat) {
    double most = 0.0;
    for (const glm::vec3& p : pixels) {
      if (!std::isfinite(p.x + p.y + p.z)) fail("has pixels that are not finite");
      most = std::max(most, largest(glm::dvec3(p)));
    }
    scale = most > 0.0 ? most : 1.0;
    for (const glm::vec3& p : pixels) image.texels.push_back(texelOf(glm::dvec3(p) / scale));
    report.warn("image of floats", element.place,
                fmt::format("{} is rounded to sRGB of 8 bits, over its largest value {:g}",
                            file.string(), scale));
  }
  context_.scene.images.push_back(std::move(image));
  const uint32_t index = uint32_t(context_.scene.images.size() - 1);
  loaded_[file] = {index, isFloat, scale};
  return index;
}

TexturedColor Textures::bitmap(const Element& element) {
  Parameters p(element, context_);
  TextureUse use = useOf(p);
  const std::string filter =
      p.choice("filter_type", "bilinear", {"bilinear", "nearest", "ewa", "trilinear"});
  use.nearest = filter == "nearest";
  const auto wrap = [&](const char* name, const std::string& fallback) {
    return p.choice(name, fallback, {"repeat", "mirror", "clamp"});
  };
  const std::string both = wrap("wrap_mode", "repeat");
  const auto modeOf = [](const std::string& name) {
    return name == "clamp"    ? rl::RL_WRAP_CLAMP
           : name == "mirror" ? rl::RL_WRAP_MIRROR
                              : rl::RL_WRAP_REPEAT;
  };
  use.wrapU = modeOf(wrap("wrap_mode_u", both));
  use.wrapV = modeOf(wrap("wrap_mode_v", both));
  bool isRaw = p.boolean("raw", false);
  const double gamma = p.number("gamma", 0.0, -1.0, 10.0);
  if (gamma == 1.0) isRaw = true;
  if (gamma != 0.0 && gamma != 1.0 && gamma != -1.0)
    p.fail("gamma", fmt::format("'gamma' is {:g}; 1, or none for sRGB expected", gamma));
  p.ignore({"format", "accel", "cache", "max_anisotropy"});
  const std::string name = p.text("filename", "");
  if (!p.has("filename")) p.fail("filename", "the bitmap has no 'filename'");
  bool isFloat = false;
  TexturedColor result;
  double scale = 1.0;
  use.image = imageOf(context_.files.find(name, element.place), element, isFloat, scale);
  use.srgb = isFloat || !isRaw;
  result.factor = glm::dvec3(scale);
  result.use = add(use);
  p.finish();
  return result;
}

TexturedColor Textures::checkerboard(const Element& element) {
  Parameters p(element, context_);
  TextureUse use = useOf(p);
  const glm::dvec3 a = p.color("color0", glm::dvec3(0.4), Quantity::radiance),
                   b = p.color("color1", glm::dvec3(0.2), Quantity::radiance);
  p.finish();
  TwoValues channels[3];
  for (int c = 0; c < 3; ++c) {
    // Reflectances have factors up to 1.
    const double most = std::max(a[c], b[c]);
    channels[c] = twoValues(a[c], b[c], most <= 1.0 ? 1.0 : 4.0 * most);
  }
  const uint32_t texelA = packRgba(channels[0].a, channels[1].a, channels[2].a, 255u),
                 texelB = packRgba(channels[0].b, channels[1].b, channels[2].b, 255u);
  context_.scene.images.push_back({"checkerboard", 2, 2, {texelA, texelB, texelB, texelA}});
  use.image = uint32_t(context_.scene.images.size() - 1);
  use.srgb = true;
  use.nearest = true;
  return {glm::dvec3(channels[0].factor, channels[1].factor, channels[2].factor), add(use)};
}

// "scale" of version 0.6: a texture or a colour times a number.
TexturedColor Textures::scaled(const Element& element) {
  Parameters p(element, context_);
  const double scale = p.number("scale", 1.0, 0.0, 1e12);
  const std::vector<const Element*> inner = p.plugins("texture");
  p.finish();
  if (inner.size() != 1 || inner[0]->type == "scale")
    p.fail("", "texture 'scale' holds one other texture");
  TexturedColor result = texture(*inner[0]);
  result.factor *= scale;
  return result;
}

TexturedColor Textures::texture(const Element& element) {
  if (element.tag == "texture" && element.type == "bitmap") return bitmap(element);
  if (element.tag == "texture" && element.type == "checkerboard") return checkerboard(element);
  if (element.tag == "texture" && element.type == "scale") return scaled(element);
  const std::string text = fmt::format(
      "<{}> '{}' is unknown; texture bitmap or checkerboard expected", element.tag, element.type);
  if (!context_.allowsUnknown) context_.report.fail(element.place, text);
  context_.report.warn("unknown texture", element.place, text + "; it is drawn as 0.5");
  return {glm::dvec3(0.5), std::nullopt};
}

TexturedColor Textures::color(Parameters& p, const std::string& name, const glm::dvec3& fallback,
                              Quantity quantity) {
  const Element* element = p.find(name);
  if (element == nullptr || isColor(*element)) return {p.color(name, fallback, quantity), {}};
  TexturedColor result = texture(*element);
  const glm::dvec3 given = result.factor;
  if (quantity == Quantity::reflectance) result.factor = glm::min(result.factor, 1.0);
  if (given != result.factor)
    context_.report.warn("range of a colour", element->place,
                         fmt::format("'{}' has values up to {:g}; it is drawn with at most 1", name,
                                     largest(given)));
  return result;
}

TexturedNumber Textures::number(Parameters& p, const std::string& name, double fallback, double lo,
                                double hi) {
  const Element* element = p.find(name);
  if (element == nullptr || element->tag == "float" || element->tag == "integer")
    return {p.number(name, fallback, lo, hi), {}};
  if (isColor(*element)) {
    const double grey = luminance(p.color(name, glm::dvec3(fallback), Quantity::reflectance));
    if (!(grey >= lo && grey <= hi))
      p.fail(name, fmt::format("'{}' is {:g}; {:g} to {:g} expected", name, grey, lo, hi));
    return {grey, {}};
  }
  const TexturedColor found = texture(*element);
  return {std::clamp(found.factor.x, lo, hi), found.use};
}

double Textures::constant(Parameters& p, const std::string& name, double fallback, double lo,
                          double hi) {
  const TexturedNumber found = number(p, name, fallback, lo, hi);
  if (!found.use) return found.factor;
  const TextureUse& use = context_.scene.textureUses[*found.use];
  const std::vector<uint32_t>& texels = context_.scene.images[use.image].texels;
  double sum = 0.0;
  for (const uint32_t texel : texels) sum += channelOf(use, texel, 0);
  const double mean = std::clamp(found.factor * sum / double(texels.size()), lo, hi);
  context_.report.warn(
      "texture of " + name, p.find(name)->place,
      fmt::format("'{}' takes no texture here; its mean {:.4g} is drawn", name, mean));
  return mean;
}

uint32_t Textures::withCoverage(uint32_t coverage, const std::optional<uint32_t>& color,
                                const std::string& place) {
  const TextureUse ofCoverage = context_.scene.textureUses[coverage];
  TextureUse use = ofCoverage;
  const TextureImage& alpha = context_.scene.images[ofCoverage.image];
  TextureImage image{alpha.name + " as coverage", alpha.width, alpha.height, {}};
  use.srgb = true;
  if (color) {
    const TextureUse ofColor = context_.scene.textureUses[*color];
    use.srgb = ofColor.srgb;
    use.nearest = ofColor.nearest;
    if (ofColor.uvRow0 != use.uvRow0 || ofColor.uvRow1 != use.uvRow1)
      context_.report.fail(place,
                           "a mask and the texture that it covers differ in to_uv; the same "
                           "transform expected");
    const TextureImage& base = context_.scene.images[ofColor.image];
    image.width = std::max(alpha.width, base.width);
    image.height = std::max(alpha.height, base.height);
  }
  context_.report.takeMemory(place, 4ull * image.width * image.height);
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const auto nearest = [&](const TextureImage& i) {
        const uint64_t column = uint64_t(x) * i.width / image.width,
                       row = uint64_t(y) * i.height / image.height;
        return i.texels[size_t(row * i.width + column)];
      };
      const uint32_t base =
          color ? nearest(context_.scene.images[context_.scene.textureUses[*color].image])
                : 0xffffffu;
      const uint32_t covered = byteOf(channelOf(ofCoverage, nearest(alpha), 0));
      image.texels.push_back((base & 0xffffffu) | (covered << 24));
    }
  }
  context_.scene.images.push_back(std::move(image));
  use.image = uint32_t(context_.scene.images.size() - 1);
  return add(use);
}

}  // namespace restlab::mitsuba
