#include "core/scene/gltf/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/scene/compiled/bodies.h"
#include "core/scene/gltf/json.h"
#include "core/scene/gltf/layers.h"
#include "core/scene/gltf/properties.h"
#include "core/scene/gltf/specular_glossiness.h"

namespace restlab::gltf {
namespace {

// Smallest transmittance over the attenuation distance. An attenuation colour of 0 would mean
// infinite absorption; this value is black in 8 bits and finite in Beer-Lambert's exponent.
constexpr double kSmallestTransmittance = 1e-4;
// Largest index of refraction of a transmitting material: no transparent material bends light more,
// and beyond it the half vectors of rough refraction lose precision.
constexpr double kLargestIor = 4.0;
constexpr int kLargestPriority = 1'000'000;

class MaterialImporter {
 public:
  MaterialImporter(const tinygltf::Material& material, size_t index, TextureImporter& textures,
                   Report& report)
      : material_(material),
        place_(fmt::format("materials[{}]", index)),
        textures_(textures),
        report_(report) {}

  SceneMaterial import() {
    SceneMaterial result{material_.name, makeDefaultMaterial()};
    data_ = &result.data;
    importBase();
    importAlpha();
    importEmission();
    if (!isSpecularGlossiness()) {
      importSpecular();
      importTransmission();
    }
    if (material_.doubleSided) data_->flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
    if (has("KHR_materials_unlit")) data_->flags |= rl::RL_MATERIAL_UNLIT;
    if (!isSpecularGlossiness()) importLayers(material_, place_, textures_, report_, result);
    return result;
  }

 private:
  bool has(const char* extension) const { return material_.extensions.count(extension) != 0; }
  std::string placeOf(const char* extension) const { return place_ + ".extensions." + extension; }

  void setTexture(uint32_t slot, TextureReference reference, bool srgb, const std::string& place) {
    if (reference.index < 0) return;
    if (!reference.extensions) reference.extensions = &reference.ownedExtensions;
    data_->textures[slot] = textures_.add(reference, srgb, place);
  }

  template <class Info>
  void setTexture(uint32_t slot, const Info& info, bool srgb, const char* name) {
    setTexture(slot, TextureReference{info.index, info.texCoord, &info.extensions, {}}, srgb,
               place_ + "." + name);
  }

  // Returns whether KHR_materials_pbrSpecularGlossiness takes the place of metallic-roughness.
  bool isSpecularGlossiness() const {
    return has(kSpecularGlossiness) && !has("KHR_materials_unlit");
  }

  void importBase() {
    checkSpecularGlossiness(material_, place_, report_);
    if (isSpecularGlossiness()) {
      importSpecularGlossiness(material_.extensions.at(kSpecularGlossiness),
                               placeOf(kSpecularGlossiness), textures_, *data_);
    } else {
      importMetallicRoughness();
    }
    data_->normalScale = static_cast<float>(material_.normalTexture.scale);
    setTexture(rl::RL_TEX_NORMAL, material_.normalTexture, false, "normalTexture");
  }

  void importMetallicRoughness() {
    const tinygltf::PbrMetallicRoughness& pbr = material_.pbrMetallicRoughness;
    data_->baseColor =
        glm::dvec3(pbr.baseColorFactor[0], pbr.baseColorFactor[1], pbr.baseColorFactor[2]);
    data_->alpha = static_cast<float>(pbr.baseColorFactor[3]);
    data_->metallic = static_cast<float>(pbr.metallicFactor);
    data_->roughness = static_cast<float>(pbr.roughnessFactor);
    setTexture(rl::RL_TEX_BASE_COLOR, pbr.baseColorTexture, true,
               "pbrMetallicRoughness.baseColorTexture");
    setTexture(rl::RL_TEX_METALLIC_ROUGHNESS, pbr.metallicRoughnessTexture, false,
               "pbrMetallicRoughness.metallicRoughnessTexture");
  }

