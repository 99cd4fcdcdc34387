#include "core/scene/scene_file/scene_file.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "core/base/error.h"
#include "core/scene/content_hash.h"
#include "core/scene/scene_file/meshes.h"
#include "core/scene/scene_file/scene_settings.h"
#include "core/scene/scene_file/shapes.h"
#include "core/scene/textures/daylight.h"

namespace restlab {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExtension = ".scene.toml";
constexpr int kMostBases = 8;  // scene files that begin with one another

bool matches(const std::string& pattern, const std::string& name) {
  return pattern == name || fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

// Counts scene files that are being read, whichever way one came to the next.
class Nesting {
 public:
  explicit Nesting(const fs::path& file) {
    if (++depth_ <= kMostBases) return;
    --depth_;
    failInput(fmt::format("{}: more than {} scene files begin with one another", file.string(),
                          kMostBases));
  }
  ~Nesting() { --depth_; }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;

 private:
  static thread_local int depth_;
};
thread_local int Nesting::depth_ = 0;

// The scene of `base`: a built-in one, or a file relative to this one. `more`: settings of a scene
// file.
Scene loadBase(const ConfigTable& table, const fs::path& folder, const std::string& more) {
  const std::string base = table.getString("base", "");
  if (base.empty() && !table.has("shape"))
    table.fail("base",
               "no 'base', the scene to begin with (a built-in one or a glTF file), and no "
               "[[shape]]");
  const auto [file, given] = splitSceneSettings(base);
  if (!more.empty() && (base.empty() || !isSceneFile(file))) {
    failInput(fmt::format("{}: {}{}: the file begins with no NAME.scene.toml", table.place("base"),
                          kOfBaseSetting, more));
  }
  if (base.empty()) return Scene();
  const std::string settings = joinedSettings(given, more);
  const auto load = [&] {
    if (isBuiltinScene(base)) return makeBuiltinScene(base);
    const fs::path path = folder / file;
    std::error_code error;
    if (!fs::exists(path, error)) return loadScene(more.empty() ? base : file + "?" + settings);
    return loadScene(path.string() + (settings.empty() ? "" : "?" + settings));
  };
  return atPlace(table.place("base"), load);
}

// [[assign]]: which materials, meshes or nodes scatter as a [[material]] says, and the normals of
// meshes.
class Assignment {
 public:
  Assignment(Scene& scene, const std::vector<Scattering>& materials)
      : scene_(scene), materials_(materials) {}

  void apply(const ConfigTable& table) {
    const bool hasNormals = table.has("normals");
    const Scattering* to = hasNormals && !table.has("to") ? nullptr : &target(table);
    std::string by;
    for (const char* key : {"material", "mesh", "node"}) {
      if (!table.has(key)) continue;
      if (!by.empty())
        table.fail(key, fmt::format("'{}' beside '{}': one of them tells what is meant", key, by));
      by = key;
    }
    if (by.empty())
      table.fail("", "[[assign]] has none of 'material', 'mesh', 'node': a name of the base scene");
    const std::string pattern = table.getString(by, "");
    std::vector<std::string> names;
    size_t count = hasNormals ? assignNormals(table, by, pattern, names) : 0;
    table.finish();
    if (to != nullptr)
      count = by == "material" ? assignMaterials(table, pattern, *to, names)
                               : assignInstances(table, by, pattern, *to, names);
    if (count > 0) return;
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    const std::string near = didYouMean(pattern, names);
    const size_t shown = std::min<size_t>(names.size(), 12);
    table.fail(by,
               fmt::format("no {} is named '{}'{}", by, pattern,
                           near.empty()
                               ? fmt::format("; there are {}{}",
                                             fmt::join(names.begin(),
                                                       names.begin() + std::ptrdiff_t(shown), ", "),
                                             shown < names.size() ? ", ..." : "")
                               : near));
  }

 private:
  const Scattering& target(const ConfigTable& table) const {
    std::vector<std::string> names;
    for (const Scattering& s : materials_) names.push_back(s.name);
    if (!table.has("to")) table.fail("", "[[assign]] has no 'to': the name of a [[material]]");
    const std::string to = table.getString("to", "");
    const auto found = std::find(names.begin(), names.end(), to);
    if (found == names.end())
      table.fail("to", fmt::format("no [[material]] is named '{}'{}", to, didYouMean(to, names)));
    return materials_[size_t(found - names.begin())];
  }

  // Normals belong to a mesh, whichever instances show it.
  size_t assignNormals(const ConfigTable& table, const std::string& by, const std::string& pattern,
                       std::vector<std::string>& names) {
    if (by != "mesh") table.fail("normals", "'normals' are of a mesh; name it by 'mesh'");
    size_t count = 0;
    for (MeshGeometry& mesh : scene_.geometries) {
      names.push_back(mesh.name);
      if (!matches(pattern, mesh.name)) continue;
      if (mesh.shape != nullptr)
        table.fail("normals", fmt::format("'{}' is a shape, which has the normals of its equation; "
                                          "a mesh expected",
                                          mesh.name));
      readNormals(table, mesh);
      ++count;
    }
    return count;
  }

  size_t assignMaterials(const ConfigTable& table, const std::string& pattern, const Scattering& to,
                         std::vector<std::string>& names) {
    size_t count = 0;
    for (SceneMaterial& material : scene_.materials) {
      if (material.isPart) continue;
      names.push_back(material.name);
      if (!matches(pattern, material.name)) continue;
      scatter(table, to, material);
      ++count;
    }
    return count;
  }

  // Changes a material. The texture that holds its coverage cannot hold another colour.
  static void scatter(const ConfigTable& table, const Scattering& to, SceneMaterial& material) {
    const bool hasCoverage =
        (material.data.flags & (rl::RL_MATERIAL_ALPHA_MASK | rl::RL_MATERIAL_ALPHA_BLEND)) != 0;
    const bool hasTexture =
        to.kind->closure == nullptr && to.lobes.textures[rl::RL_TEX_BASE_COLOR] != rl::RL_INVALID;
    if (hasCoverage && hasTexture)
      table.fail("to", fmt::format("'{}' has holes in the texture of its colour, which the texture "
                                   "of '{}' would take the place of; a closure expected",
                                   material.name, to.name));
    scatterAs(to, material);
  }

  // A material of its own for what is named: other instances may share the old one.
  size_t assignInstances(const ConfigTable& table, const std::string& by,
                         const std::string& pattern, const Scattering& to,
                         std::vector<std::string>& names) {
    size_t count = 0;
    std::map<uint32_t, uint32_t> copies;
    for (MeshInstance& instance : scene_.instances) {
      const std::string& name =
          by == "node" ? instance.name : scene_.geometries[instance.geometry].name;
      names.push_back(name);
      if (!matches(pattern, name)) continue;
      ++count;
      const auto [copy, isNew] =
          copies.try_emplace(instance.material, uint32_t(scene_.materials.size()));
      if (isNew) {
        SceneMaterial material = scene_.materials[instance.material];
        scatter(table, to, material);
        scene_.materials.push_back(std::move(material));
      }
      instance.material = copy->second;
    }
    return count;
  }

  Scene& scene_;
  const std::vector<Scattering>& materials_;
};

glm::dvec3 readVector(const ConfigTable& table, const char* key, const glm::dvec3& fallback) {
  const std::vector<double> v =
      table.getNumbers(key, {fallback.x, fallback.y, fallback.z}, 3, -1e9, 1e9);
  return {v[0], v[1], v[2]};
}

glm::vec3 readRadiance(const ConfigTable& table, const char* key, double fallback) {
  const bool isGrey = table.has(key) && table.getTexts(key).size() == 1;
  const std::vector<double> v =
      table.getNumbers(key, {fallback, fallback, fallback}, isGrey ? 1 : 3, 0.0, 1e12);
  return isGrey ? glm::vec3(float(v[0])) : glm::vec3(v[0], v[1], v[2]);
}

// The attenuation of a point light: 1 / (C0 + C1 r + C2 r^2), by default 1 / r^2.
glm::vec3 readAttenuation(const ConfigTable& table) {
  const std::vector<double> c = table.getNumbers("attenuation", {0.0, 0.0, 1.0}, 3, 0.0, 1e9);
  if (!(c[0] + c[1] + c[2] > 0.0))
    table.fail("attenuation", "'attenuation' is 0: 1 / (C0 + C1 r + C2 r^2) has no value");
  return {c[0], c[1], c[2]};
}

void addLight(const ConfigTable& table, Scene& scene) {
  const std::vector<std::string> kinds = {"point", "spot", "directional", "ambient"};
  PunctualLight light;
  light.name = table.getString("name", fmt::format("light {}", scene.lights.size()));
  const std::string kind = table.getChoice("kind", kinds[0], kinds);
  if (kind == "ambient") {
    scene.ambient += readRadiance(table, "radiance", 0.05);
    table.finish();
    return;
  }
  light.kind = kind == "point"  ? rl::RL_LIGHT_POINT
               : kind == "spot" ? rl::RL_LIGHT_SPOT
                                : rl::RL_LIGHT_DIRECTIONAL;
  const std::vector<double> intensity =
      table.getNumbers("intensity", {1.0, 1.0, 1.0}, 3, 0.0, 1e12);
  light.intensity = glm::dvec3(intensity[0], intensity[1], intensity[2]);
  if (kind == "point") light.attenuation = readAttenuation(table);
  if (kind != "directional") light.posW = readVector(table, "position", glm::dvec3(0.0));
  if (kind != "point") {
    const glm::dvec3 direction = readVector(table, "direction", {0.0, -1.0, 0.0});
    if (!(glm::length(direction) > 0.0)) table.fail("direction", "'direction' must not be 0");
    light.dirW = glm::normalize(direction);
  }
  if (kind == "spot") {
    constexpr double kRadians = std::numbers::pi / 180.0;
    const double outer = table.getNumber("outer_cone", 45.0, 0.01, 90.0);
    light.outerConeAngle = float(outer * kRadians);
    light.innerConeAngle = float(table.getNumber("inner_cone", 0.0, 0.0, outer) * kRadians);
  }
  table.finish();
  scene.lights.push_back(light);
}

// [camera]: the only camera then.
SceneCamera readCamera(const ConfigTable& table) {
  SceneCamera camera;
  camera.name = table.getString("name", "camera");
  const glm::dvec3 position = readVector(table, "position", glm::dvec3(0.0));
  const glm::dvec3 target = readVector(table, "target", glm::dvec3(0.0, 0.0, -1.0));
  const glm::dvec3 up = readVector(table, "up", glm::dvec3(0.0, 1.0, 0.0));
  camera.yfov = table.getNumber("yfov", 45.0, 0.01, 179.0) * std::numbers::pi / 180.0;
  table.finish();
  const glm::dvec3 back = position - target;
  const glm::dvec3 right = glm::cross(up, back);
  if (!(glm::length(right) > 0.0))
    table.fail("target", "'target' is at 'position', or straight above or below it: give 'up'");
  const glm::dvec3 z = glm::normalize(back), x = glm::normalize(right);
  camera.cameraToWorld = glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0),
                                    glm::dvec4(z, 0.0), glm::dvec4(position, 1.0));
  return camera;
}

