#include "experiments/cli/info_materials.h"

#include <fmt/format.h>

#include <bit>
#include <set>

#include "core/scene/closure_info.h"

namespace restlab {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ClosureParameter::Kind;

Json valueOf(const Scene& scene, const ClosureParameter& p, const ClosureValue& v) {
  const auto number = [](uint32_t word) { return double(std::bit_cast<float>(word)); };
  Json value;
  if (p.kind == Kind::table) {
    value = scene.tables.at(v.table)->name;
  } else if (p.kind == Kind::material) {
    value = v.words.x == rl::RL_INVALID ? "none" : scene.materials.at(v.words.x).name;
  } else if (p.kind == Kind::choice) {
    value = p.choices.at(v.words.x);
  } else if (p.kind == Kind::number) {
    value = number(v.words.x);
  } else {
    value = {number(v.words.x), number(v.words.y), number(v.words.z)};
  }
  if (v.texture == rl::RL_INVALID) return value;
  return {{"factor", value},
          {"texture", scene.images.at(scene.textureUses.at(v.texture).image).name}};
}

std::string textOf(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_object())
    return textOf(value["factor"]) + " times " + value["texture"].get<std::string>();
  std::string text;
  for (const Json& one : value) text += (text.empty() ? "" : " ") + textOf(one);
  return text;
}

}  // namespace

Json closuresOfScene(const Scene& scene) {
  std::set<uint32_t> used;
  for (const MeshInstance& instance : scene.instances) used.insert(instance.material);
  Json all = Json::array();
  for (const uint32_t index : used) {
    const SceneMaterial& material = scene.materials.at(index);
    if (material.data.closure == rl::RL_CLOSURE_GLTF) continue;
    const ClosureInfo& info = closureRegistry().at(material.data.closure - 1);
    Json parameters = Json::object();
    for (size_t i = 0; i < info.parameters.size(); ++i)
      parameters[info.parameters[i].name] =
          valueOf(scene, info.parameters[i], material.closure.at(i));
    all.push_back({{"name", material.name}, {"kind", info.name}, {"parameters", parameters}});
  }
  return all;
}

std::string closureLine(const Json& closure) {
  std::string line = fmt::format("'{}' {}", closure["name"].get<std::string>(),
                                 closure["kind"].get<std::string>());
  for (const auto& [name, value] : closure["parameters"].items())
    line += fmt::format(", {} {}", name, textOf(value));
  return line;
}

}  // namespace restlab
