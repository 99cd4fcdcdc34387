// A glTF document in memory: tinygltf's model, all buffers, and the images still encoded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/gltf/container.h"
#include "core/scene/gltf/report.h"
#include "core/scene/gltf/tinygltf.h"

namespace restlab::gltf {

struct EncodedImage {
  std::string source;     // file name, or the kind of embedding: for error lines
  std::string mediaType;  // declared by the document; may be empty
  std::vector<uint8_t> bytes;
};

struct Document {
  tinygltf::Model model;
  std::vector<EncodedImage> images;
  uint64_t contentHash = 0;  // bytes of the glTF, then every buffer, then every image
};

// Loads every resource of a validated document and passes a normalised copy to tinygltf: resources
// have generated names that this loader serves, and parts that are not imported (animations, skins,
// extras) are left out. tinygltf therefore never opens a file and never sees a URI.
Document loadDocument(Container container, const std::filesystem::path& directory, Report& report);

}  // namespace restlab::gltf
