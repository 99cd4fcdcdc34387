#include "core/scene/gltf/texture.h"

#include <fmt/format.h>

#include <cmath>

#include "core/scene/textures/image_decode.h"

namespace restlab::gltf {
namespace {

uint32_t wrapMode(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return rl::RL_WRAP_CLAMP;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return rl::RL_WRAP_MIRROR;
    default:
      return rl::RL_WRAP_REPEAT;
  }
}

double numberAt(const tinygltf::Value& array, int index) {
  return array.Get(index).GetNumberAsDouble();
}

// uv' = translation * rotation * scale * uv. Positive angles turn the UVs counter-clockwise as seen
// in the image, whose v axis points down; the sign is that of Khronos' TextureTransformTest.
void applyTransform(const tinygltf::Value& transform, TextureUse& use) {
  double offset[2] = {0, 0}, scale[2] = {1, 1}, rotation = 0;
  if (transform.Has("offset")) {
    for (int i = 0; i < 2; ++i) offset[i] = numberAt(transform.Get("offset"), i);
  }
  if (transform.Has("scale")) {
    for (int i = 0; i < 2; ++i) scale[i] = numberAt(transform.Get("scale"), i);
  }
  if (transform.Has("rotation")) rotation = transform.Get("rotation").GetNumberAsDouble();
  const double c = std::cos(rotation), s = std::sin(rotation);
  use.uvRow0 = glm::dvec3(c * scale[0], s * scale[1], offset[0]);
  use.uvRow1 = glm::dvec3(-s * scale[0], c * scale[1], offset[1]);
}

}  // namespace

TextureImporter::TextureImporter(const Document& document, Scene& scene, Report& report)
    : document_(document),
      scene_(scene),
      report_(report),
      sceneImage_(document.images.size(), rl::RL_INVALID) {}

uint32_t TextureImporter::decodedImage(int index, const std::string& place) {
  uint32_t& sceneIndex = sceneImage_[static_cast<size_t>(index)];
  if (sceneIndex != rl::RL_INVALID) return sceneIndex;
  const EncodedImage& encoded = document_.images[static_cast<size_t>(index)];
  const std::string imagePlace = fmt::format("images[{}]", index);
  ImageSize size;
  if (checkImageHeader(encoded.bytes, size).empty()) {
    // Inflated file, the decoder's pixels, and texels; more if a channel has 16 bits.
    constexpr uint64_t kBytesPerPixel = 16;
    report_.takeMemory(imagePlace,
                       fmt::format("{}: {}x{} pixels", encoded.source, size.width, size.height),
                       kBytesPerPixel * size.width * size.height);
  }
  DecodedImage decoded;
  if (const std::string problem = decodeImage(encoded.bytes, decoded); !problem.empty()) {
    report_.fail(imagePlace, fmt::format("{}: {}; a complete PNG or JPEG expected (used by {})",
                                         encoded.source, problem, place));
  }
  if (decoded.roundedFrom16Bit) {
    report_.warn("16-bit image", imagePlace, encoded.source + " is rounded from 16 to 8 bits");
  }
  const tinygltf::Image& image = document_.model.images[static_cast<size_t>(index)];
  sceneIndex = static_cast<uint32_t>(scene_.images.size());
  scene_.images.push_back({image.name.empty() ? encoded.source : image.name, decoded.width,
                           decoded.height, std::move(decoded.texels)});
  return sceneIndex;
}

uint32_t TextureImporter::add(const TextureReference& reference, bool srgb,
                              const std::string& place) {
  const tinygltf::Model& model = document_.model;
  const tinygltf::Texture& texture = model.textures[static_cast<size_t>(reference.index)];
  const std::string texturePlace = fmt::format("textures[{}]", reference.index);
  TextureUse use;
  use.srgb = srgb;
  int texCoord = reference.texCoord;
  if (reference.extensions) {
    const auto transform = reference.extensions->find("KHR_texture_transform");
    if (transform != reference.extensions->end()) {
      applyTransform(transform->second, use);
      if (transform->second.Has("texCoord")) {
        texCoord = transform->second.Get("texCoord").GetNumberAsInt();
      }
    }
  }
  if (texCoord < 0 || texCoord >= static_cast<int>(rl::RL_MAX_UV_SETS)) {
    report_.fail(place + ".texCoord", fmt::format("{} is not supported; 0 to {} expected", texCoord,
                                                  rl::RL_MAX_UV_SETS - 1));
  }
  use.uvSet = static_cast<uint32_t>(texCoord);
  if (texture.source < 0) {
    std::string extensions;
    for (const auto& [name, unused] : texture.extensions)
      extensions += " (" + name + " is not read)";
    report_.fail(
        texturePlace + ".source",
        fmt::format("is missing{}; a PNG or JPEG expected (used by {})", extensions, place));
  }
  if (static_cast<size_t>(texture.source) >= model.images.size()) {
    report_.fail(texturePlace + ".source",
                 fmt::format("{} does not exist; the file has {} images (used by {})",
                             texture.source, model.images.size(), place));
  }
  if (texture.sampler >= 0) {
    if (static_cast<size_t>(texture.sampler) >= model.samplers.size()) {
      report_.fail(texturePlace + ".sampler",
                   fmt::format("{} does not exist; the file has {} samplers (used by {})",
                               texture.sampler, model.samplers.size(), place));
    }
    const tinygltf::Sampler& sampler = model.samplers[static_cast<size_t>(texture.sampler)];
    use.wrapU = wrapMode(sampler.wrapS);
    use.wrapV = wrapMode(sampler.wrapT);
    // Minification filters have no meaning for a path tracer that reads the finest level.
    use.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  }
  use.image = decodedImage(texture.source, place);
  scene_.textureUses.push_back(use);
  return static_cast<uint32_t>(scene_.textureUses.size() - 1);
}

void TextureImporter::checkUnusedImages() {
  for (size_t i = 0; i < document_.images.size(); ++i) {
    const EncodedImage& encoded = document_.images[i];
    const std::string place = fmt::format("images[{}]", i);
    const std::string found = sniffImageType(encoded.bytes);
    const std::string& declared = encoded.mediaType;
    if (!declared.empty() && !found.empty() && declared != found) {
      report_.warn("image type", place,
                   fmt::format("{} is {}, but declared as {}", encoded.source, found, declared));
    }
    if (sceneImage_[i] != rl::RL_INVALID) continue;
    ImageSize size;
    const std::string problem = checkImageHeader(encoded.bytes, size);
    if (problem.empty()) continue;
    // A broken PNG or JPEG means a broken file; other formats may belong to an extension.
    if (!found.empty()) report_.fail(place, encoded.source + ": " + problem);
    report_.warn("unused image", place,
                 fmt::format("{}: {}; no material that is read uses it", encoded.source, problem));
  }
  const tinygltf::Model& model = document_.model;
  for (size_t i = 0; i < model.textures.size(); ++i) {
    const tinygltf::Texture& texture = model.textures[i];
    const auto dangling = [&](int index, size_t size, const char* what) {
      if (index < 0 || static_cast<size_t>(index) < size) return;
      report_.warn("dangling texture", fmt::format("textures[{}].{}", i, what),
                   fmt::format("{} does not exist; no material that is read uses it", index));
    };
    dangling(texture.source, model.images.size(), "source");
    dangling(texture.sampler, model.samplers.size(), "sampler");
  }
}

}  // namespace restlab::gltf
