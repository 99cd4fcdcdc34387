#include "experiments/bsdf/tested_material.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/config.h"
#include "core/base/error.h"

namespace restlab {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTableOf = "conductor";

bool namesOthers(const MaterialKind& kind) {
  using Kind = ClosureParameter::Kind;
  return std::any_of(kind.parameters.begin(), kind.parameters.end(), [](const ClosureParameter& p) {
    return p.kind == Kind::table || p.kind == Kind::material;
  });
}

bool isSet(const std::vector<std::string>& settings, const std::string& key) {
  return std::any_of(settings.begin(), settings.end(), [&](const std::string& setting) {
    return splitAssignment(setting).first == key;
  });
}

ConfigTable tableOf(const std::string& kind) {
  return ConfigTable::parseText(fmt::format("name = \"{0}\"\nkind = \"{0}\"\n", kind),
                                "bsdf " + kind);
}

void assignDefault(ConfigTable& table, const std::vector<std::string>& settings, const char* key,
                   const char* value) {
  if (!isSet(settings, key)) table.assign(key, value, "bsdf");
}

}  // namespace

TestedMaterial testedMaterial(const std::string& kind, const std::vector<std::string>& settings) {
  std::vector<std::string> names;
  for (const MaterialKind& k : materialKinds()) names.push_back(k.name);
  if (std::find(names.begin(), names.end(), kind) == names.end())
    failUsage(fmt::format("bsdf {}: unknown kind of material; one of {}{}", kind,
                          fmt::join(names, ", "), didYouMean(kind, names)));
  TestedMaterial tested;
  SceneFileInputs inputs(fs::current_path(), tested.inputs);
  ConfigTable table = tableOf(kind);
  if (kind == "mixture") {
    for (const MaterialKind& k : materialKinds()) {
      if (!namesOthers(k)) inputs.offer(readScattering(tableOf(k.name), inputs));
    }
    assignDefault(table, settings, "first", "conductor");
    assignDefault(table, settings, "second", "diffuse");
  }
  if (kind == "table" && !isSet(settings, "file")) {
    auto values = std::make_shared<ClosureTable>(
        tabulated(testedMaterial(kTableOf, {}), TableAngles::half, kMerlSizes));
    values->name = kTableOf;
    inputs.offer(std::shared_ptr<const ClosureTable>(std::move(values)));
    table.assign("file", kTableOf, "bsdf");
  }
  for (const std::string& setting : settings) {
    const auto [key, value] = splitAssignment(setting);
    table.assign(key, value, "--set " + setting);
  }
  tested.scattering = readScattering(table, inputs);
  tested.material.name = kind;
  tested.material.data.alpha = 1.0f;
  std::fill(std::begin(tested.material.data.textures), std::end(tested.material.data.textures),
            rl::RL_INVALID);
  scatterAs(tested.scattering, tested.material);
  return tested;
}

ClosureTable tabulated(const TestedMaterial& tested, TableAngles angles, const glm::uvec3& sizes) {
  const BsdfProbe probe(tested.material, tested.inputs);
  const char* what = probe.hasDelta()          ? "a smooth mirror, whose values are infinite"
                     : probe.hasTransmission() ? "light that passes"
                     : (tested.material.data.flags &
                        (rl::RL_MATERIAL_ANISOTROPIC | rl::RL_MATERIAL_ANISOTROPY)) != 0
                         ? "a lobe that depends on the tangent"
                         : nullptr;
  if (what != nullptr)
    failUsage(fmt::format("bsdf {}: it has {}: no table holds that", tested.material.name, what));
  const BrdfFunction f = [&](const glm::dvec3& wo, const glm::dvec3& wi) {
    double pdf = 0.0;
    return probe.eval(wo, wi, pdf) / wi.z;
  };
  return tabulate(f, angles, sizes);
}

}  // namespace restlab
