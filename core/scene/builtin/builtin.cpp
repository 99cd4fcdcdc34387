// The registry of the built-in scenes, one line per scene.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/name.h"
#include "core/scene/builtin/relations.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/scene.h"

namespace restlab {
namespace {

struct Entry {
  const char* name;
  Scene (*make)(const BuiltinName&);
  const char* summary;
};

// Adapts a scene without parameters of its own.
template <Scene (*make)()>
Scene fixed(const BuiltinName&) {
  return make();
}

uint32_t wholeNumber(const BuiltinName& name, const char* parameter) {
  return uint32_t(std::lround(name.value(parameter).value()));
}

const std::array<Entry, 19> kScenes{{
    {"cornell-box", fixed<builtin::makeCornellBox>,
     "the Cornell box in metres, Lambert, one ceiling light"},
    {"door-ajar", fixed<builtin::makeDoorAjar>,
     "a dark room lit through a door ajar by a lamp next door: hard indirect light"},
    {"many-lights",
     [](const BuiltinName& name) {
       return builtin::makeManyLights(int(wholeNumber(name, "lamps")));
     },
     "a hall under 5,000 lamps (10,000 emissive triangles) over 3 decades of power"},
    {"glossy-gallery", fixed<builtin::makeGlossyGallery>,
     "metals and plastics of roughness 0.05 to 0.8 under five area lights"},
    {"glass", fixed<builtin::makeGlass>,
     "smooth, frosted and tinted glass before a mirror, one area light"},
    {"course", fixed<builtin::makeCourse>,
     "a lamp, matte walls, a ball of glass and a mirror ball: all light of a lecture"},
    {"courtyard", fixed<builtin::makeCourtyard>,
     "an arcade around a sunlit court under a clear sky: sun and environment"},
    {"furnace",
     [](const BuiltinName& name) {
       return builtin::makeFurnace({.albedo = name.value("albedo").value(),
                                    .height = name.value("height").value(),
                                    .gap = name.value("gap").value(),
                                    .wall = name.value("wall")});
     },
     "closed, albedo 1/2, emitting 1/2: radiance 1 - 2^-(n+1) after n scattering events"},
    {"sphere-furnace",
     [](const BuiltinName& name) { return builtin::makeSphereFurnace(name.value("roughness")); },
     "a white Lambert solid in a uniform environment: radiance 1 everywhere"},
    {"floor",
     [](const BuiltinName& name) {
       return builtin::makeFloor({.viewDegrees = name.value("view").value(),
                                  .slopeDegrees = name.value("slope").value(),
                                  .triangles = std::round(name.value("triangles").value()),
                                  .needle = name.value("needle").value(),
                                  .copies = wholeNumber(name, "copies"),
                                  .sun = name.value("sun").value(),
                                  .spots = wholeNumber(name, "spots"),
                                  .ior = name.value("ior")});
     },
     "a white floor under a uniform sky: radiance 1 everywhere"},
    {"quad-light",
     [](const BuiltinName& name) {
       return builtin::makeQuadLight({.edge = name.value("edge").value(),
                                      .triangles = name.value("triangles").value(),
                                      .ratio = name.value("ratio").value(),
                                      .ground = name.value("ground"),
                                      .stray = name.value("stray")});
     },
     "a floor under one tilted rectangle: Lambert's polygon formula is its truth"},
    {"media",
     [](const BuiltinName& name) {
       return builtin::makeMedia({.overlap = name.value("overlap").value(),
                                  .priority = int(std::lround(name.value("priority").value()))});
     },
     "a camera in a body that absorbs, before two that overlap: Beer and Lambert's law"},
    {"shapes", fixed<builtin::makeShapes>, "one of each kind of shape, and two of them as lamps"},
    {"shape-furnace",
     [](const BuiltinName& name) {
       return builtin::makeShapeFurnace(namedShapes().at(wholeNumber(name, "kind")),
                                        wholeNumber(name, kRepresentationParameter) == 1);
     },
     "a shape that emits 1/2 and reflects 1/2, in a uniform environment: radiance 1 everywhere"},
    {"ball",
     [](const BuiltinName& name) {
       return builtin::makeBall(wholeNumber(name, kRepresentationParameter));
     },
     "a lacquered ball on a floor under a lamp, in several representations"},
    {"teapot",
     [](const BuiltinName& name) {
       return builtin::makeTeapot({.isExact = wholeNumber(name, kRepresentationParameter) == 1,
                                   .chord = name.value("chord")});
     },
     "Newell's teapot: 32 Bezier pieces, as triangles or met exactly"},
    {"implicit",
     [](const BuiltinName& name) { return builtin::makeImplicit(wholeNumber(name, "surface")); },
     "a surface on which a function of x, y and z is 0, on a floor"},
    {"sdf", [](const BuiltinName& name) { return builtin::makeSdf(wholeNumber(name, "solid")); },
     "a solid made of others by their signed distances, on a floor"},
    {"hair",
     [](const BuiltinName& name) {
       return builtin::makeHair({.count = wholeNumber(name, "strands"),
                                 .isMesh = wholeNumber(name, kRepresentationParameter) == 1});
     },
     "a ball with hair: thousands of thin strands, on a floor"},
}};

struct OwnParameter {
  const char* scene;
  SceneParameter parameter;
};

SceneParameter choiceOf(const std::string& name, std::vector<std::string> choices,
                        const std::string& summary) {
  return {name, 0.0, 0.0, double(choices.size() - 1), summary, std::move(choices)};
}

std::vector<std::string> shapeNames() {
  std::vector<std::string> names;
  for (const NamedShape& shape : namedShapes()) names.push_back(shape.name);
  return names;
}

const std::vector<OwnParameter>& ownParameters() {
  static const std::vector<OwnParameter> all = {
      {"many-lights", {"lamps", 5000.0, 1.0, 5e5, "about so many, of the same power together"}},
      {"furnace", {"albedo", 0.5, 0.0, 1.0, "reflectance of every surface"}},
      {"furnace", {"height", 1.0, 1e-5, 1.0, "factor on all heights: a room as flat as a gap"}},
      {"furnace", {"gap", 0.8, 0.0, 1.9, "between the block and the floor, m"}},
      {"furnace",
       {"wall", std::nullopt, 1e-6, 1.0,
        "thickness of the wall to a room that is 10^6 times as bright, m; none without it"}},
      {"sphere-furnace",
       {"roughness", std::nullopt, 0.0, 1.0,
        "metal that reflects everything, of this roughness; Lambert where it is not given"}},
      {"floor", {"view", 45.0, 0.0, 89.99, "angle between the view and the normal, degrees"}},
      {"floor",
       {"ior", std::nullopt, 1.0001, 3.0,
        "a slab of smooth glass of this index instead; goes with 'view' alone"}},
      {"floor", {"slope", 0.0, 0.0, 89.0, "of its normal map, to the side, degrees"}},
      {"floor", {"triangles", 2.0, 0.0, 1e7, "of the floor, about so many; 0: the sky alone"}},
      {"floor", {"needle", 1.0, 1.0, 1e6, "length of its triangles over their width"}},
      {"floor", {"copies", 1.0, 1.0, 8.0, "of the floor, all in one plane"}},
      {"floor", {"sun", 1.0, 1.0, 1e9, "radiance of one pixel of the sky over the others"}},
      {"floor", {"spots", 0.0, 0.0, 1e5, "spot lights, instead of the sky"}},
      {"quad-light", {"edge", 1.0, 1e-4, 1e3, "factor on the light's edges, at constant power"}},
      {"quad-light", {"triangles", 2.0, 2.0, 1e6, "of the light, about so many"}},
      {"quad-light",
       {"ratio", 1.0, 1.0, 1e10, "radiance of one of them over the others, at constant power"}},
      {"quad-light",
       {"ground", std::nullopt, 10.0, 1e7,
        "half the side of a black ground below, with a sun under it, m; none without it"}},
      {"quad-light",
       {"stray", std::nullopt, 10.0, 1e9,
        "distance of a black square along every axis, m; none without it"}},
      {"media", {"overlap", 0.001, 1e-6, 0.9, "of the two bodies, m"}},
      {"media", {"priority", 0.0, -9.0, 9.0, "of the farther one, a whole number"}},
      {"shape-furnace", choiceOf("kind", shapeNames(), "the shape")},
      {"shape-furnace", choiceOf(kRepresentationParameter, {"shape", "mesh"},
                                 "how it is represented: as itself, or by fine triangles")},
      {"ball", choiceOf(kRepresentationParameter, builtin::sphereRepresentations(),
                        "how the ball is represented: the same image")},
      {"implicit", choiceOf("surface", builtin::implicitSurfaces(), "the function")},
      {"sdf", choiceOf("solid", builtin::solids(), "the solid")},
      {"hair", {"strands", 2000.0, 1.0, 2e4, "of the same radius, whatever their number"}},
      {"hair", choiceOf(kRepresentationParameter, {"shape", "mesh"},
                        "strands as themselves, or as tubes of triangles")},
      {"teapot", choiceOf(kRepresentationParameter, {"mesh", "exact"},
                          "as triangles, or as the surface itself")},
      {"teapot",
       {"chord", std::nullopt, 2e-5, 1.0,
        "chord error of the triangles, m; a quarter of a pixel where it is not given"}}};
  return all;
}

// Parameters that every scene has.
const std::vector<SceneParameter>& relations() {
  static const std::vector<SceneParameter> all = {
      {kScaleParameter, 1.0, 1e-9, 1e9, "factor on all lengths, lights with them: the same image"},
      {kRadianceParameter, 1.0, 1e-20, 1e20, "factor on all light, and so on the image"},
      {kMoveParameter, 0.0, -1e7, 1e7,
       "vertices, cameras and lights moved along every axis, by so many times the scene's size"},
      {"fov", std::nullopt, 0.01, 179.0, "vertical field of view of every camera, degrees"}};
  return all;
}

// Finds a scene by its name; parameters behind '?' are ignored.
const Entry* find(const std::string& name) {
  for (const Entry& entry : kScenes) {
    if (name.substr(0, name.find('?')) == entry.name) return &entry;
  }
  return nullptr;
}

const Entry& findOrFail(const std::string& name) {
  const Entry* entry = find(name);
  if (entry == nullptr) {
    const std::string base = name.substr(0, name.find('?'));
    failInput("no built-in scene is named '" + base + "'" + didYouMean(base, builtinSceneNames()));
  }
  return *entry;
}

}  // namespace

Scene makeBuiltinScene(const std::string& name) {
  const BuiltinName parsed = parseBuiltinName(name);
  Scene scene = findOrFail(name).make(parsed);
  if (parsed.given.empty()) return scene;
  builtin::scaleScene(scene, parsed.value(kScaleParameter).value());
  builtin::multiplyRadiance(scene, parsed.value(kRadianceParameter).value());
  builtin::moveScene(scene, parsed.value(kMoveParameter).value());
  if (const auto degrees = parsed.value("fov")) builtin::setFieldOfView(scene, *degrees);
  scene.contentHash = builtin::hashOf(scene);  // hash under the base name: contents only
  scene.name = name;
  return scene;
}

bool isBuiltinScene(const std::string& name) { return find(name) != nullptr; }

std::vector<SceneParameter> builtinSceneParameters(const std::string& name) {
  const std::string base = findOrFail(name).name;
  std::vector<SceneParameter> all;
  for (const OwnParameter& own : ownParameters()) {
    if (own.scene == base) all.push_back(own.parameter);
  }
  all.insert(all.end(), relations().begin(), relations().end());
  return all;
}

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
