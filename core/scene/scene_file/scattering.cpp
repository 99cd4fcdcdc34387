#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "core/scene/content_hash.h"
#include "core/scene/gltf/material.h"
#include "core/scene/scene_file/scene_file.h"
#include "core/scene/textures/image_decode.h"
#include "core/shading/bsdf.h"

namespace restlab {
namespace fs = std::filesystem;
namespace {

using Kind = ClosureParameter::Kind;

std::vector<uint8_t> bytesOf(const fs::path& file, const std::string& place) {
  std::error_code error;
  const bool isFile = fs::is_regular_file(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (!isFile || !stream) {
    const std::string reason = unreadableReason(file);
    failInput(
        fmt::format("{}: {}: {}", place, file.string(), reason.empty() ? "is not a file" : reason));
  }
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

glm::uvec3 bits(const glm::dvec3& v) {
  return {std::bit_cast<uint32_t>(float(v.x)), std::bit_cast<uint32_t>(float(v.y)),
          std::bit_cast<uint32_t>(float(v.z))};
}
glm::vec3 floats(const glm::uvec3& words) {
  return {std::bit_cast<float>(words.x), std::bit_cast<float>(words.y),
          std::bit_cast<float>(words.z)};
}

glm::dvec3 readColor(const ConfigTable& table, const ClosureParameter& p) {
  if (!table.has(p.name)) return glm::dvec3(p.fallback);
  const bool isGrey = table.getTexts(p.name).size() == 1;
  const std::vector<double> v = table.getNumbers(p.name, {}, isGrey ? 1 : 3, p.lo, p.hi);
  return isGrey ? glm::dvec3(v[0]) : glm::dvec3(v[0], v[1], v[2]);
}

uint32_t readWrap(const ConfigTable& table, const std::string& key) {
  const std::string mode = table.getChoice(key, "repeat", {"repeat", "clamp", "mirror"});
  return mode == "clamp"    ? rl::RL_WRAP_CLAMP
         : mode == "mirror" ? rl::RL_WRAP_MIRROR
                            : rl::RL_WRAP_REPEAT;
}

// NAME_texture, how it lies on the surface and, of a number, NAME_channel. Factors below 1 would
// leave the range of what begins above 0.
void readTexture(const ConfigTable& table, const ClosureParameter& p, SceneFileInputs& inputs,
                 ClosureValue& value) {
  const std::string key = p.name + "_texture";
  if (p.lo > 0.0 || !table.has(key)) return;
  const bool isColor = p.kind == Kind::color;
  TextureUse use;
  use.srgb = isColor;
  use.uvSet = uint32_t(table.getInteger(p.name + "_uv_set", 0, 0, int64_t(rl::RL_MAX_UV_SETS) - 1));
  const std::vector<double> rows =
      table.getNumbers(p.name + "_transform", {1.0, 0.0, 0.0, 0.0, 1.0, 0.0}, 6, -1e6, 1e6);
  use.uvRow0 = glm::vec3(rows[0], rows[1], rows[2]);
  use.uvRow1 = glm::vec3(rows[3], rows[4], rows[5]);
  use.nearest =
      table.getChoice(p.name + "_filter", "bilinear", {"bilinear", "nearest"}) == "nearest";
  use.wrapU = readWrap(table, p.name + "_wrap_u");
  use.wrapV = readWrap(table, p.name + "_wrap_v");
  value.texture = inputs.addTexture(table.getString(key, ""), use, table.place(key));
  if (isColor) return;
  const std::vector<std::string> channels = {"r", "g", "b", "a"};
  const std::string channel = table.getChoice(p.name + "_channel", "r", channels);
  value.channel = uint32_t(std::find(channels.begin(), channels.end(), channel) - channels.begin());
}

ClosureValue readValue(const ConfigTable& table, const MaterialKind& kind,
                       const ClosureParameter& p, SceneFileInputs& inputs) {
  ClosureValue value;
  if (p.kind == Kind::table || p.kind == Kind::material) {
    const std::string name = table.getString(p.name, "");
    if (p.kind == Kind::material) value.words.x = rl::RL_INVALID;
    if (name.empty() && !p.isOptional)
      table.fail(p.name, fmt::format("kind '{}' has no '{}': {}", kind.name, p.name, p.help));
    if (name.empty()) return value;
    if (p.kind == Kind::table) {
      value.table = inputs.addTable(name, table.place(p.name));
    } else {
      value.words.x = inputs.addPart(name, table.place(p.name));
    }
    return value;
  }
  if (p.kind == Kind::choice) {
    const std::string choice = table.getChoice(p.name, p.choices[size_t(p.fallback)], p.choices);
    value.words.x =
        uint32_t(std::find(p.choices.begin(), p.choices.end(), choice) - p.choices.begin());
    return value;
  }
  if (p.kind == Kind::color) {
    value.words = bits(readColor(table, p));
  } else {
    value.words = bits(glm::dvec3(table.getNumber(p.name, p.fallback, p.lo, p.hi)));
  }
  // The lobes of glTF take a texture of the colour alone.
  if (kind.closure != nullptr || p.name == "color") readTexture(table, p, inputs, value);
  return value;
}

const MaterialKind& readKind(const ConfigTable& table) {
  std::vector<std::string> names;
  for (const MaterialKind& kind : materialKinds()) names.push_back(kind.name);
  if (!table.has("kind"))
    table.fail("", fmt::format("[[material]] has no 'kind'; one of {}", fmt::join(names, ", ")));
  const std::string name = table.getChoice("kind", names[0], names);
  return *std::find_if(materialKinds().begin(), materialKinds().end(),
                       [&](const MaterialKind& kind) { return kind.name == name; });
}

template <class Indices>
auto findPath(const Indices& indices, const fs::path& path) {
  return std::find_if(indices.begin(), indices.end(),
                      [&](const auto& entry) { return entry.first == path; });
}

// The lobes of glTF that a kind stands for; values: its parameters by name.
class Lobes {
 public:
  Lobes(const MaterialKind& kind, const std::vector<ClosureValue>& values)
      : kind_(kind), values_(values) {}

  void apply(Scattering& s) const {
    rl::Material& m = s.lobes;
    m = gltf::makeDefaultMaterial();
    m.metallic = 0.0f;
    m.specular = 0.0f;
    if (kind_.name == "black") {
      s.flags |= rl::RL_MATERIAL_BLACK;
      m.baseColor = glm::vec3(0.0f);
    }
    setColor(m);
    if (kind_.name == "gltf") return applyGltf(s);
    if (!has("ior")) return;
    m.ior = number("ior");
    m.roughness = std::sqrt(number("alpha"));
    m.specular = 1.0f;
    if (kind_.name == "plastic") return;
    m.transmission = 1.0f;
    if (has("absorption")) m.sigmaAbsorption = floats(of("absorption").words);
    if (kind_.name == "wax") {
      const glm::vec3 extinction = 1.0f / floats(of("mean_free_path").words);
      const glm::vec3 albedo = floats(of("albedo").words);
      s.sigmaScattering = extinction * albedo;
      m.sigmaAbsorption = extinction - s.sigmaScattering;
      s.phase = number("g");
      s.hasDiffusion = of("model").words.x != 0u;
    }
    if (kind_.name == "thin_dielectric") s.flags |= rl::RL_MATERIAL_THIN;
  }

 private:
  void applyGltf(Scattering& s) const {
    rl::Material& m = s.lobes;
    m.metallic = number("metallic");
    m.roughness = number("roughness");
    m.ior = number("ior");
    m.specular = number("specular");
    m.transmission = number("transmission");
    std::vector<ClosureValue> layers(rl::RL_LAYER_COUNT);
    const auto take = [&](uint32_t layer, const char* name, uint32_t flag) {
      layers[layer] = of(name);
      if (floats(layers[layer].words) != glm::vec3(0.0f)) s.flags |= flag;
    };
    take(rl::RL_LAYER_CLEARCOAT, "clearcoat", rl::RL_MATERIAL_CLEARCOAT);
    take(rl::RL_LAYER_CLEARCOAT_ROUGHNESS, "clearcoat_roughness", 0u);
    take(rl::RL_LAYER_SHEEN_COLOR, "sheen", rl::RL_MATERIAL_SHEEN);
    take(rl::RL_LAYER_SHEEN_ROUGHNESS, "sheen_roughness", 0u);
    take(rl::RL_LAYER_ANISOTROPY, "anisotropy", rl::RL_MATERIAL_ANISOTROPY);
    const double angle = number("anisotropy_rotation");
    layers[rl::RL_LAYER_ANISOTROPY].words =
        bits({number("anisotropy"), std::cos(angle), std::sin(angle)});
    take(rl::RL_LAYER_IRIDESCENCE, "iridescence", rl::RL_MATERIAL_IRIDESCENCE);
    layers[rl::RL_LAYER_FILM].words = bits({0.0, number("film_thickness"), number("film_ior")});
    take(rl::RL_LAYER_DIFFUSE_TRANSMISSION, "diffuse_transmission",
         rl::RL_MATERIAL_DIFFUSE_TRANSMISSION);
    take(rl::RL_LAYER_DIFFUSE_TRANSMISSION_COLOR, "diffuse_transmission_color", 0u);
    if (m.transmission > 0.0f)
      take(rl::RL_LAYER_DISPERSION, "dispersion", rl::RL_MATERIAL_DISPERSION);
    if ((s.flags & rl::RL_MATERIAL_LAYERS) != 0) s.closure = std::move(layers);
  }
  bool has(const char* name) const { return find(name) < kind_.parameters.size(); }
  size_t find(const char* name) const {
    size_t i = 0;
    while (i < kind_.parameters.size() && kind_.parameters[i].name != name) ++i;
    return i;
  }
  const ClosureValue& of(const char* name) const { return values_.at(find(name)); }
  float number(const char* name) const { return std::bit_cast<float>(of(name).words.x); }
  void setColor(rl::Material& m) const {
    if (!has("color")) return;
    m.baseColor = floats(of("color").words);
    m.textures[rl::RL_TEX_BASE_COLOR] = of("color").texture;
  }

  const MaterialKind& kind_;
  const std::vector<ClosureValue>& values_;
};

void checkConvex(const ConfigTable& table, const ClosureInfo& info,
                 const std::vector<ClosureValue>& values) {
  glm::vec3 sum(0.0f);
  for (size_t i = 0; i < values.size(); ++i) {
    const std::string& name = info.parameters[i].name;
    if (std::find(info.convexParts.begin(), info.convexParts.end(), name) != info.convexParts.end())
      sum += floats(values[i].words);
  }
  const float most = std::max({sum.x, sum.y, sum.z});
  if (most > 1.0001f)
    table.fail("", fmt::format("'{}' is {:g}; at most 1 expected, or energy is made",
                               fmt::join(info.convexParts, "' + '"), most));
}

// A share of a part that is not there would be lost light.
void checkShares(const ConfigTable& table, const ClosureInfo& info,
                 const std::vector<ClosureValue>& values) {
  for (size_t i = 0; i < values.size(); ++i) {
    if (info.parameters[i].kind != Kind::material || values[i].words.x != rl::RL_INVALID) continue;
    const std::string key = info.parameters[i].name + "_share";
    if (table.has(key))
      table.fail(key, fmt::format("'{}' without '{}': the material that it is of", key,
                                  info.parameters[i].name));
  }
}

}  // namespace

uint32_t SceneFileInputs::addTexture(const std::string& file, TextureUse use,
                                     const std::string& place) {
  const fs::path path = folder_ / file;
  auto found = findPath(images_, path);
  if (found == images_.end()) {
    const std::vector<uint8_t> bytes = bytesOf(path, place);
    DecodedImage image;
    if (const std::string problem = decodeImage(bytes, image); !problem.empty())
      failInput(fmt::format("{}: {}: {}; a complete PNG or JPEG expected", place, path.string(),
                            problem));
    scene_.contentHash = hashBytes(bytes.data(), bytes.size(), scene_.contentHash);
    scene_.images.push_back({file, image.width, image.height, std::move(image.texels)});
    found = images_.insert(images_.end(), {path, uint32_t(scene_.images.size() - 1)});
  }
  use.image = found->second;
  scene_.textureUses.push_back(use);
  return uint32_t(scene_.textureUses.size() - 1);
}

void SceneFileInputs::offer(std::shared_ptr<const ClosureTable> table) {
  tables_.emplace_back(folder_ / table->name, uint32_t(scene_.tables.size()));
  scene_.tables.push_back(std::move(table));
}

uint32_t SceneFileInputs::addTable(const std::string& file, const std::string& place) {
  const fs::path path = folder_ / file;
  if (const auto found = findPath(tables_, path); found != tables_.end()) return found->second;
  auto table =
      std::make_shared<const ClosureTable>(atPlace(place, [&] { return readClosureTable(path); }));
  const std::vector<glm::vec3>& values = table->values;
  const uint32_t axes[] = {uint32_t(table->angles), table->sizes.x, table->sizes.y, table->sizes.z};
  scene_.contentHash = hashBytes(axes, sizeof axes, scene_.contentHash);
  scene_.contentHash =
      hashBytes(values.data(), values.size() * sizeof(values[0]), scene_.contentHash);
  scene_.tables.push_back(std::move(table));
  tables_.emplace_back(path, uint32_t(scene_.tables.size() - 1));
  return tables_.back().second;
}

uint32_t SceneFileInputs::addPart(const std::string& name, const std::string& place) {
  if (const auto found = findPath(parts_, name); found != parts_.end()) return found->second;
  const auto scattering = std::find_if(offered_.begin(), offered_.end(),
                                       [&](const Scattering& s) { return s.name == name; });
  if (scattering == offered_.end()) {
    std::vector<std::string> names;
    for (const Scattering& s : offered_) names.push_back(s.name);
    failInput(fmt::format("{}: no [[material]] above is named '{}'{}", place, name,
                          didYouMean(name, names)));
  }
  const std::string& kind = scattering->kind->name;
  const bool hasLayers = (scattering->flags & rl::RL_MATERIAL_LAYERS) != 0;
  if (scattering->lobes.transmission > 0.0f || hasLayers || kind == "mixture")
    failInput(
        fmt::format("{}: '{}' is of kind '{}': a mixture takes kinds that reflect alone, "
                    "without layers, and no other mixture",
                    place, name, kind));
  SceneMaterial material;
  material.name = name;
  material.data = gltf::makeDefaultMaterial();
  scatterAs(*scattering, material);
  material.isPart = true;
  scene_.materials.push_back(std::move(material));
  parts_.emplace_back(name, uint32_t(scene_.materials.size() - 1));
  return parts_.back().second;
}

Scattering readScattering(const ConfigTable& table, SceneFileInputs& inputs) {
  Scattering s;
  s.name = table.getString("name", "");
  if (s.name.empty())
    table.fail("name", "[[material]] has no 'name', by which [[assign]] calls it");
  s.kind = &readKind(table);
  std::vector<ClosureValue> values;
  for (const ClosureParameter& p : s.kind->parameters)
    values.push_back(readValue(table, *s.kind, p, inputs));
  table.finish();
  if (s.kind->closure == nullptr) {
    Lobes(*s.kind, values).apply(s);
    return s;
  }
  const ClosureInfo& info = *s.kind->closure;
  checkConvex(table, info, values);
  checkShares(table, info, values);
  for (size_t i = 0; i < values.size(); ++i) {
    if (info.parameters[i].name == info.anisotropicWhere && values[i].words.x != 0u)
      s.flags |= rl::RL_MATERIAL_ANISOTROPIC;
    if (info.parameters[i].kind == Kind::material && values[i].words.x != rl::RL_INVALID)
      s.flags |= inputs.flagsOf(values[i].words.x) & rl::RL_MATERIAL_ANISOTROPIC;
  }
  s.closure = std::move(values);
  return s;
}

namespace {

// The value of a parameter as the file writes it, or its default.
std::string textOf(const ConfigTable& table, const ClosureParameter& p) {
  const std::vector<std::string> texts = table.getTexts(p.name);
  if (texts.size() == 1) return texts[0];
  if (!texts.empty()) return fmt::format("[{}]", fmt::join(texts, ", "));
  if (p.kind == Kind::choice) return fmt::format("'{}'", p.choices[size_t(p.fallback)]);
  if (p.kind == Kind::table || p.kind == Kind::material) return "";
  return fmt::format("{}", p.fallback);
}

}  // namespace

std::vector<SceneFileMaterial> materialsOf(const ConfigTable& table) {
  std::vector<SceneFileMaterial> materials;
  for (const ConfigTable& one : table.getTables("material")) {
    SceneFileMaterial material{one.getString("name", ""), &readKind(one), {}};
    for (const ClosureParameter& p : material.kind->parameters)
      material.values.push_back(textOf(one, p));
    materials.push_back(std::move(material));
  }
  return materials;
}

void scatterAs(const Scattering& scattering, SceneMaterial& material) {
  const rl::Material before = material.data;
  rl::Material& m = material.data;
  m = scattering.kind->closure != nullptr ? gltf::makeDefaultMaterial() : scattering.lobes;
  const bool hasCoverage =
      (before.flags & (rl::RL_MATERIAL_ALPHA_MASK | rl::RL_MATERIAL_ALPHA_BLEND)) != 0;
  constexpr uint32_t kStays =
      rl::RL_MATERIAL_DOUBLE_SIDED | rl::RL_MATERIAL_ALPHA_MASK | rl::RL_MATERIAL_ALPHA_BLEND;
  m.flags = (before.flags & kStays) | scattering.flags;
  m.alpha = before.alpha;
  m.alphaCutoff = before.alphaCutoff;
  m.emission = before.emission;
  m.normalScale = before.normalScale;
  m.textures[rl::RL_TEX_EMISSIVE] = before.textures[rl::RL_TEX_EMISSIVE];
  m.textures[rl::RL_TEX_NORMAL] = before.textures[rl::RL_TEX_NORMAL];
  // The texture of the base colour holds the coverage.
  if (hasCoverage) m.textures[rl::RL_TEX_BASE_COLOR] = before.textures[rl::RL_TEX_BASE_COLOR];
  material.sigmaScattering = scattering.sigmaScattering;
  material.phase = scattering.phase;
  material.hasDiffusion = scattering.hasDiffusion;
  material.scattersAs = scattering.name;
  material.closure = scattering.closure;
  if (scattering.kind->closure != nullptr) m.closure = scattering.kind->closure->kind;
}

}  // namespace restlab
