// Composes small glTF files in a temporary directory.
#pragma once

#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab::test {

// A temporary directory, removed on destruction.
class TempDirectory {
 public:
  TempDirectory();
  ~TempDirectory();
  TempDirectory(const TempDirectory&) = delete;
  TempDirectory& operator=(const TempDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }
  // Writes a file below the directory and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

// A glTF document whose numbers go into one buffer. Tests may change `doc` freely before load().
class GltfBuilder {
 public:
  nlohmann::json doc = {{"asset", {{"version", "2.0"}}}};
  std::string fileName = "test.gltf";

  // Appends bytes, aligned to four; returns the index of a new buffer view of them.
  int bufferView(const void* bytes, size_t size);

  // Accessor of packed values; `type` as in glTF ("VEC3"); the component type is T's.
  template <class T>
  int accessor(const std::vector<T>& values, const std::string& type, bool normalized = false) {
    return addAccessor(bufferView(values.data(), values.size() * sizeof(T)), 0,
                       values.size() / componentsOf(type), componentType(T()), type, normalized);
  }
  int addAccessor(int view, size_t byteOffset, size_t count, int componentType,
                  const std::string& type, bool normalized = false);

  // Adds a mesh of one primitive; returns its index.
  int mesh(const nlohmann::json& primitive);
  // Adds a mesh of the triangle (0,0,0) (1,0,0) (0,1,0), without indices.
  int triangle(const nlohmann::json& more = nlohmann::json::object());
  // Appends to a top-level array; returns the index.
  int add(const char* array, const nlohmann::json& object);
  // Adds a root node of the scene.
  int node(const nlohmann::json& object);

  // Write the file and load it. error() returns the line of the Error thrown, "" if none was.
  Scene load();
  std::string error();
  std::filesystem::path write();
  const TempDirectory& directory() const { return directory_; }
  const std::string& bytes() const { return bytes_; }

  static int componentType(int8_t) { return 5120; }
  static int componentType(uint8_t) { return 5121; }
  static int componentType(int16_t) { return 5122; }
  static int componentType(uint16_t) { return 5123; }
  static int componentType(uint32_t) { return 5125; }
  static int componentType(float) { return 5126; }
  static size_t componentsOf(const std::string& type);

 private:
  TempDirectory directory_;
  std::string bytes_;
};

// Returns the part of an error line behind the file's name.
std::string placeAndText(const std::string& line, const std::filesystem::path& file);
// Returns whether one of the warnings contains `text`.
bool warns(const Scene& scene, const std::string& text);
// Makes a GLB of a JSON chunk and, unless empty, a BIN chunk; its header declares a length too
// large by `extraLength`.
std::string glb(const std::string& jsonText, const std::string& binary, uint32_t extraLength = 0);
std::string base64(const std::string& bytes);
// A PNG of 2 x 1 pixels: red, and half transparent green (stored without compression).
std::string tinyPng();
// A PNG of 2 x 1 pixels with 16 bits per channel: (0xffff, 0x01ff, 0x0080, 0x7f7f) twice.
std::string tinyPng16();

}  // namespace restlab::test
