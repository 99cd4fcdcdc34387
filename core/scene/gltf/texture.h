// Textures of materials: decoded images, samplers, KHR_texture_transform.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/gltf/document.h"
#include "core/scene/gltf/report.h"
#include "core/scene/scene.h"

namespace restlab::gltf {

// A textureInfo object, from any of tinygltf's types or extension values.
struct TextureReference {
  int index = -1;
  int texCoord = 0;
  const tinygltf::ExtensionMap* extensions = nullptr;
  tinygltf::ExtensionMap ownedExtensions;  // if read from an extension's value
};

class TextureImporter {
 public:
  TextureImporter(const Document& document, Scene& scene, Report& report);

  // Adds a texture use to the scene and returns its index; decodes the image at its first use.
  // `place` is that of the textureInfo, for error lines.
  uint32_t add(const TextureReference& reference, bool srgb, const std::string& place);

  // Adds a use of the roughness 1 - glossiness x alpha of an image, in the channel where
  // RL_TEX_METALLIC_ROUGHNESS has it; blue is 1.
  uint32_t addRoughness(const TextureReference& reference, double glossiness,
                        const std::string& place);

  // Reports broken images that no supported slot uses, without decoding them.
  void checkUnusedImages();

 private:
  uint32_t decodedImage(int index, const std::string& place);

  const Document& document_;
  Scene& scene_;
  Report& report_;
  std::vector<uint32_t> sceneImage_;  // by glTF image; RL_INVALID: not decoded yet
  std::map<std::pair<uint32_t, double>, uint32_t> roughnessImage_;  // by image and glossiness
};

}  // namespace restlab::gltf