  void importAlpha() {
    data_->alphaCutoff = static_cast<float>(material_.alphaCutoff);
    if (material_.alphaMode == "MASK") {
      data_->flags |= rl::RL_MATERIAL_ALPHA_MASK;
    } else if (material_.alphaMode == "BLEND") {
      data_->flags |= rl::RL_MATERIAL_ALPHA_BLEND;
    } else {
      data_->alpha = 1.0f;  // opaque: the specification ignores alpha
    }
  }

  void importEmission() {
    const Properties strength(material_.extensions, "KHR_materials_emissive_strength");
    const glm::dvec3 factor(material_.emissiveFactor[0], material_.emissiveFactor[1],
                            material_.emissiveFactor[2]);
    if (std::max({factor.x, factor.y, factor.z}) > 1.0) {
      report_.warn("emissive factor", place_ + ".emissiveFactor",
                   fmt::format("({:g}, {:g}, {:g}) exceeds 1; used as it is "
                               "(KHR_materials_emissive_strength is meant for this)",
                               factor.x, factor.y, factor.z));
    }
    data_->emission = factor * strength.number("emissiveStrength", 1.0);
    if (!std::isfinite(data_->emission.x + data_->emission.y + data_->emission.z)) {
      report_.fail(placeOf("KHR_materials_emissive_strength"),
                   "emissiveFactor x emissiveStrength is too large for a 32-bit float");
    }
    setTexture(rl::RL_TEX_EMISSIVE, material_.emissiveTexture, true, "emissiveTexture");
  }

  void importSpecular() {
    const Properties ior(material_.extensions, "KHR_materials_ior");
    double index = ior.number("ior", 1.5);
    if (index > 0.0 && index < 1.0) {  // 0 is legal: Fresnel reflectance 1
      report_.warn(
          "out of range", placeOf("KHR_materials_ior") + ".ior",
          fmt::format("{:g} is out of range (0, or at least 1 expected); 1 is used", index));
      index = 1.0;
    }
    data_->ior = static_cast<float>(index);
    constexpr const char* kName = "KHR_materials_specular";
    const Properties specular(material_.extensions, kName);
    data_->specular = static_cast<float>(specular.number("specularFactor", 1.0));
    data_->specularColor = specular.color("specularColorFactor", glm::dvec3(1.0));
    setTexture(rl::RL_TEX_SPECULAR, specular.texture("specularTexture"), false,
               placeOf(kName) + ".specularTexture");
    setTexture(rl::RL_TEX_SPECULAR_COLOR, specular.texture("specularColorTexture"), true,
               placeOf(kName) + ".specularColorTexture");
  }

  void importTransmission() {
    const Properties transmission(material_.extensions, "KHR_materials_transmission");
    data_->transmission = static_cast<float>(transmission.number("transmissionFactor", 0.0));
    if (data_->transmission > 0.0f && data_->ior > kLargestIor) {
      report_.warn("out of range", placeOf("KHR_materials_ior") + ".ior",
                   fmt::format("{:g} is used instead of {:g}: the material transmits", kLargestIor,
                               data_->ior));
      data_->ior = static_cast<float>(kLargestIor);
    }
    if (data_->transmission > 0.0f && data_->ior == 0.0f) {
      report_.warn("full reflection", placeOf("KHR_materials_ior") + ".ior",
                   "0 stands for full reflection; nothing is transmitted");
    }
    const Properties volume(material_.extensions, "KHR_materials_volume");
    const bool solid = volume.number("thicknessFactor", 0.0) > 0.0;
    if (data_->transmission == 0.0f) {
      if (solid) {
        report_.warn("volume without transmission", placeOf("KHR_materials_volume"),
                     "has no effect without KHR_materials_transmission");
      }
      return;
    }
    setTexture(rl::RL_TEX_TRANSMISSION, transmission.texture("transmissionTexture"), false,
               placeOf("KHR_materials_transmission") + ".transmissionTexture");
    if (solid) {
      importAbsorption(volume);
    } else {
      data_->flags |= rl::RL_MATERIAL_THIN;
    }
  }

