#include "core/scene/scene_write/scene_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

#include "core/base/error.h"
#include "core/scene/gltf_write/document.h"
#include "core/scene/scene_file/scene_file.h"
#include "core/shading/bsdf.h"

namespace restlab {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// The text with U+FFFD in the place of bytes that are not UTF-8.
std::string utf8Of(const std::string& text) {
  const std::string whole = json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  return json::parse(whole).get<std::string>();
}

// A basic string of TOML.
std::string quoted(const std::string& text) {
  std::string all = "\"";
  for (const char c : utf8Of(text)) {
    if (c == '"' || c == '\\') all += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      all += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    else
      all += c;
  }
  return all + "\"";
}

// Numbers are floats, in as few digits as give the same one again.
std::string tomlOf(const json& value) {
  if (value.is_string()) return quoted(value.get<std::string>());
  if (value.is_number_float()) return fmt::format("{}", value.get<float>());
  if (!value.is_array()) return value.dump();
  std::string all;
  for (const json& one : value) all += (all.empty() ? "" : ", ") + tomlOf(one);
  return "[" + all + "]";
}

bool hasLayers(const SceneMaterial& m) { return (m.data.flags & rl::RL_MATERIAL_LAYERS) != 0; }
bool hasTable(const SceneMaterial& m) {
  return std::any_of(m.closure.begin(), m.closure.end(),
                     [](const ClosureValue& v) { return v.table != rl::RL_INVALID; });
}

json colorOf(const glm::vec3& c) { return {c.x, c.y, c.z}; }

// The kind with the fewest parameters that the lobes of glTF stand for; null: gltf itself.
json shortKindOf(const SceneMaterial& source) {
  const rl::Material& m = source.data;
  const float alpha = m.roughness * m.roughness;
  if (m.closure != rl::RL_CLOSURE_GLTF || hasLayers(source) || m.metallic != 0.0f ||
      (m.flags & rl::RL_MATERIAL_BLACK) != 0 || source.sigmaScattering != glm::vec3(0.0f))
    return nullptr;
  const json color = colorOf(m.baseColor);
  if (m.transmission == 0.0f && m.specular == 0.0f) return {{"kind", "diffuse"}, {"color", color}};
  if (m.specular != 1.0f) return nullptr;
  if (m.transmission == 0.0f)
    return {{"kind", "plastic"}, {"color", color}, {"ior", m.ior}, {"alpha", alpha}};
  if (m.transmission != 1.0f) return nullptr;
  if ((m.flags & rl::RL_MATERIAL_THIN) != 0)
    return {{"kind", "thin_dielectric"}, {"ior", m.ior}, {"alpha", alpha}, {"color", color}};
  return {{"kind", "dielectric"},
          {"ior", m.ior},
          {"alpha", alpha},
          {"color", color},
          {"absorption", colorOf(m.sigmaAbsorption)}};
}

bool isNear(float a, float b) {
  return std::abs(a - b) <= 2e-6f * std::max(std::abs(a), std::abs(b));
}
bool isNear(const glm::vec3& a, const glm::vec3& b) {
  return isNear(a.x, b.x) && isNear(a.y, b.y) && isNear(a.z, b.z);
}

// Numbers of kernels are equal but for rounding, all else is the same.
bool isSameData(const rl::Material& a, const rl::Material& b) {
  return isNear(a.baseColor, b.baseColor) && isNear(a.emission, b.emission) && a.alpha == b.alpha &&
         a.alphaCutoff == b.alphaCutoff && isNear(a.metallic, b.metallic) &&
         isNear(a.roughness, b.roughness) && isNear(a.ior, b.ior) &&
         isNear(a.transmission, b.transmission) && isNear(a.specularColor, b.specularColor) &&
         isNear(a.specular, b.specular) && isNear(a.sigmaAbsorption, b.sigmaAbsorption) &&
         a.normalScale == b.normalScale && a.flags == b.flags && a.closure == b.closure &&
         std::equal(std::begin(a.textures), std::end(a.textures), std::begin(b.textures));
}

// The flag of a material without which a layer is not looked at.
uint32_t flagOfLayer(size_t layer) {
  switch (layer) {
    case rl::RL_LAYER_CLEARCOAT:
    case rl::RL_LAYER_CLEARCOAT_ROUGHNESS:
    case rl::RL_LAYER_CLEARCOAT_NORMAL:
      return rl::RL_MATERIAL_CLEARCOAT;
    case rl::RL_LAYER_SHEEN_COLOR:
    case rl::RL_LAYER_SHEEN_ROUGHNESS:
      return rl::RL_MATERIAL_SHEEN;
    case rl::RL_LAYER_ANISOTROPY:
      return rl::RL_MATERIAL_ANISOTROPY;
    case rl::RL_LAYER_IRIDESCENCE:
    case rl::RL_LAYER_FILM:
      return rl::RL_MATERIAL_IRIDESCENCE;
    case rl::RL_LAYER_DIFFUSE_TRANSMISSION:
    case rl::RL_LAYER_DIFFUSE_TRANSMISSION_COLOR:
      return rl::RL_MATERIAL_DIFFUSE_TRANSMISSION;
    case rl::RL_LAYER_DISPERSION:
      return rl::RL_MATERIAL_DISPERSION;
    default:
      return rl::RL_MATERIAL_LAYERS;
  }
}

// Numbers of a layer are its first word alone.
int wordsOfLayer(size_t layer) {
  const bool isLong = layer == rl::RL_LAYER_SHEEN_COLOR || layer == rl::RL_LAYER_ANISOTROPY ||
                      layer == rl::RL_LAYER_FILM ||
                      layer == rl::RL_LAYER_DIFFUSE_TRANSMISSION_COLOR;
  return isLong ? 3 : 1;
}

// All materials of a name, which [[assign]] calls at once.
struct Namesakes {
  std::string name;
  std::vector<size_t> materials;
  bool isPart = false;  // of a mixture
};

class SceneFileWriter {
 public:
  explicit SceneFileWriter(const Scene& scene) : scene_(scene), inputs_("", scratch_) {}

