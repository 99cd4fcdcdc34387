#include "core/scene/compiled/material_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/scene/compiled/sheen_albedo.h"

namespace restlab {
namespace {

// Exact sRGB decoding of every 8-bit value (IEC 61966-2-1).
std::vector<float> srgbTable() {
  std::vector<float> table(256);
  for (int i = 0; i < 256; ++i) {
    const double c = i / 255.0;
    table[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return table;
}

// Appends each table once. Returns the first record of each.
std::vector<uint32_t> addTables(const Scene& scene, MaterialRecords& records) {
  std::vector<uint32_t> first;
  for (const auto& table : scene.tables) {
    first.push_back(static_cast<uint32_t>(records.closureParameters.size()));
    const std::vector<glm::uvec4> added = tableRecords(*table);
    records.closureParameters.insert(records.closureParameters.end(), added.begin(), added.end());
  }
  return first;
}

// Where a table begins, its sizes and its angles, as core/shading/closures/table.glsl reads them.
glm::uvec4 tableParameter(const ClosureTable& table, uint32_t first) {
  return {first, table.sizes.x | (table.sizes.y << 16u),
          table.sizes.z | (static_cast<uint32_t>(table.angles) << 16u), rl::RL_INVALID};
}

void addMaterial(const SceneMaterial& material, const Scene& scene,
                 const std::vector<uint32_t>& tables, MaterialRecords& records) {
  rl::Material record = material.data;
  record.emission *= material.lightFactor;
  record.firstParameter = static_cast<uint32_t>(records.closureParameters.size());
  for (const ClosureValue& v : material.closure) {
    if (v.table != rl::RL_INVALID) {
      records.closureParameters.push_back(
          tableParameter(*scene.tables.at(v.table), tables.at(v.table)));
      continue;
    }
    const bool isTextured = v.texture != rl::RL_INVALID;
    records.closureParameters.emplace_back(
        v.words, isTextured ? v.texture | (v.channel << rl::RL_PARAMETER_CHANNEL_SHIFT)
                            : uint32_t(rl::RL_INVALID));
  }
  records.materials.push_back(record);
}

void addTextures(const Scene& scene, MaterialRecords& records) {
  std::vector<uint32_t> firstTexel;
  size_t total = 0;
  for (const TextureImage& image : scene.images) {
    firstTexel.push_back(static_cast<uint32_t>(total));
    total += image.texels.size();
  }
  if (total > std::numeric_limits<uint32_t>::max()) {
    failInput(fmt::format("{}: textures have {} texels; at most 4294967295 are supported",
                          scene.name, total));
  }
  records.texels.reserve(total);
  for (const TextureImage& image : scene.images) {
    records.texels.insert(records.texels.end(), image.texels.begin(), image.texels.end());
  }
  for (const TextureUse& use : scene.textureUses) {
    const TextureImage& image = scene.images[use.image];
    rl::Texture t{};
    t.uvRow0 = use.uvRow0;
    t.uvRow1 = use.uvRow1;
    t.firstTexel = firstTexel[use.image];
    t.width = image.width;
    t.height = image.height;
    t.wrapU = use.wrapU;
    t.wrapV = use.wrapV;
    t.flags = (use.nearest ? rl::RL_TEXTURE_NEAREST : 0u) | (use.srgb ? rl::RL_TEXTURE_SRGB : 0u);
    t.uvSet = use.uvSet;
    records.textures.push_back(t);
  }
}

}  // namespace

MaterialRecords materialRecords(const Scene& scene) {
  MaterialRecords records;
  // First of all: kernels find it at record 0.
  const bool hasSheen = std::any_of(
      scene.materials.begin(), scene.materials.end(),
      [](const SceneMaterial& m) { return (m.data.flags & rl::RL_MATERIAL_SHEEN) != 0; });
  if (hasSheen) records.closureParameters = sheenAlbedoTable();
  const std::vector<uint32_t> tables = addTables(scene, records);
  for (const SceneMaterial& material : scene.materials)
    addMaterial(material, scene, tables, records);
  addTextures(scene, records);
  records.srgb = srgbTable();
  return records;
}

}  // namespace restlab
