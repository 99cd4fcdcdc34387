// Materials: what glTF has by its own properties, all else in extras.restlab.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/closure_info.h"
#include "core/scene/gltf_write/document.h"
#include "core/shading/bsdf.h"

namespace restlab::gltf_write {
namespace {

using nlohmann::json;
using Kind = ClosureParameter::Kind;

float floatOf(uint32_t word) { return std::bit_cast<float>(word); }
json colorJson(const glm::vec3& c) { return {c.x, c.y, c.z}; }
glm::vec3 colorOfWords(const glm::uvec3& w) { return {floatOf(w.x), floatOf(w.y), floatOf(w.z)}; }

class MaterialWriter {
 public:
  MaterialWriter(const Scene& scene, const SceneMaterial& source, Images& images, Output& output)
      : scene_(scene), source_(source), m_(source_.data), images_(images), output_(output) {}

  json write() {
    material_["name"] = source_.name;
    writeBase();
    writeEmission();
    if (m_.closure == rl::RL_CLOSURE_GLTF) writeExtensions();
    if ((m_.flags & rl::RL_MATERIAL_DOUBLE_SIDED) != 0) material_["doubleSided"] = true;
    if ((m_.flags & rl::RL_MATERIAL_UNLIT) != 0) extension("KHR_materials_unlit") = json::object();
    if (source_.priority != 0) material_["extras"]["priority"] = source_.priority;
    const json own = kindOf();
    if (!own.is_null()) material_["extras"]["restlab"] = own;
    return material_;
  }

  // The keys of [[material]], also where glTF says all.
  json kind() {
    const json own = kindOf();
    return own.is_null() ? lobesKind() : own;
  }

 private:
  json& extension(const char* name) {
    output_.extensions.insert(name);
    return material_["extensions"][name];
  }
  bool hasTexture(uint32_t slot) const { return m_.textures[slot] != rl::RL_INVALID; }
  json texture(uint32_t slot, bool isSrgb) { return images_.info(m_.textures[slot], isSrgb); }

  void writeBase() {
    json pbr = {{"baseColorFactor", {m_.baseColor.x, m_.baseColor.y, m_.baseColor.z, m_.alpha}},
                {"metallicFactor", m_.metallic},
                {"roughnessFactor", m_.roughness}};
    if (hasTexture(rl::RL_TEX_BASE_COLOR))
      pbr["baseColorTexture"] = texture(rl::RL_TEX_BASE_COLOR, true);
    if (hasTexture(rl::RL_TEX_METALLIC_ROUGHNESS))
      pbr["metallicRoughnessTexture"] = texture(rl::RL_TEX_METALLIC_ROUGHNESS, false);
    material_["pbrMetallicRoughness"] = pbr;
    if ((m_.flags & rl::RL_MATERIAL_ALPHA_MASK) != 0) {
      material_["alphaMode"] = "MASK";
      material_["alphaCutoff"] = m_.alphaCutoff;
    } else if ((m_.flags & rl::RL_MATERIAL_ALPHA_BLEND) != 0) {
      material_["alphaMode"] = "BLEND";
    }
    if (!hasTexture(rl::RL_TEX_NORMAL)) return;
    material_["normalTexture"] = texture(rl::RL_TEX_NORMAL, false);
    material_["normalTexture"]["scale"] = m_.normalScale;
  }

  void writeEmission() {
    const float most = std::max({m_.emission.x, m_.emission.y, m_.emission.z});
    if (!(most > 0.0f)) return;
    const double strength = std::max(double(most), 1.0);
    material_["emissiveFactor"] = {m_.emission.x / strength, m_.emission.y / strength,
                                   m_.emission.z / strength};
    if (strength > 1.0) extension("KHR_materials_emissive_strength")["emissiveStrength"] = strength;
    if (hasTexture(rl::RL_TEX_EMISSIVE))
      material_["emissiveTexture"] = texture(rl::RL_TEX_EMISSIVE, true);
  }

