#include "core/scene/gltf/layers.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "core/scene/gltf/properties.h"
#include "core/shading/bsdf.h"

namespace restlab::gltf {
namespace {

// RL_LARGEST_SPREAD. At 40 the index of red light would be 1.
constexpr double kLargestDispersion = 39.0;
// Limits of films: fringes of thicker ones are finer than any spectrum shows.
constexpr double kThickestFilm = 1.0e5;  // nm
constexpr double kLargestFilmIor = 4.0;

class LayerImporter {
 public:
  LayerImporter(const tinygltf::Material& material, const std::string& place,
                TextureImporter& textures, Report& report, SceneMaterial& result)
      : material_(material),
        place_(place),
        textures_(textures),
        report_(report),
        result_(result),
        values_(rl::RL_LAYER_COUNT) {}

  void import() {
    if ((result_.data.flags & rl::RL_MATERIAL_UNLIT) != 0) return;
    importClearcoat();
    importSheen();
    importAnisotropy();
    importIridescence();
    importDiffuseTransmission();
    importDispersion();
    if ((result_.data.flags & rl::RL_MATERIAL_LAYERS) != 0) result_.closure = std::move(values_);
  }

 private:
  Properties open(const char* name) {
    extension_ = fmt::format("{}.extensions.{}", place_, name);
    return Properties(material_.extensions, name);
  }

  void set(uint32_t layer, const glm::dvec3& v) {
    for (int i = 0; i < 3; ++i) values_[layer].words[i] = std::bit_cast<uint32_t>(float(v[i]));
  }
  void set(uint32_t layer, double number) { set(layer, glm::dvec3(number, 0.0, 0.0)); }

  void setTexture(uint32_t layer, const Properties& from, const char* name, bool isSrgb,
                  uint32_t channel = 0) {
    TextureReference reference = from.texture(name);
    if (reference.index < 0) return;
    reference.extensions = &reference.ownedExtensions;
    values_[layer].texture = textures_.add(reference, isSrgb, extension_ + "." + name);
    values_[layer].channel = channel;
  }

  void importClearcoat() {
    const Properties coat = open("KHR_materials_clearcoat");
    const double factor = coat.number("clearcoatFactor", 0.0);
    if (factor == 0.0) return;
    result_.data.flags |= rl::RL_MATERIAL_CLEARCOAT;
    set(rl::RL_LAYER_CLEARCOAT, factor);
    setTexture(rl::RL_LAYER_CLEARCOAT, coat, "clearcoatTexture", false, 0);
    set(rl::RL_LAYER_CLEARCOAT_ROUGHNESS, coat.number("clearcoatRoughnessFactor", 0.0));
    setTexture(rl::RL_LAYER_CLEARCOAT_ROUGHNESS, coat, "clearcoatRoughnessTexture", false, 1);
    set(rl::RL_LAYER_CLEARCOAT_NORMAL, coat.numberOf("clearcoatNormalTexture", "scale", 1.0));
    setTexture(rl::RL_LAYER_CLEARCOAT_NORMAL, coat, "clearcoatNormalTexture", false);
    if (result_.data.emission != glm::vec3(0.0f)) {
      report_.warn("emission below a clearcoat", extension_,
                   "the material also emits: its light is not darkened by the coat");
    }
  }

  void importSheen() {
    const Properties sheen = open("KHR_materials_sheen");
    const glm::dvec3 color = sheen.color("sheenColorFactor", glm::dvec3(0.0));
    if (color == glm::dvec3(0.0)) return;
    result_.data.flags |= rl::RL_MATERIAL_SHEEN;
    set(rl::RL_LAYER_SHEEN_COLOR, color);
    setTexture(rl::RL_LAYER_SHEEN_COLOR, sheen, "sheenColorTexture", true);
    set(rl::RL_LAYER_SHEEN_ROUGHNESS, sheen.number("sheenRoughnessFactor", 0.0));
    setTexture(rl::RL_LAYER_SHEEN_ROUGHNESS, sheen, "sheenRoughnessTexture", false, 3);
  }

