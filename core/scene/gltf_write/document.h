// The document that is being written, and the bytes beside it.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "core/scene/scene.h"

namespace restlab::gltf_write {

struct Output {
  std::filesystem::path file;  // .gltf
  nlohmann::json json = {{"asset", {{"version", "2.0"}, {"generator", "restlab"}}}};
  std::string bytes;  // of the .bin
  std::set<std::string> extensions;
  std::vector<std::string> notes;

  std::string stem() const { return file.stem().string(); }
  // Appends to a top-level array; returns the index.
  size_t add(const char* array, nlohmann::json object);
};

// Images are written once for each encoding that they are read with.
class Images {
 public:
  Images(const Scene& scene, Output& output) : scene_(scene), output_(output) {}

  // "textureInfo" of a use that a slot reads as sRGB or as linear numbers.
  nlohmann::json info(uint32_t use, bool isSrgb);
  // Name of the file of a use, for extras.
  std::string fileOf(uint32_t use, bool isSrgb);

 private:
  std::pair<size_t, std::string> imageOf(uint32_t use, bool isSrgb);  // index, file
  const Scene& scene_;
  Output& output_;
  std::map<std::pair<uint32_t, int>, std::pair<size_t, std::string>> written_;
};

// The keys of [[material]] for a material of the scene, but for its textures. Throws Error
// (badInput) for tables.
nlohmann::json kindWithoutTextures(const Scene& scene, size_t index);
void addMaterials(const Scene& scene, Images& images, Output& output);
// Nodes of instances, cameras and lights.
void addNodes(const Scene& scene, Output& output);
// Throws Error (badUsage) if one of the files is what the scene is made from, or if the scene file
// of surroundings is there and holds other things.
void requireFree(const Scene& scene, const Output& output);
// Surroundings of the scene; nothing if it has none.
void writeSurroundings(const Scene& scene, Output& output);

}  // namespace restlab::gltf_write