EnvironmentMap readEnvironment(const ConfigTable& table, const fs::path& folder) {
  const std::string file = table.getString("file", "");
  if (int(!file.empty()) + int(table.has("radiance")) + int(table.has("daylight")) != 1)
    table.fail("file",
               "[environment] takes 'file', an .hdr or .exr, or 'radiance', a colour, or "
               "'daylight', its parameters: one of them");
  if (table.has("radiance")) {
    EnvironmentMap map;
    map.source = "radiance";
    map.width = 2;
    map.height = 1;
    map.radiance.assign(2, readRadiance(table, "radiance", 0.0));
    table.finish();
    return map;
  }
  const std::string daylight = table.getString("daylight", "");
  EnvironmentMap map = atPlace(table.place(file.empty() ? "daylight" : "file"), [&] {
    return file.empty() ? daylightMap(parseDaylight("daylight?" + daylight))
                        : loadEnvironment(folder / file);
  });
  map.rotation = float(table.getNumber("rotation", 0.0, -360.0, 360.0) * std::numbers::pi / 180.0);
  map.scale = float(table.getNumber("scale", 1.0, 0.0, 1e9));
  table.finish();
  return map;
}

Scene read(const fs::path& file, const std::string& settings) {
  const Nesting nesting(file);
  const ConfigTable table = ConfigTable::parseFile(file);
  const auto [own, ofBase] = splitBaseSettings(settings);
  applySettings(table, own, file);
  const fs::path folder = file.parent_path();
  Scene scene = loadBase(table, folder, ofBase);
  scene.name = file.filename().string();
  scene.name.resize(scene.name.size() - std::string(kExtension).size());
  if (!settings.empty()) scene.name += "?" + settings;
  scene.source = file;
  const std::string text = table.text();  // with what the file includes
  scene.contentHash = hashBytes(text.data(), text.size(), scene.contentHash);
  SceneFileInputs inputs(folder, scene);
  std::vector<Scattering> materials;
  for (const ConfigTable& material : table.getTables("material")) {
    materials.push_back(readScattering(material, inputs));
    inputs.offer(materials.back());
    for (size_t i = 0; i + 1 < materials.size(); ++i) {
      if (materials[i].name == materials.back().name)
        material.fail("name",
                      fmt::format("a second [[material]] is named '{}'", materials[i].name));
    }
  }
  if (table.has("camera")) {
    scene.cameras = {readCamera(table.getTable("camera"))};
    scene.mainCamera = 0;
  }
  for (const ConfigTable& shape : table.getTables("shape"))
    addShape(shape, folder, materials, scene);
  Assignment assignment(scene, materials);
  for (const ConfigTable& assign : table.getTables("assign")) assignment.apply(assign);
  for (const ConfigTable& light : table.getTables("light")) addLight(light, scene);
  if (scene.cameras.empty()) scene.cameras = {framingCamera(scene)};
  if (table.has("environment"))
    scene.environment = readEnvironment(table.getTable("environment"), folder);
  if (table.has("background")) {
    const ConfigTable background = table.getTable("background");
    scene.background = readRadiance(background, "radiance", 0.0);
    background.finish();
  }
  table.finish();
  return scene;
}

}  // namespace

