// The registry of the built-in scenes: one line a scene.
#include <array>

#include "core/error.h"
#include "core/scene/builtin_scenes.h"
#include "core/scene/scene.h"

namespace restlab {
namespace {

struct Entry {
  const char* name;
  Scene (*make)();
  const char* summary;
};

constexpr std::array<Entry, 9> kScenes{{
    {"cornell-box", builtin::makeCornellBox,
     "the Cornell box in metres, Lambert, one ceiling light"},
    {"door-ajar", builtin::makeDoorAjar,
     "a dark room lit through a door ajar by a lamp next door: hard indirect light"},
    {"many-lights", builtin::makeManyLights,
     "a hall under 5,000 lamps (10,000 emissive triangles) over 3 decades of power"},
    {"glossy-gallery", builtin::makeGlossyGallery,
     "metals and plastics of roughness 0.05 to 0.8 under five area lights"},
    {"glass", builtin::makeGlass,
     "smooth, frosted and tinted glass before a mirror, one area light"},
    {"courtyard", builtin::makeCourtyard,
     "an arcade around a sunlit court under a clear sky: sun and environment"},
    {"furnace", builtin::makeFurnace,
     "closed, albedo 1/2, emitting 1/2: radiance 1 - 2^-(n+1) after n scattering events"},
    {"sphere-furnace", builtin::makeSphereFurnace,
     "a white Lambert solid in a uniform environment: radiance 1 everywhere"},
    {"quad-light", builtin::makeQuadLight,
     "a floor under one tilted rectangle: Lambert's polygon formula is its truth"},
}};

const Entry* find(const std::string& name) {
  for (const Entry& entry : kScenes) {
    if (name == entry.name) return &entry;
  }
  return nullptr;
}

const Entry& findOrFail(const std::string& name) {
  const Entry* entry = find(name);
  if (entry == nullptr) {
    failInput("no built-in scene is named '" + name + "'" + didYouMean(name, builtinSceneNames()));
  }
  return *entry;
}

}  // namespace

Scene makeBuiltinScene(const std::string& name) { return findOrFail(name).make(); }

const std::vector<std::string>& builtinSceneNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Entry& entry : kScenes) all.push_back(entry.name);
    return all;
  }();
  return names;
}

std::string builtinSceneSummary(const std::string& name) { return findOrFail(name).summary; }

}  // namespace restlab
