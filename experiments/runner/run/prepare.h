// From names on a command line or in a suite to a compiled scene, and the words that describe it
// in keys, metadata and results.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/scene/compiled_scene.h"
#include "core/session.h"

namespace restlab {

constexpr uint32_t kMaxSide = 16384;  // pixels

struct SceneRequest {
  std::string scene;
  std::string camera;                         // name or index; "": the first
  std::string environment;                    // file; "": the scene's own
  std::optional<double> environmentRotation;  // degrees about +Y; absent: as the scene has it
  std::optional<double> environmentScale;     // factor on the radiance
  std::string suiteFolder;                    // where relative names are looked for as well
};

struct PreparedScene {
  std::shared_ptr<const CompiledScene> scene;
  uint32_t camera = 0;
  std::string cameraName;
  std::string environmentName;  // "none", a file or "built-in"
  // Scene bytes, environment texels, rotation and scale, factors of lights.
  uint64_t contentHash = 0;
  std::string lights;       // the events that changed them, in words; "": they are as loaded
  double loadTimeMs = 0.0;  // import and compilation
};

// Imports and compiles. Throws Error: badInput for files, badUsage for an unknown camera.
PreparedScene prepareScene(const SceneRequest& request);

// In two steps, for callers that know more of where a request comes from. The environment that the
// request names; nothing where it names none.
std::optional<EnvironmentMap> readEnvironment(const SceneRequest& request);
PreparedScene prepareScene(const SceneRequest& request, std::optional<EnvironmentMap> environment);

// The same scene, compiled with other factors of its lights (core/scene/light_factor.h); `words`
// say which. `loaded` is as it was loaded.
PreparedScene withLights(const PreparedScene& loaded,
                         const std::shared_ptr<const CompiledScene>& scene,
                         const std::string& words);

// Another camera of the same scene; throws badUsage where there is none.
void chooseCamera(PreparedScene& prepared, const std::string& nameOrIndex);

// True when the scene or the environment of the request is a file that is nowhere to be found.
bool assetsMissing(const SceneRequest& request, std::string& missing);

// Prints the scene's warnings on stderr, each once.
void printWarnings(const PreparedScene& prepared);

// Sides of "640x360"; throws badUsage with `place` where it is none or a side is outside
// 1..kMaxSide.
void parseResolution(const std::string& text, const std::string& place, uint32_t& width,
                     uint32_t& height);

// The size in pixels where only one side, or none, was given: 512 wide, and the height from the
// camera's aspect ratio, or square where the camera leaves it free. Throws badInput naming the
// camera where its ratio asks for a side outside 1..kMaxSide.
void completeResolution(const PreparedScene& prepared, uint32_t& width, uint32_t& height);

std::string componentName(uint32_t components);
// Throws badUsage with the nearest name; `place` names the option or the file position.
uint32_t parseComponent(const std::string& name, const std::string& place);
std::string filterName(uint32_t filter);
uint32_t parseFilter(const std::string& name, const std::string& place);
std::string hexHash(uint64_t hash);
std::string parameterText(const ParameterValue& value);

// The configuration as metadata of an image, without seed, sample count and times. The camera is
// the scene's.
std::map<std::string, std::string> describe(const PreparedScene& prepared,
                                            const SessionConfig& config);

// Replaces the camera in `words` by one that is not of the scene: `camera_index` is "none".
void describeCamera(const SceneCamera& camera, std::map<std::string, std::string>& words);

}  // namespace restlab