  SceneFileText write(const std::string& base) {
    SceneFileText file;
    if (utf8Of(base) != base)
      failInput(utf8Of(base) +
                ": is not UTF-8, so that no scene file can begin with it; another "
                "name of the file or its folder expected");
    file.text = "base = " + quoted(base) + "\n";
    // Parts of mixtures stand before the mixtures.
    const std::vector<Namesakes> all = names();
    for (const bool arePartsWanted : {true, false}) {
      for (const Namesakes& names : all)
        if (names.isPart == arePartsWanted) add(names, file);
    }
    return file;
  }

 private:
  std::vector<Namesakes> names() const {
    std::vector<Namesakes> all;
    std::map<std::string, size_t> index;
    for (size_t i = 0; i < scene_.materials.size(); ++i) {
      const SceneMaterial& m = scene_.materials[i];
      const auto [entry, isNew] = index.try_emplace(m.name, all.size());
      if (isNew) all.push_back({m.name, {}, false});
      all[entry->second].materials.push_back(i);
      all[entry->second].isPart = all[entry->second].isPart || m.isPart;
    }
    return all;
  }

  // "kind = ..." and its parameters, in the order of the kind.
  std::string tableOf(size_t index) const {
    const SceneMaterial& source = scene_.materials[index];
    std::string table = "name = " + quoted(source.name) + "\n";
    if (hasTable(source)) return table + "kind = \"table\"\n";
    json own = shortKindOf(source);
    if (own.is_null()) own = gltf_write::kindWithoutTextures(scene_, index);
    const auto ownKind = own["kind"].get<std::string>();
    table += "kind = " + quoted(ownKind) + "\n";
    for (const MaterialKind& kind : materialKinds()) {
      if (kind.name != ownKind) continue;
      for (const ClosureParameter& p : kind.parameters)
        if (own.contains(p.name)) table += p.name + " = " + tomlOf(own[p.name]) + "\n";
    }
    return table;
  }

  void add(const Namesakes& names, SceneFileText& file) {
    const std::string table = tableOf(names.materials[0]);
    std::string why = whyNot(scene_.materials[names.materials[0]]);
    if (why.empty()) why = whyOther(names, table);
    if (why.empty()) {
      write(names.materials, table, "", file);
      ++file.named;
      return;
    }
    for (const size_t i : names.materials) {
      write({i}, tableOf(i), why, file);
      ++file.commentary;
    }
  }

  void write(const std::vector<size_t>& materials, const std::string& table, const std::string& why,
             SceneFileText& file) const {
    const std::string name = quoted(scene_.materials[materials[0]].name);
    std::string text = "[[material]]\n" + table;
    const auto isPart = [&](size_t i) { return scene_.materials[i].isPart; };
    if (!std::all_of(materials.begin(), materials.end(), isPart))
      text += fmt::format("[[assign]]\nmaterial = {0}\nto = {0}\n", name);
    file.text += "\n" + (why.empty() ? text : commented(why, text));
  }