  void writeExtensions() {
    if (m_.ior != 1.5f) extension("KHR_materials_ior")["ior"] = m_.ior;
    if (m_.specular != 1.0f || m_.specularColor != glm::vec3(1.0f) ||
        hasTexture(rl::RL_TEX_SPECULAR) || hasTexture(rl::RL_TEX_SPECULAR_COLOR)) {
      json& specular = extension("KHR_materials_specular");
      specular["specularFactor"] = m_.specular;
      specular["specularColorFactor"] = colorJson(m_.specularColor);
      if (hasTexture(rl::RL_TEX_SPECULAR))
        specular["specularTexture"] = texture(rl::RL_TEX_SPECULAR, false);
      if (hasTexture(rl::RL_TEX_SPECULAR_COLOR))
        specular["specularColorTexture"] = texture(rl::RL_TEX_SPECULAR_COLOR, true);
    }
    if (!(m_.transmission > 0.0f)) return;
    json& transmission = extension("KHR_materials_transmission");
    transmission["transmissionFactor"] = m_.transmission;
    if (hasTexture(rl::RL_TEX_TRANSMISSION))
      transmission["transmissionTexture"] = texture(rl::RL_TEX_TRANSMISSION, false);
    if ((m_.flags & rl::RL_MATERIAL_THIN) != 0) return;
    json& volume = extension("KHR_materials_volume");
    volume["thicknessFactor"] = 1.0;
    const glm::vec3& sigma = m_.sigmaAbsorption;
    const double most = std::max({sigma.x, sigma.y, sigma.z});
    if (!(most > 0.0)) return;
    volume["attenuationDistance"] = 1.0 / most;
    volume["attenuationColor"] = {std::exp(-sigma.x / most), std::exp(-sigma.y / most),
                                  std::exp(-sigma.z / most)};
  }

  // extras.restlab: the kind and its parameters; null where glTF says all.
  json kindOf() {
    if (m_.closure != rl::RL_CLOSURE_GLTF) return closureKind();
    if ((m_.flags & rl::RL_MATERIAL_BLACK) != 0) return {{"kind", "black"}};
    if (source_.sigmaScattering != glm::vec3(0.0f)) return waxKind();
    if (source_.isPart || (m_.flags & rl::RL_MATERIAL_LAYERS) != 0) return lobesKind();
    return nullptr;
  }

  json closureKind() {
    for (const ClosureInfo& info : closureRegistry()) {
      if (info.kind != m_.closure) continue;
      json own = {{"kind", info.name}};
      for (size_t i = 0; i < info.parameters.size(); ++i)
        writeParameter(info.parameters[i], source_.closure.at(i), own);
      return own;
    }
    return nullptr;
  }

  void writeParameter(const ClosureParameter& p, const ClosureValue& value, json& own) {
    if (p.kind == Kind::table)
      failInput(fmt::format("{}: material '{}' has a table, which glTF files do not hold",
                            output_.file.string(), source_.name));
    if (p.kind == Kind::choice) {
      own[p.name] = p.choices.at(value.words.x);
    } else if (p.kind == Kind::material) {
      if (value.words.x != rl::RL_INVALID) own[p.name] = scene_.materials.at(value.words.x).name;
      if (value.words.x == rl::RL_INVALID) absent_.insert(p.name + "_share");
    } else if (absent_.count(p.name) != 0) {
      return;  // the share of a part that is not there
    } else if (p.kind == Kind::color) {
      own[p.name] = colorJson(colorOfWords(value.words));
    } else {
      own[p.name] = floatOf(value.words.x);
    }
    if (value.texture == rl::RL_INVALID) return;
    writeTexture(p.name, value.texture, p.kind == Kind::color, own);
    if (p.kind == Kind::number)
      own[p.name + "_channel"] = std::string(1, "rgba"[value.channel & 3u]);
  }

  void writeTexture(const std::string& name, uint32_t index, bool isColor, json& own) {
    const TextureUse& use = scene_.textureUses.at(index);
    own[name + "_texture"] = images_.fileOf(index, isColor);
    if (use.uvSet != 0) own[name + "_uv_set"] = use.uvSet;
    if (use.uvRow0 != glm::vec3(1, 0, 0) || use.uvRow1 != glm::vec3(0, 1, 0))
      own[name + "_transform"] = {use.uvRow0.x, use.uvRow0.y, use.uvRow0.z,
                                  use.uvRow1.x, use.uvRow1.y, use.uvRow1.z};
    if (use.nearest) own[name + "_filter"] = "nearest";
    const char* modes[] = {"repeat", "clamp", "mirror"};
    if (use.wrapU != rl::RL_WRAP_REPEAT) own[name + "_wrap_u"] = modes[use.wrapU];
    if (use.wrapV != rl::RL_WRAP_REPEAT) own[name + "_wrap_v"] = modes[use.wrapV];
  }

