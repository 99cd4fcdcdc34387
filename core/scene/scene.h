// A scene as imported: host data in SI units, Y up, right-handed, radiance in linear Rec. 709.
// compiled_scene.h turns it into the buffers that kernels read.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/dialect/types.h"
#include "core/scene/closure_table/closure_table.h"

namespace restlab {

struct ShapeInfo;

// A shape of core/scene/shapes/shape_info.h.
struct ShapeGeometry {
  const ShapeInfo* info = nullptr;
  std::vector<float> values;      // one for each of its parameters
  std::vector<uint32_t> words{};  // behind them for kernels: control points, programs
};

// One triangle mesh with one material (a glTF mesh primitive). Attributes are per vertex; empty
// means absent. Non-finite positions and out-of-range indices are rejected at import.
struct MeshGeometry {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;   // empty: flat shading
  std::vector<glm::vec4> tangents;  // w: handedness; empty: derived from UVs
  std::vector<glm::vec4> colors;    // linear RGBA, multiplies the base colour
  std::array<std::vector<glm::vec2>, rl::RL_MAX_UV_SETS> uvs;
  std::vector<glm::uvec3> triangles;
  // Not null: rays meet this shape instead, and the triangles only stand in for it.
  std::shared_ptr<const ShapeGeometry> shape{};
};

struct MeshInstance {
  std::string name;
  uint32_t geometry = 0;
  uint32_t material = 0;
  glm::dmat4 objectToWorld{1.0};
};

// RGBA8 image, row 0 on top. 16-bit images are rounded to 8 bits with a warning.
struct TextureImage {
  std::string name;
  uint32_t width = 0, height = 0;
  std::vector<uint32_t> texels;  // R in the low byte
};

// A use of an image by a material slot: rl::Texture without addresses.
struct TextureUse {
  uint32_t image = 0;
  uint32_t uvSet = 0;
  uint32_t wrapU = rl::RL_WRAP_REPEAT, wrapV = rl::RL_WRAP_REPEAT;
  bool nearest = false;
  bool srgb = false;
  glm::vec3 uvRow0{1, 0, 0}, uvRow1{0, 1, 0};
};

// The value of one parameter of a closure (core/scene/closure_info.h).
struct ClosureValue {
  // Bits of a colour or of a number (x); the index of a choice, or of a material in
  // Scene::materials (RL_INVALID: none).
  glm::uvec3 words{0u};
  uint32_t texture = rl::RL_INVALID;  // index into Scene::textureUses: multiplies the value
  uint32_t channel = 0;               // of the texture, for a number: 0 to 3
  uint32_t table = rl::RL_INVALID;    // index into Scene::tables: in place of words
};

struct SceneMaterial {
  std::string name;
  rl::Material data{};                  // data.textures[] index Scene::textureUses
  std::vector<ClosureValue> closure{};  // parameters of data.closure, as its file orders them
  // Scattering inside of a body: m^-1, and the mean cosine of the angles; data.sigmaAbsorption is
  // beside it.
  glm::vec3 sigmaScattering{0.0f};
  float phase = 0.0f;
  std::string scattersAs{};   // the [[material]] or extras that say how; "": the file's own
  bool hasDiffusion = false;  // light leaves it by a diffusion profile, not by a random walk
  float lightFactor = 1.0f;   // factor on data.emission (core/scene/compiled/light_factor.h)
  bool isPart = false;        // of a mixture alone: no instance has it
  int priority = 0;           // among overlapping bodies, the greatest fills the place
};

struct SceneCamera {
  std::string name;
  uint32_t kind = rl::RL_CAMERA_PERSPECTIVE;
  glm::dmat4 cameraToWorld{1.0};  // looks along -Z, +Y up; right-handed; scale is ignored
  bool isMirrored = false;        // the image is mirrored left to right
  double yfov = 0.8;              // radians (perspective)
  double xmag = 1.0, ymag = 1.0;  // half extents in metres (orthographic)
  double aspect = 0.0;            // width / height, 0: free
  // The film's centre, to the right and up: a tangent (perspective) or metres (orthographic). Other
  // than 0 where the film is a part of a larger one.
  glm::dvec2 shift{0.0};
  glm::uvec2 film{0u};  // pixels that images have unless others are asked for; 0: the file has none
  double znear = 0.0;   // metres, from the file; no clipping, only warnings (camera_path.h)
};
inline glm::dvec3 positionOf(const SceneCamera& camera) {
  return glm::dvec3(camera.cameraToWorld[3]);
}

struct PunctualLight {
  std::string name;
  uint32_t kind = rl::RL_LIGHT_POINT;
  glm::dvec3 posW{0.0};
  glm::dvec3 dirW{0.0, 0.0, -1.0};          // direction of travel (spot, directional)
  glm::vec3 intensity{1.0f};                // W/sr (point, spot), W/m^2 (directional)
  glm::vec3 attenuation{0.0f, 0.0f, 1.0f};  // of points: 1 / (x + y r + z r^2), r in metres
  float innerConeAngle = 0.0f, outerConeAngle = 0.785398f;  // radians
  float lightFactor = 1.0f;  // factor on the intensity (core/scene/compiled/light_factor.h)
};

// Latitude-longitude map, row 0 at +Y; u = 0.5 looks along -Z rotated by `rotation` about +Y.
struct EnvironmentMap {
  std::string source;
  uint32_t width = 0, height = 0;
  std::vector<glm::vec3> radiance;
  float rotation = 0.0f;  // radians
  float scale = 1.0f;
  float lightFactor = 1.0f;             // factor on scale (core/scene/compiled/light_factor.h)
  std::vector<std::string> warnings{};  // about its file, one line each
};

struct Scene {
  std::string name;              // a built-in's name or the file's stem
  std::filesystem::path source;  // empty for a built-in
  std::vector<MeshGeometry> geometries;
  std::vector<MeshInstance> instances;
  std::vector<SceneMaterial> materials;
  std::vector<TextureUse> textureUses;
  std::vector<TextureImage> images;
  std::vector<std::shared_ptr<const ClosureTable>> tables;
  std::vector<SceneCamera>
      cameras;  // never empty after loading: one is made when the file has none
  std::optional<uint32_t> maxBounces;  // taken unless others are asked for; the file's integrator
  uint32_t mainCamera = 0;  // its view is the most precise (core/scene/compiled/scene_origin.h)
  std::vector<PunctualLight> lights;
  std::optional<EnvironmentMap> environment;
  // Radiance that comes from everywhere and that nothing shadows: every surface that does not emit
  // sends it on, times its approximate albedo.
  glm::vec3 ambient{0.0f};
  float ambientFactor = 1.0f;           // core/scene/compiled/light_factor.h
  std::optional<glm::vec3> background;  // radiance that the camera sees where it sees nothing
  std::vector<std::string> warnings;    // one line each, printed by the program
  std::vector<std::string> notes;       // likewise: what the reader did in another way
  uint64_t contentHash = 0;             // hash of every byte the scene was made from
  size_t skippedPrimitives = 0;         // number of points and lines
  // Names in KHR_materials_variants, and the one whose materials are drawn (nullopt: the default).
  std::vector<std::string> variants;
  std::optional<std::string> variant;
};

// Imports a glTF 2.0 file (.gltf or .glb), with the materials of a variant if one is named. Throws
// Error (badInput) with one line.
Scene loadGltf(const std::filesystem::path& file, const std::optional<std::string>& variant = {});

// Scene::maxBounces of a glTF file, without loading all of it. Throws Error (badInput).
std::optional<uint32_t> bouncesOfGltf(const std::filesystem::path& file);

// Parameter in the name of a built-in scene, "furnace?albedo=0.9"
// (core/scene/builtin/name.h).
struct SceneParameter {
  std::string name;
  std::optional<double> fallback;  // absent: `summary` says what applies if not given
  double lo = 0.0, hi = 0.0;       // inclusive
  std::string summary;
  // Names of the values 0, 1, 2, ...: the only ones that it takes. Empty: it takes numbers.
  std::vector<std::string> choices{};
};

// Makes a built-in scene; the name is one of builtinSceneNames(), with or without parameters behind
// a '?'. Equal contents have equal content hashes, whatever the name. Throws Error (badInput).
Scene makeBuiltinScene(const std::string& name);
const std::vector<std::string>& builtinSceneNames();
// Returns whether this names a built-in scene; text behind a '?' is ignored.
bool isBuiltinScene(const std::string& name);
// One-line summary for `restlab list scenes`.
std::string builtinSceneSummary(const std::string& name);
// Parameters of this scene, then those of every built-in scene.
std::vector<SceneParameter> builtinSceneParameters(const std::string& name);

// Loads a built-in by name, or a path (glTF, scene files, Mitsuba's XML): tried as given, then
// under RESTLAB_SCENES, then under
// ../shared/scenes; a directory or a stem finds the one scene inside. Throws Error (badInput).
Scene loadScene(const std::string& nameOrPath);

// Scene::maxBounces of a scene, found as loadScene() finds it, without loading all of it. nullopt
// also if there is no such scene. Throws as loadScene() where a file is damaged.
std::optional<uint32_t> suggestedBounces(const std::string& nameOrPath);

// Reads a latitude-longitude .hdr or .exr, or an .exr that declares itself a cube. Negative and
// non-finite texels are an error.
EnvironmentMap loadEnvironment(const std::filesystem::path& file);

// Makes a camera that looks at the whole scene, for files that have none.
SceneCamera framingCamera(const Scene& scene);

// Index of the camera with that name or number; throws Error (badUsage) with the nearest name.
uint32_t findCamera(const Scene& scene, const std::string& nameOrIndex);

// World bounding box of all instances (min, max).
std::array<glm::dvec3, 2> worldBounds(const Scene& scene);
// Bounding box without strays, which lie a hundred times farther out than all else: lost vertices,
// a huge ground.
std::array<glm::dvec3, 2> boundsWithoutStrays(const Scene& scene);

}  // namespace restlab
