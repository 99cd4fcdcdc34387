#include "core/scene/gltf/closures.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/gltf/json.h"
#include "core/scene/scene_file/scene_file.h"

namespace restlab::gltf {
namespace {

std::string placeOf(size_t material) {
  return fmt::format("materials[{}].extras.restlab", material);
}

bool isPlain(const nlohmann::json& value) {
  return value.is_string() || value.is_number() || value.is_boolean();
}

// TOML of one material; its text of strings, numbers and arrays is that of JSON.
std::string tomlOf(const nlohmann::json& restlab, const std::string& name, size_t index,
                   Report& report) {
  if (!restlab.is_object())
    report.fail(placeOf(index), "is not an object: {\"kind\": ..., parameters} expected");
  std::string text = fmt::format("name = {}\n", nlohmann::json(name).dump());
  for (const auto& [key, value] : restlab.items()) {
    const bool isList = value.is_array() && std::all_of(value.begin(), value.end(), isPlain);
    if (!isPlain(value) && !isList)
      report.fail(placeOf(index) + "." + key, "is neither a number, a text nor an array of them");
    if (key == "include") report.fail(placeOf(index) + ".include", "is no parameter of a material");
    if (key != "name") text += fmt::format("{} = {}\n", nlohmann::json(key).dump(), value.dump());
  }
  return text;
}

}  // namespace

std::vector<std::string> readClosures(const nlohmann::json& document, Report& report) {
  std::vector<std::string> closures;
  for (const nlohmann::json& material : arrayOf(document, "materials")) {
    const size_t index = closures.size();
    closures.emplace_back();
    const auto extras = material.find("extras");
    if (extras == material.end() || !extras->is_object() || !extras->contains("restlab")) continue;
    const std::string name = material.value("name", fmt::format("material {}", index));
    closures.back() = tomlOf((*extras)["restlab"], name, index, report);
  }
  return closures;
}

void applyClosures(const std::vector<std::string>& closures, const std::filesystem::path& file,
                   Scene& scene) {
  SceneFileInputs inputs(file.parent_path(), scene);
  for (size_t i = 0; i < closures.size(); ++i) {
    if (closures[i].empty()) continue;
    try {
      const ConfigTable table =
          ConfigTable::parseText(closures[i], fmt::format("{}: {}", file.string(), placeOf(i)));
      const Scattering scattering = readScattering(table, inputs);
      inputs.offer(scattering);
      scatterAs(scattering, scene.materials.at(i));
    } catch (const Error& error) {
      throw Error(ExitCode::badInput, error.what());
    }
  }
}

}  // namespace restlab::gltf