  void importAnisotropy() {
    const Properties anisotropy = open("KHR_materials_anisotropy");
    const double strength = anisotropy.number("anisotropyStrength", 0.0);
    if (strength == 0.0) return;
    result_.data.flags |= rl::RL_MATERIAL_ANISOTROPY;
    const double angle = anisotropy.number("anisotropyRotation", 0.0);
    set(rl::RL_LAYER_ANISOTROPY, {strength, std::cos(angle), std::sin(angle)});
    setTexture(rl::RL_LAYER_ANISOTROPY, anisotropy, "anisotropyTexture", false);
  }

  // A number above what a film may have counts as that, with a warning.
  double limited(const Properties& of, const char* name, double otherwise, double most) {
    const double value = of.number(name, otherwise);
    if (value <= most) return value;
    report_.warn("out of range", extension_ + "." + name,
                 fmt::format("{:g} is used instead of {:g}", most, value));
    return most;
  }

  void importIridescence() {
    const Properties film = open("KHR_materials_iridescence");
    const double factor = film.number("iridescenceFactor", 0.0);
    if (factor == 0.0) return;
    result_.data.flags |= rl::RL_MATERIAL_IRIDESCENCE;
    set(rl::RL_LAYER_IRIDESCENCE, factor);
    setTexture(rl::RL_LAYER_IRIDESCENCE, film, "iridescenceTexture", false, 0);
    set(rl::RL_LAYER_FILM, {limited(film, "iridescenceThicknessMinimum", 100.0, kThickestFilm),
                            limited(film, "iridescenceThicknessMaximum", 400.0, kThickestFilm),
                            limited(film, "iridescenceIor", 1.3, kLargestFilmIor)});
    setTexture(rl::RL_LAYER_FILM, film, "iridescenceThicknessTexture", false, 1);
  }

  void importDiffuseTransmission() {
    const Properties passing = open("KHR_materials_diffuse_transmission");
    const double factor = passing.number("diffuseTransmissionFactor", 0.0);
    if (factor == 0.0) return;
    result_.data.flags |= rl::RL_MATERIAL_DIFFUSE_TRANSMISSION;
    set(rl::RL_LAYER_DIFFUSE_TRANSMISSION, factor);
    setTexture(rl::RL_LAYER_DIFFUSE_TRANSMISSION, passing, "diffuseTransmissionTexture", false, 3);
    set(rl::RL_LAYER_DIFFUSE_TRANSMISSION_COLOR,
        passing.color("diffuseTransmissionColorFactor", glm::dvec3(1.0)));
    setTexture(rl::RL_LAYER_DIFFUSE_TRANSMISSION_COLOR, passing, "diffuseTransmissionColorTexture",
               true);
  }

  void importDispersion() {
    const Properties dispersion = open("KHR_materials_dispersion");
    double spread = dispersion.number("dispersion", 0.0);
    if (spread == 0.0) return;
    const rl::Material& data = result_.data;
    if (data.transmission == 0.0f || (data.flags & rl::RL_MATERIAL_THIN) != 0) {
      report_.warn("dispersion without volume", extension_,
                   "has no effect: only a material that transmits and has a volume refracts");
      return;
    }
    if (spread > kLargestDispersion) {
      report_.warn(
          "out of range", extension_ + ".dispersion",
          fmt::format("{:g} is used instead of {:g}: red light would be bent the other way",
                      kLargestDispersion, spread));
      spread = kLargestDispersion;
    }
    result_.data.flags |= rl::RL_MATERIAL_DISPERSION;
    set(rl::RL_LAYER_DISPERSION, spread);
  }

  const tinygltf::Material& material_;
  const std::string& place_;
  std::string extension_;  // place of the one that is read
  TextureImporter& textures_;
  Report& report_;
  SceneMaterial& result_;
  std::vector<ClosureValue> values_;
};

}  // namespace

void importLayers(const tinygltf::Material& material, const std::string& place,
                  TextureImporter& textures, Report& report, SceneMaterial& result) {
  LayerImporter(material, place, textures, report, result).import();
}

}  // namespace restlab::gltf