bool isSceneFile(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.ends_with(kExtension) && name.size() > std::string(kExtension).size();
}

std::pair<std::string, std::string> splitSceneSettings(const std::string& name) {
  const size_t question = name.find('?');
  std::error_code error;
  if (isBuiltinScene(name) || question == std::string::npos || fs::exists(name, error))
    return {name, ""};
  return {name.substr(0, question), name.substr(question + 1)};
}

std::string settingsOfScene(const Scene& scene) {
  if (scene.source.empty()) return "";
  std::string stem = scene.source.filename().string();
  if (isSceneFile(scene.source))
    stem.resize(stem.size() - std::string(kExtension).size());
  else if (scene.variant)
    return "variant=" + *scene.variant;
  else
    stem = scene.source.stem().string();
  // A file's own name may have a '?'.
  const bool hasSettings = scene.name.starts_with(stem + "?");
  return hasSettings ? scene.name.substr(stem.size() + 1) : "";
}

std::vector<fs::path> filesOfScene(const Scene& scene) {
  std::vector<fs::path> files;
  if (scene.source.empty()) return files;
  files.push_back(scene.source);
  while (isSceneFile(files.back()) && files.size() <= size_t(kMostBases)) {
    std::string base;
    try {
      base = ConfigTable::parseFile(files.back()).getString("base", "");
    } catch (const Error&) {
      break;
    }
    if (base.empty() || isBuiltinScene(base)) break;
    const fs::path next = files.back().parent_path() / splitSceneSettings(base).first;
    std::error_code error;
    if (!fs::is_regular_file(next, error)) break;
    files.push_back(next);
  }
  return files;
}

