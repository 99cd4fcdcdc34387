// Offsets of the shared structs: glslang's `scalar` layout against C++.
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/dialect/order.h"
#include "integrators/restir_gi/restir_gi.h"
#include "tests/parity/kernel_runner.h"

namespace restlab::parity {
namespace {

using Offsets = std::map<std::string, uint32_t>;

// Reads member offsets of every struct in a buffer, by struct and member name, from SPIR-V.
std::map<std::string, Offsets> offsetsOf(const std::vector<uint32_t>& spirv) {
  constexpr uint32_t kOpName = 5, kOpMemberName = 6, kOpMemberDecorate = 72, kDecorationOffset = 35;
  std::map<uint32_t, std::string> names;
  std::map<uint32_t, std::map<uint32_t, std::string>> memberNames;
  std::map<uint32_t, std::map<uint32_t, uint32_t>> offsets;
  for (size_t i = 5; i < spirv.size(); i += spirv[i] >> 16) {
    const uint32_t op = spirv[i] & 0xffffu;
    const uint32_t* word = &spirv[i];
    if (op == kOpName) names[word[1]] = reinterpret_cast<const char*>(word + 2);
    if (op == kOpMemberName)
      memberNames[word[1]][word[2]] = reinterpret_cast<const char*>(word + 3);
    if (op == kOpMemberDecorate && word[3] == kDecorationOffset)
      offsets[word[1]][word[2]] = word[4];
  }
  std::map<std::string, Offsets> result;
  for (const auto& [id, members] : offsets) {
    for (const auto& [index, offset] : members) result[names[id]][memberNames[id][index]] = offset;
  }
  return result;
}

#define FIELD(Struct, member) \
  { #member, static_cast<uint32_t>(offsetof(rl::Struct, member)) }

const std::map<std::string, Offsets>& expected() {
  static const std::map<std::string, Offsets> table = {
      {"Geometry",
       {FIELD(Geometry, firstTriangle), FIELD(Geometry, triangleCount),
        FIELD(Geometry, firstVertex), FIELD(Geometry, normalOffset), FIELD(Geometry, tangentOffset),
        FIELD(Geometry, colorOffset), FIELD(Geometry, uvOffset), FIELD(Geometry, shape),
        FIELD(Geometry, firstShapeWord)}},
      {"Instance",
       {FIELD(Instance, objectToWorldRow0), FIELD(Instance, objectToWorldRow1),
        FIELD(Instance, objectToWorldRow2), FIELD(Instance, worldToObjectRow0),
        FIELD(Instance, worldToObjectRow1), FIELD(Instance, worldToObjectRow2),
        FIELD(Instance, geometry), FIELD(Instance, material), FIELD(Instance, firstLight),
        FIELD(Instance, flags)}},
      {"Material",
       {FIELD(Material, baseColor), FIELD(Material, alpha), FIELD(Material, emission),
        FIELD(Material, alphaCutoff), FIELD(Material, metallic), FIELD(Material, roughness),
        FIELD(Material, ior), FIELD(Material, transmission), FIELD(Material, specularColor),
        FIELD(Material, specular), FIELD(Material, sigmaAbsorption), FIELD(Material, normalScale),
        FIELD(Material, flags), FIELD(Material, textures), FIELD(Material, closure),
        FIELD(Material, firstParameter), FIELD(Material, padding0), FIELD(Material, padding1)}},
      {"Texture",
       {FIELD(Texture, uvRow0), FIELD(Texture, uvRow1), FIELD(Texture, firstTexel),
        FIELD(Texture, width), FIELD(Texture, height), FIELD(Texture, wrapU), FIELD(Texture, wrapV),
        FIELD(Texture, flags), FIELD(Texture, uvSet), FIELD(Texture, padding0),
        FIELD(Texture, padding1), FIELD(Texture, padding2)}},
      {"Light",
       {FIELD(Light, p0), FIELD(Light, kind), FIELD(Light, e1), FIELD(Light, pmf), FIELD(Light, e2),
        FIELD(Light, areaInverse), FIELD(Light, radiance), FIELD(Light, instance),
        FIELD(Light, primitive), FIELD(Light, flags), FIELD(Light, magnitude),
        FIELD(Light, padding)}},
      {"AliasEntry", {FIELD(AliasEntry, keep), FIELD(AliasEntry, other), FIELD(AliasEntry, pmf)}},
      {"Camera",
       {FIELD(Camera, posW), FIELD(Camera, kind), FIELD(Camera, rightW), FIELD(Camera, halfWidth),
        FIELD(Camera, upW), FIELD(Camera, halfHeight), FIELD(Camera, forwardW),
        FIELD(Camera, shiftX), FIELD(Camera, shiftY), FIELD(Camera, padding0),
        FIELD(Camera, padding1), FIELD(Camera, padding2)}},
      {"FrameData",
       {FIELD(FrameData, camera), FIELD(FrameData, previousCamera), FIELD(FrameData, cameraMedia),
        FIELD(FrameData, width), FIELD(FrameData, height), FIELD(FrameData, frame),
        FIELD(FrameData, seed), FIELD(FrameData, pixelFilter), FIELD(FrameData, maxBounces),
        FIELD(FrameData, components), FIELD(FrameData, rouletteStart),
        FIELD(FrameData, multiscatter), FIELD(FrameData, stillFrames),
        FIELD(FrameData, radianceFrames), FIELD(FrameData, cameraAbsorbs),
        FIELD(FrameData, lightTree), FIELD(FrameData, sharesFilm), FIELD(FrameData, drawnLights)}},
      {"SceneData",
       {FIELD(SceneData, positions),
        FIELD(SceneData, normals),
        FIELD(SceneData, tangents),
        FIELD(SceneData, colors),
        FIELD(SceneData, uvs),
        FIELD(SceneData, triangles),
        FIELD(SceneData, geometries),
        FIELD(SceneData, instances),
        FIELD(SceneData, materials),
        FIELD(SceneData, textures),
        FIELD(SceneData, texels),
        FIELD(SceneData, srgbToLinear),
        FIELD(SceneData, lights),
        FIELD(SceneData, lightAlias),
        FIELD(SceneData, lightTree),
        FIELD(SceneData, lightTrails),
        FIELD(SceneData, environment),
        FIELD(SceneData, environmentAlias),
        FIELD(SceneData, closureParameters),
        FIELD(SceneData, shapeWords),
        FIELD(SceneData, bodies),
        FIELD(SceneData, ggxAlbedo),
        FIELD(SceneData, bvh),
        FIELD(SceneData, bvhRoots),
        FIELD(SceneData, accelerationStructure),
        FIELD(SceneData, lightCount),
        FIELD(SceneData, environmentWidth),
        FIELD(SceneData, environmentHeight),
        FIELD(SceneData, environmentLight),
        FIELD(SceneData, environmentRotation),
        FIELD(SceneData, instanceCount),
        FIELD(SceneData, bodiesMeet),
        FIELD(SceneData, ambient),
        FIELD(SceneData, background),
        FIELD(SceneData, hasBackground),
        FIELD(SceneData, lampShare),
        FIELD(SceneData, hasMedia)}},
      {"ReuseBuffers",
       {FIELD(ReuseBuffers, gbuffer),       FIELD(ReuseBuffers, gbufferPrevious),
        FIELD(ReuseBuffers, proposals),     FIELD(ReuseBuffers, shadingPoints),
        FIELD(ReuseBuffers, insertions),    FIELD(ReuseBuffers, cells),
        FIELD(ReuseBuffers, radiance),      FIELD(ReuseBuffers, radianceFrames),
        FIELD(ReuseBuffers, unresampled),   FIELD(ReuseBuffers, unresampledPrevious),
        FIELD(ReuseBuffers, reservoirs),    FIELD(ReuseBuffers, history),
        FIELD(ReuseBuffers, pairedShifts0), FIELD(ReuseBuffers, pairedShifts1),
        FIELD(ReuseBuffers, pairedShifts2), FIELD(ReuseBuffers, pairedShifts3),
        FIELD(ReuseBuffers, outlines),      FIELD(ReuseBuffers, sampleFilms),
        FIELD(ReuseBuffers, duplicates),    FIELD(ReuseBuffers, entryReservoirs),
        FIELD(ReuseBuffers, changes)}},
      {"ReuseParams",
       {FIELD(ReuseParams, temporalFlags), FIELD(ReuseParams, spatialFlags),
        FIELD(ReuseParams, spatialNeighbours), FIELD(ReuseParams, agedNeighbours),
        FIELD(ReuseParams, youngFrames), FIELD(ReuseParams, lightEdgeSamples),
        FIELD(ReuseParams, donorNoise), FIELD(ReuseParams, temporalReuse),
        FIELD(ReuseParams, reproject), FIELD(ReuseParams, confidenceCap),
        FIELD(ReuseParams, movingConfidenceCap), FIELD(ReuseParams, maxReflectanceRatio),
        FIELD(ReuseParams, spatialFeedback), FIELD(ReuseParams, duplicationMap),
        FIELD(ReuseParams, spatialRounds), FIELD(ReuseParams, spatialRound),
        FIELD(ReuseParams, writesRadianceFrames)}},
      {"PathReuseParams",
       {FIELD(PathReuseParams, reuse), FIELD(PathReuseParams, path), FIELD(PathReuseParams, pairs),
        FIELD(PathReuseParams, entries), FIELD(PathReuseParams, cells),
        FIELD(PathReuseParams, changes)}},
      {"ChangeParams", {FIELD(ChangeParams, every), FIELD(ChangeParams, response)}},
      {"ChangeBuffers",
       {FIELD(ChangeBuffers, found), FIELD(ChangeBuffers, differences),
        FIELD(ChangeBuffers, changes)}},
      {"PathParams",
       {FIELD(PathParams, lightCandidates), FIELD(PathParams, minAlpha),
        FIELD(PathParams, maxJacobian), FIELD(PathParams, unshadowedTarget),
        FIELD(PathParams, mostReplayed), FIELD(PathParams, footprint)}},
      {"PairParams", {FIELD(PairParams, tile), FIELD(PairParams, similarity)}},
      {"SimilarityThresholds",
       {FIELD(SimilarityThresholds, minNormalDot), FIELD(SimilarityThresholds, maxPlaneDistance)}},
      {"EntryParams",
       {FIELD(EntryParams, count), FIELD(EntryParams, proposals), FIELD(EntryParams, insertEvery),
        FIELD(EntryParams, cap), FIELD(EntryParams, spread)}},
      {"GridParams", {FIELD(GridParams, places), FIELD(GridParams, probes)}},
      {"RadianceBuffers",
       {FIELD(RadianceBuffers, keys), FIELD(RadianceBuffers, places), FIELD(RadianceBuffers, light),
        FIELD(RadianceBuffers, rays)}},
      {"RadianceParams",
       {FIELD(RadianceParams, count), FIELD(RadianceParams, grid), FIELD(RadianceParams, every),
        FIELD(RadianceParams, cellPixels), FIELD(RadianceParams, footprint),
        FIELD(RadianceParams, minAlpha), FIELD(RadianceParams, leastCount)}},
  };
  return table;
}

TEST(Layout, StructsLieAlikeInBothLanguages) {
  std::map<std::string, Offsets> found = offsetsOf(
      compileKernel("integrators/restir_gi/restir_gi.h", "integrators/restir_gi/initial.glsl"));
  found.merge(offsetsOf(
      compileKernel("core/temporal_gradients/passes.h", "core/temporal_gradients/share.glsl")));
  for (const auto& [name, offsets] : expected()) {
    SCOPED_TRACE(name);
    const auto it = found.find(name);
    ASSERT_NE(it, found.end()) << "is in no buffer of the kernel";
    // Compares the set of members, too: a new field must be added above.
    EXPECT_EQ(it->second, offsets);
  }
}

}  // namespace
}  // namespace restlab::parity
