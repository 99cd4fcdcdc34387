#include "tests/scene/gltf_builder.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "core/base/error.h"

namespace restlab::test {
namespace fs = std::filesystem;
using nlohmann::json;

TempDirectory::TempDirectory() {
  std::string pattern = (fs::temp_directory_path() / "restlab-scene-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make " + pattern);
  path_ = pattern;
}

TempDirectory::~TempDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TempDirectory::write(const std::string& name, const std::string& content) const {
  const fs::path file = path_ / name;
  fs::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  if (!stream) throw std::runtime_error("cannot write " + file.string());
  return file;
}

size_t GltfBuilder::componentsOf(const std::string& type) {
  static const std::map<std::string, size_t> counts = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  return counts.at(type);
}

int GltfBuilder::bufferView(const void* bytes, size_t size) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  const size_t offset = bytes_.size();
  bytes_.append(static_cast<const char*>(bytes), size);
  return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
}

int GltfBuilder::addAccessor(int view, size_t byteOffset, size_t count, int type,
                             const std::string& shape, bool normalized) {
  json object = {{"bufferView", view},
                 {"byteOffset", byteOffset},
                 {"count", count},
                 {"componentType", type},
                 {"type", shape}};
  if (normalized) object["normalized"] = true;
  return add("accessors", object);
}

int GltfBuilder::add(const char* array, const json& object) {
  doc[array].push_back(object);
  return static_cast<int>(doc[array].size()) - 1;
}

int GltfBuilder::mesh(const json& primitive) {
  return add("meshes", {{"primitives", json::array({primitive})}});
}

int GltfBuilder::triangle(const json& more) {
  json primitive = {
      {"attributes", {{"POSITION", accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}}}};
  primitive.merge_patch(more);
  return mesh(primitive);
}

int GltfBuilder::node(const json& object) {
  const int index = add("nodes", object);
  if (!doc.contains("scenes")) doc["scenes"] = json::array({{{"nodes", json::array()}}});
  doc["scenes"][0]["nodes"].push_back(index);
  return index;
}

fs::path GltfBuilder::write() {
  if (!bytes_.empty() && !doc.contains("buffers")) {
    doc["buffers"] = json::array({{{"byteLength", bytes_.size()}, {"uri", "test.bin"}}});
  }
  if (!bytes_.empty()) directory_.write("test.bin", bytes_);
  return directory_.write(fileName, doc.dump());
}

Scene GltfBuilder::load() { return loadGltf(write()); }

std::string GltfBuilder::error() {
  const fs::path file = write();
  try {
    loadGltf(file);
  } catch (const Error& error) {
    return error.code() == ExitCode::badInput ? placeAndText(error.what(), file)
                                              : std::string("wrong exit code: ") + error.what();
  }
  return "";
}

std::string placeAndText(const std::string& line, const fs::path& file) {
  const std::string prefix = file.string() + ": ";
  if (line.compare(0, prefix.size(), prefix) != 0)
    return "line does not begin with the file: " + line;
  if (line.find('\n') != std::string::npos) return "more than one line: " + line;
  return line.substr(prefix.size());
}

bool warns(const Scene& scene, const std::string& text) {
  for (const std::string& warning : scene.warnings) {
    if (warning.find(text) != std::string::npos) return true;
  }
  return false;
}

std::string glb(const std::string& jsonText, const std::string& binary, uint32_t extraLength) {
  const auto u32 = [](size_t number) {
    const uint32_t value = static_cast<uint32_t>(number);
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto chunk = [&](uint32_t type, std::string data, char pad) {
    while (data.size() % 4 != 0) data += pad;
    return u32(data.size()) + u32(type) + data;
  };
  std::string body = chunk(0x4e4f534a, jsonText, ' ');
  if (!binary.empty()) body += chunk(0x004e4942, binary, '\0');
  return "glTF" + u32(2) + u32(12 + body.size() + extraLength) + body;
}

std::string base64(const std::string& bytes) {
  static const char kAlphabet[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kAlphabet[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

namespace {

std::string bigEndian(uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
          static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::string pngChunk(const std::string& type, const std::string& data) {
  uint32_t crc = 0xffffffffu;
  for (const unsigned char c : type + data) {
    crc ^= c;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return bigEndian(static_cast<uint32_t>(data.size())) + type + data + bigEndian(~crc);
}

std::string png(uint8_t bitDepth, const std::string& row) {
  const std::string scanline = std::string(1, '\0') + row;  // filter: none
  const uint16_t size = static_cast<uint16_t>(scanline.size()),
                 inverse = static_cast<uint16_t>(~size);
  uint32_t a = 1, b = 0;
  for (const unsigned char c : scanline) {
    a = (a + c) % 65521;
    b = (b + a) % 65521;
  }
  // zlib header and one stored block, little-endian lengths.
  const std::string stored =
      std::string("\x78\x01\x01", 3) +
      std::string{static_cast<char>(size), static_cast<char>(size >> 8), static_cast<char>(inverse),
                  static_cast<char>(inverse >> 8)} +
      scanline + bigEndian(b << 16 | a);
  std::string header = bigEndian(2) + bigEndian(1);
  header += {static_cast<char>(bitDepth), 6, 0, 0, 0};  // RGBA
  return std::string("\x89PNG\r\n\x1a\n") + pngChunk("IHDR", header) + pngChunk("IDAT", stored) +
         pngChunk("IEND", "");
}

}  // namespace

std::string tinyPng() { return png(8, std::string("\xff\x00\x00\xff\x00\xff\x00\x80", 8)); }

std::string tinyPng16() {
  const std::string pixel("\xff\xff\x01\xff\x00\x80\x7f\x7f", 8);
  return png(16, pixel + pixel);
}

}  // namespace restlab::test
