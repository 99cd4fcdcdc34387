#include "core/scene/material_notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace restlab {
namespace {

const ClosureInfo* closureOf(const SceneMaterial& material) {
  for (const ClosureInfo& info : closureRegistry()) {
    if (info.kind == material.data.closure) return &info;
  }
  return nullptr;
}

// Materials of instances, and the parts of those.
std::vector<bool> usedMaterials(const Scene& scene) {
  std::vector<bool> isUsed(scene.materials.size());
  for (const MeshInstance& instance : scene.instances) isUsed.at(instance.material) = true;
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const ClosureInfo* info = closureOf(scene.materials[i]);
    if (!isUsed[i] || info == nullptr) continue;
    for (size_t p = 0; p < info->parameters.size(); ++p) {
      const uint32_t part = scene.materials[i].closure.at(p).words.x;
      if (info->parameters[p].kind == ClosureParameter::Kind::material && part != rl::RL_INVALID)
        isUsed.at(part) = true;
    }
  }
  return isUsed;
}

}  // namespace

std::vector<std::string> brokenLaws(const ClosureInfo& info,
                                    const std::vector<ClosureValue>& parameters) {
  if (info.brokenLaws.empty() || info.brokenWhere.empty()) return info.brokenLaws;
  for (size_t i = 0; i < info.parameters.size(); ++i) {
    const ClosureParameter& p = info.parameters[i];
    if (p.name == info.brokenWhere && p.choices[parameters.at(i).words.x] == info.brokenIf)
      return info.brokenLaws;
  }
  return {};
}

std::vector<std::string> materialNotes(const Scene& scene) {
  std::vector<std::string> notes;
  const std::vector<bool> isUsed = usedMaterials(scene);
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const SceneMaterial& material = scene.materials[i];
    if (!isUsed[i]) continue;
    const std::string& name = material.scattersAs.empty() ? material.name : material.scattersAs;
    const std::string start = fmt::format("{}: material '{}'", scene.name, name);
    if (material.hasDiffusion)
      notes.push_back(start +
                      ": a diffusion profile is biased; model = \"walk\" is what it approximates");
    const ClosureInfo* info = closureOf(material);
    if (info == nullptr) continue;
    const std::vector<std::string> laws = brokenLaws(*info, material.closure);
    if (laws.empty()) continue;
    const std::string where =
        info->brokenWhere.empty() ? "" : ", " + info->brokenWhere + " = " + info->brokenIf;
    notes.push_back(fmt::format("{} ({}{}) {} of a BSDF: {}", start, info->name, where,
                                info->brokenWhere.empty() ? "may break a law" : "breaks laws",
                                fmt::join(laws, " and ")));
  }
  return notes;
}

}  // namespace restlab