  static std::string commented(const std::string& why, const std::string& text) {
    std::string all = "# " + why + "\n";
    for (size_t begin = 0; begin < text.size();) {
      const size_t end = text.find('\n', begin);
      all += "# " + text.substr(begin, end - begin) + "\n";
      begin = end + 1;
    }
    return all;
  }

  static std::string whyNot(const SceneMaterial& source) {
    if (source.name.empty()) return "A material without a name, which [[assign]] cannot call.";
    if (source.name.find_first_of("*?[\\") != std::string::npos)
      return "A name with *, ?, [ or \\, which [[assign]] takes for a pattern.";
    if (utf8Of(source.name) != source.name)
      return "A name that is not UTF-8, which no scene file holds; \uFFFD stands for its bytes.";
    if (hasTable(source)) return "A table, whose file the base names.";
    return "";
  }

  // Also offers the material to the mixtures behind it.
  std::string whyOther(const Namesakes& names, const std::string& table) {
    for (const size_t i : names.materials) {
      const SceneMaterial& source = scene_.materials[i];
      if (becomesItself(source, table)) continue;
      if ((source.data.flags & rl::RL_MATERIAL_UNLIT) != 0)
        return "Unlit in the base: it would scatter light.";
      if (isTextured(source))
        return "The base has textures for it, which these values would take the place of.";
      if (names.materials.size() > 1) return "Several materials have this name.";
      return "The base has more of it than these values say.";
    }
    return "";
  }

  static bool isTextured(const SceneMaterial& source) {
    const auto hasTexture = [](const ClosureValue& v) { return v.texture != rl::RL_INVALID; };
    return std::any_of(source.closure.begin(), source.closure.end(), hasTexture) ||
           std::any_of(std::begin(source.data.textures), std::end(source.data.textures),
                       [](uint32_t t) { return t != rl::RL_INVALID; });
  }

  // Returns whether the table, read again, leaves the material as it is.
  bool becomesItself(const SceneMaterial& source, const std::string& table) {
    try {
      const Scattering s = readScattering(ConfigTable::parseText(table, source.name), inputs_);
      SceneMaterial after = source;
      scatterAs(s, after);
      inputs_.offer(s);
      return isSameData(source.data, after.data) && isSameClosure(source, after, s) &&
             isNear(source.sigmaScattering, after.sigmaScattering) &&
             isNear(source.phase, after.phase) && source.hasDiffusion == after.hasDiffusion;
    } catch (const Error&) {
      return false;  // out of the ranges of scene files
    }
  }

  bool isSameClosure(const SceneMaterial& a, const SceneMaterial& b, const Scattering& s) const {
    if (a.closure.size() != b.closure.size()) return false;
    const bool isNamed = s.kind->closure != nullptr;
    for (size_t i = 0; i < a.closure.size(); ++i) {
      const ClosureValue &x = a.closure[i], &y = b.closure[i];
      if (!isNamed && (a.data.flags & flagOfLayer(i)) == 0) continue;
      if (x.texture != y.texture || x.table != y.table) return false;
      const auto kind =
          isNamed ? s.kind->closure->parameters.at(i).kind : ClosureParameter::Kind::number;
      // Parts of mixtures have numbers of their own in each scene, and are known by their names.
      if (kind == ClosureParameter::Kind::material) continue;
      if (kind == ClosureParameter::Kind::choice && x.words != y.words) return false;
      if (kind == ClosureParameter::Kind::choice) continue;
      // Without a texture there is no normal to scale, and a film has its greatest thickness.
      if (!isNamed && i == rl::RL_LAYER_CLEARCOAT_NORMAL) continue;
      for (int c = !isNamed && i == rl::RL_LAYER_FILM ? 1 : 0; c < (isNamed ? 3 : wordsOfLayer(i));
           ++c)
        if (!isNear(std::bit_cast<float>(x.words[c]), std::bit_cast<float>(y.words[c])))
          return false;
    }
    return true;
  }

  const Scene& scene_;
  Scene scratch_;
  SceneFileInputs inputs_;
};

}  // namespace

SceneFileText sceneFileOf(const Scene& scene, const std::string& base) {
  return SceneFileWriter(scene).write(base);
}

std::string baseNameOf(const Scene& scene, const fs::path& folder) {
  if (scene.source.empty()) return scene.name;
  const std::string settings = settingsOfScene(scene);
  const fs::path from = fs::absolute(folder.empty() ? fs::path(".") : folder).lexically_normal();
  const fs::path file = fs::absolute(scene.source).lexically_normal();
  const fs::path relative = file.lexically_relative(from);
  return (relative.empty() ? file : relative).generic_string() +
         (settings.empty() ? "" : "?" + settings);
}

}  // namespace restlab