namespace {

// Errors of a configuration are here those of a scene.
template <class Read>
auto asScene(const Read& read) {
  try {
    return read();
  } catch (const Error& error) {
    const bool isTooLarge = error.code() == ExitCode::deviceUnavailable;
    throw Error(isTooLarge ? error.code() : ExitCode::badInput, error.what());
  }
}

}  // namespace

Scene loadSceneFile(const fs::path& file, const std::string& settings) {
  return asScene([&] { return read(file, settings); });
}

std::vector<SceneFileMaterial> sceneFileMaterials(const fs::path& file,
                                                  const std::string& settings) {
  return asScene([&] {
    const ConfigTable table = ConfigTable::parseFile(file);
    applySettings(table, splitBaseSettings(settings).first, file);
    return materialsOf(table);
  });
}

std::vector<ListedMaterial> listMaterials(const fs::path& file, const std::string& settings) {
  return asScene([&] {
    const Nesting nesting(file);
    std::vector<ListedMaterial> all;
    for (SceneFileMaterial& one : sceneFileMaterials(file, settings))
      all.push_back({std::move(one), 0});
    const ConfigTable table = ConfigTable::parseFile(file);
    const auto [name, given] = splitSceneSettings(table.getString("base", ""));
    const fs::path base = file.parent_path() / name;
    std::error_code error;
    if (!isSceneFile(name) || !fs::exists(base, error)) return all;
    const std::string ofBase = splitBaseSettings(settings).second;
    for (ListedMaterial& one : listMaterials(base, joinedSettings(given, ofBase)))
      all.push_back({std::move(one.material), one.bases + 1});
    return all;
  });
}

}  // namespace restlab