  // Computes absorption by Beer-Lambert: attenuationColor is what remains of white after
  // attenuationDistance metres.
  void importAbsorption(const Properties& volume) {
    const std::string place = placeOf("KHR_materials_volume");
    if (volume.has("thicknessTexture")) {
      report_.warn("thickness texture", place + ".thicknessTexture",
                   "is not read: path lengths come from the geometry");
    }
    if (!volume.has("attenuationDistance")) return;  // infinite: nothing is absorbed
    const double distance = volume.number("attenuationDistance", 1.0);
    const glm::dvec3 color = volume.color("attenuationColor", glm::dvec3(1.0));
    for (int c = 0; c < 3; ++c) {
      if (color[c] < kSmallestTransmittance) {
        report_.warn("attenuation colour", place + ".attenuationColor",
                     fmt::format("{:g} would absorb everything at once; {:g} is used", color[c],
                                 kSmallestTransmittance));
      }
      const double sigma = -std::log(std::max(color[c], kSmallestTransmittance)) / distance;
      data_->sigmaAbsorption[c] = static_cast<float>(sigma);
      if (!std::isfinite(data_->sigmaAbsorption[c])) {
        report_.fail(
            place + ".attenuationDistance",
            fmt::format("{:g} is too small: the absorption coefficient overflows", distance));
      }
    }
  }

  const tinygltf::Material& material_;
  std::string place_;
  TextureImporter& textures_;
  Report& report_;
  rl::Material* data_ = nullptr;
};

std::string placeOfPriority(size_t material) {
  return fmt::format("materials[{}].extras.priority", material);
}

// Reads this project's own property: which of several bodies fills a place
// (core/scene/compiled/bodies.h).
int priorityOf(const nlohmann::json& material, const std::string& place, Report& report) {
  const auto extras = material.find("extras");
  if (extras == material.end() || !extras->is_object()) return 0;
  const auto value = extras->find("priority");
  if (value == extras->end()) return 0;
  const bool isNumber = value->is_number();
  const double number = isNumber ? value->get<double>() : 0.0;
  if (isNumber && number == std::round(number) && std::abs(number) <= kLargestPriority)
    return static_cast<int>(number);
  report.warn(
      "priority", place,
      fmt::format("is {}; a whole number from -{} to {} expected; it is read as 0",
                  isNumber ? value->dump() : typeName(*value), kLargestPriority, kLargestPriority));
  return 0;
}

}  // namespace

rl::Material makeDefaultMaterial() {
  rl::Material material{};
  material.baseColor = glm::vec3(1.0f);
  material.alpha = 1.0f;
  material.alphaCutoff = 0.5f;
  material.metallic = 1.0f;
  material.roughness = 1.0f;
  material.ior = 1.5f;
  material.specularColor = glm::vec3(1.0f);
  material.specular = 1.0f;
  material.normalScale = 1.0f;
  std::fill(std::begin(material.textures), std::end(material.textures), rl::RL_INVALID);
  return material;
}

std::vector<int> readPriorities(const nlohmann::json& document, Report& report) {
  std::vector<int> priorities;
  for (const nlohmann::json& material : arrayOf(document, "materials"))
    priorities.push_back(priorityOf(material, placeOfPriority(priorities.size()), report));
  return priorities;
}

void importMaterials(const Document& document, const std::vector<int>& priorities,
                     TextureImporter& textures, Scene& scene, Report& report) {
  for (size_t i = 0; i < document.model.materials.size(); ++i) {
    SceneMaterial material =
        MaterialImporter(document.model.materials[i], i, textures, report).import();
    material.priority = priorities.at(i);
    if (material.priority != 0 && !isBody(material.data)) {
      report.warn("priority without body", placeOfPriority(i),
                  "has no effect: only materials that transmit and have a volume fill a place");
    }
    scene.materials.push_back(std::move(material));
  }
}

uint32_t defaultMaterial(Scene& scene, size_t documentMaterials) {
  if (scene.materials.size() == documentMaterials) {
    scene.materials.push_back({"default", makeDefaultMaterial()});
  }
  return static_cast<uint32_t>(documentMaterials);
}

}  // namespace restlab::gltf