  json waxKind() const {
    const glm::vec3 extinction = source_.sigmaScattering + m_.sigmaAbsorption;
    return {{"kind", "wax"},
            {"ior", m_.ior},
            {"alpha", m_.roughness * m_.roughness},
            {"color", colorJson(m_.baseColor)},
            {"albedo", colorJson(source_.sigmaScattering / extinction)},
            {"mean_free_path", colorJson(1.0f / extinction)},
            {"g", source_.phase},
            {"model", source_.hasDiffusion ? "diffusion" : "walk"}};
  }

  // The lobes of glTF by number, with layers.
  json lobesKind() {
    json own = {{"kind", "gltf"},
                {"color", colorJson(m_.baseColor)},
                {"metallic", m_.metallic},
                {"roughness", m_.roughness},
                {"ior", m_.ior},
                {"specular", m_.specular},
                {"transmission", m_.transmission}};
    const bool hasCoverage =
        (m_.flags & (rl::RL_MATERIAL_ALPHA_MASK | rl::RL_MATERIAL_ALPHA_BLEND)) != 0;
    if (hasTexture(rl::RL_TEX_BASE_COLOR) && !hasCoverage)
      writeTexture("color", m_.textures[rl::RL_TEX_BASE_COLOR], true, own);
    if (source_.closure.size() != rl::RL_LAYER_COUNT) return own;
    const std::vector<ClosureValue>& layers = source_.closure;
    const auto number = [&](uint32_t layer, const char* name) {
      own[name] = floatOf(layers[layer].words.x);
      if (layers[layer].texture != rl::RL_INVALID) noteTexture(name);
    };
    number(rl::RL_LAYER_CLEARCOAT, "clearcoat");
    number(rl::RL_LAYER_CLEARCOAT_ROUGHNESS, "clearcoat_roughness");
    number(rl::RL_LAYER_SHEEN_ROUGHNESS, "sheen_roughness");
    number(rl::RL_LAYER_ANISOTROPY, "anisotropy");
    number(rl::RL_LAYER_IRIDESCENCE, "iridescence");
    number(rl::RL_LAYER_DIFFUSE_TRANSMISSION, "diffuse_transmission");
    number(rl::RL_LAYER_DISPERSION, "dispersion");
    own["sheen"] = colorJson(colorOfWords(layers[rl::RL_LAYER_SHEEN_COLOR].words));
    own["diffuse_transmission_color"] =
        colorJson(colorOfWords(layers[rl::RL_LAYER_DIFFUSE_TRANSMISSION_COLOR].words));
    const glm::vec3 turn = colorOfWords(layers[rl::RL_LAYER_ANISOTROPY].words);
    own["anisotropy_rotation"] = std::atan2(turn.z, turn.y);
    const glm::vec3 film = colorOfWords(layers[rl::RL_LAYER_FILM].words);
    own["film_thickness"] = film.y;
    own["film_ior"] = film.z >= 1.0f ? film.z : 1.3f;
    return own;
  }

  void noteTexture(const char* name) {
    output_.notes.push_back(fmt::format("{}: the texture of '{}' of material '{}' is left out",
                                        output_.file.string(), name, source_.name));
  }

  const Scene& scene_;
  const SceneMaterial& source_;
  const rl::Material& m_;
  Images& images_;
  Output& output_;
  json material_;
  std::set<std::string> absent_;
};

}  // namespace

void addMaterials(const Scene& scene, Images& images, Output& output) {
  for (const SceneMaterial& material : scene.materials)
    output.add("materials", MaterialWriter(scene, material, images, output).write());
}

json kindWithoutTextures(const Scene& scene, size_t index) {
  SceneMaterial plain = scene.materials.at(index);
  for (uint32_t& texture : plain.data.textures) texture = rl::RL_INVALID;
  for (ClosureValue& value : plain.closure) value.texture = rl::RL_INVALID;
  Output unused;
  Images images(scene, unused);
  return MaterialWriter(scene, plain, images, unused).kind();
}

}  // namespace restlab::gltf_write
