// writeGltf(): the parts of the document in order, images and surroundings beside it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/image/color.h"
#include "core/image/image.h"
#include "core/image/io/atomic_file.h"
#include "core/image/io/png.h"
#include "core/scene/gltf_write/document.h"
#include "core/scene/gltf_write/gltf_write.h"
#include "core/scene/scene_file/scene_file.h"

namespace restlab {
namespace gltf_write {
namespace {

// Conversion of an image's colours: as they are, decoded from sRGB, or encoded.
enum Encoding { asItIs, toLinear, toSrgb };

uint32_t converted(uint32_t channel, Encoding encoding) {
  if (encoding == asItIs) return channel;
  const double unit = double(channel) / 255.0;
  return uint32_t(
      std::lround(255.0 * (encoding == toLinear ? decodeSrgb(unit) : encodeSrgb(unit))));
}

std::string escaped(const std::string& name) {
  std::string uri;
  for (const char c : name) {
    const unsigned char byte = static_cast<unsigned char>(c);
    const bool isPlain = std::isalnum(byte) != 0 || c == '-' || c == '_' || c == '.';
    uri += isPlain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return uri;
}

int wrapOf(uint32_t mode) {
  return mode == rl::RL_WRAP_CLAMP ? 33071 : mode == rl::RL_WRAP_MIRROR ? 33648 : 10497;
}

// KHR_texture_transform of the rows; nullopt if they shear.
std::optional<nlohmann::json> transformOf(const TextureUse& use) {
  const glm::dvec3 r0(use.uvRow0), r1(use.uvRow1);
  const double sx = std::hypot(r0.x, r1.x);
  const double c = sx > 0.0 ? r0.x / sx : 1.0, s = sx > 0.0 ? -r1.x / sx : 0.0;
  const double sy = s * r0.y + c * r1.y;
  const double shear = std::hypot(r0.y - s * sy, r1.y - c * sy);
  if (shear > 1e-5 * std::max(sx, std::abs(sy))) return std::nullopt;
  return nlohmann::json{
      {"offset", {r0.z, r1.z}}, {"rotation", std::atan2(s, c)}, {"scale", {sx, sy}}};
}

bool hasSurroundings(const Scene& scene) {
  return scene.environment || scene.background || scene.ambient != glm::vec3(0.0f);
}

std::filesystem::path besideOf(const Output& output, const char* extension) {
  return output.file.parent_path() / (output.stem() + extension);
}

// Returns whether a scene file has nothing but what writeSurroundings() writes for that base.
bool holdsSurroundingsAlone(const std::filesystem::path& file, const std::string& base) {
  try {
    const ConfigTable table = ConfigTable::parseFile(file);
    const auto isOurs = [](const std::string& key) {
      return key == "base" || key == "environment" || key == "background" || key == "light";
    };
    const std::vector<std::string> keys = table.keys();
    return std::all_of(keys.begin(), keys.end(), isOurs) && table.getString("base", "") == base;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

size_t Output::add(const char* array, nlohmann::json object) {
  nlohmann::json& list = json[array];
  list.push_back(std::move(object));
  return list.size() - 1;
}

std::pair<size_t, std::string> Images::imageOf(uint32_t use, bool isSrgb) {
  const TextureUse& texture = scene_.textureUses.at(use);
  const Encoding encoding = texture.srgb == isSrgb ? asItIs : texture.srgb ? toLinear : toSrgb;
  const auto [entry, isNew] = written_.try_emplace({texture.image, int(encoding)});
  if (!isNew) return entry->second;
  const TextureImage& image = scene_.images.at(texture.image);
  std::vector<uint8_t> bytes;
  bytes.reserve(size_t(image.width) * image.height * 4);
  for (const uint32_t texel : image.texels) {
    for (int c = 0; c < 3; ++c)
      bytes.push_back(uint8_t(converted((texel >> (8 * c)) & 255u, encoding)));
    bytes.push_back(uint8_t(texel >> 24));
  }
  const std::string name = fmt::format("{}-{}.png", output_.stem(), written_.size());
  const std::filesystem::path file = output_.file.parent_path() / name;
  writeTextFile(file, encodePng(file.string(), image.width, image.height, bytes.data(), {}, 4));
  entry->second = {output_.add("images", {{"uri", escaped(name)}}), name};
  return entry->second;
}

std::string Images::fileOf(uint32_t use, bool isSrgb) { return imageOf(use, isSrgb).second; }

nlohmann::json Images::info(uint32_t use, bool isSrgb) {
  const TextureUse& texture = scene_.textureUses.at(use);
  const size_t image = imageOf(use, isSrgb).first;
  const nlohmann::json sampler = {{"magFilter", texture.nearest ? 9728 : 9729},
                                  {"wrapS", wrapOf(texture.wrapU)},
                                  {"wrapT", wrapOf(texture.wrapV)}};
  nlohmann::json info = {
      {"index", output_.add("textures",
                            {{"source", image}, {"sampler", output_.add("samplers", sampler)}})}};
  if (texture.uvSet != 0) info["texCoord"] = texture.uvSet;
  if (texture.uvRow0 == glm::vec3(1, 0, 0) && texture.uvRow1 == glm::vec3(0, 1, 0)) return info;
  const std::optional<nlohmann::json> transform = transformOf(texture);
  if (transform) {
    info["extensions"]["KHR_texture_transform"] = *transform;
    output_.extensions.insert("KHR_texture_transform");
  } else {
    output_.notes.push_back(
        fmt::format("{}: a texture's transform shears; it is left out", output_.file.string()));
  }
  return info;
}

void requireFree(const Scene& scene, const Output& output) {
  std::vector<std::filesystem::path> all = {output.file, besideOf(output, ".bin")};
  const bool isSurrounded = hasSurroundings(scene);
  if (isSurrounded) all.push_back(besideOf(output, ".scene.toml"));
  std::error_code error;
  for (const std::filesystem::path& file : all)
    for (const std::filesystem::path& input : filesOfScene(scene))
      if (std::filesystem::equivalent(file, input, error))
        failUsage(
            fmt::format("{}: is a file that the scene is made from, and would be written "
                        "beside {}; give that another name",
                        file.string(), output.file.string()));
  if (isSurrounded && std::filesystem::exists(all.back(), error) &&
      !holdsSurroundingsAlone(all.back(), output.stem() + ".gltf"))
    failUsage(
        fmt::format("{0}: is there, and holds more than what surrounds {1}; give {1} another "
                    "name, or move it away",
                    all.back().string(), output.file.string()));
}

void writeSurroundings(const Scene& scene, Output& output) {
  if (!hasSurroundings(scene)) return;
  const std::string stem = output.stem();
  const std::filesystem::path folder = output.file.parent_path();
  std::string text = fmt::format("base = \"{}.gltf\"\n", stem);
  if (scene.environment) {
    const EnvironmentMap& map = *scene.environment;
    Image sky(map.width, map.height);
    sky.pixels = map.radiance;
    LayeredImage layers;
    layers.layers[""] = std::move(sky);
    writeExr(folder / (stem + "-sky.exr"), layers);
    text += fmt::format(
        "[environment]\nfile = \"{}-sky.exr\"\nrotation = {}\nscale = {}\n", stem,
        std::remainder(double(map.rotation), 2.0 * std::numbers::pi) * 180.0 / std::numbers::pi,
        map.scale);
  }
  const auto triple = [](const glm::vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); };
  if (scene.background)
    text += fmt::format("[background]\nradiance = {}\n", triple(*scene.background));
  if (scene.ambient != glm::vec3(0.0f))
    text += fmt::format("[[light]]\nkind = \"ambient\"\nradiance = {}\n", triple(scene.ambient));
  writeTextFile(besideOf(output, ".scene.toml"), text);
  output.notes.push_back(
      fmt::format("{}: has no sky: render {} instead, which has it and begins with this file",
                  output.file.string(), besideOf(output, ".scene.toml").string()));
}

}  // namespace gltf_write

std::vector<std::string> writeGltf(const Scene& scene, const std::filesystem::path& file) {
  gltf_write::Output output;
  output.file = file;
  gltf_write::requireFree(scene, output);
  gltf_write::Images images(scene, output);
  gltf_write::addMaterials(scene, images, output);
  gltf_write::addNodes(scene, output);
  gltf_write::writeSurroundings(scene, output);
  if (!output.extensions.empty()) output.json["extensionsUsed"] = output.extensions;
  const std::filesystem::path binary = gltf_write::besideOf(output, ".bin");
  if (!output.bytes.empty()) {
    output.json["buffers"] = {{{"uri", gltf_write::escaped(output.stem() + ".bin")},
                               {"byteLength", output.bytes.size()}}};
    writeTextFile(binary, output.bytes);
  }
  writeTextFile(file,
                output.json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  return output.notes;
}

}  // namespace restlab
