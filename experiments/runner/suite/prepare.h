// Turns names on a command line or in a suite into a compiled scene, and describes it in words for
// keys, metadata and results.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/frame/session.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

struct SceneRequest {
  std::string scene;
  std::string camera;                         // name or index; "": the first
  std::string environment;                    // file; "": the scene's own
  std::optional<double> environmentRotation;  // degrees about +Y; absent: as the scene has it
  std::optional<double> environmentScale;     // factor on the radiance
  std::string suiteFolder;                    // also searched for relative names
};

struct PreparedScene {
  std::shared_ptr<const CompiledScene> scene;
  uint32_t camera = 0;
  std::string cameraName;
  std::string environmentName;  // "none", a file or "built-in"
  // Scene bytes, environment texels, rotation and scale, factors of lights.
  uint64_t contentHash = 0;
  std::string lights;       // description of their changes; "": as loaded
  double loadTimeMs = 0.0;  // import and compilation
};

// Imports and compiles a scene. Throws Error: badInput for files, badUsage for an unknown camera.
PreparedScene prepareScene(const SceneRequest& request);

// The same in two steps, for callers that must check the environment. Returns the environment that
// the request names, if any.
std::optional<EnvironmentMap> readEnvironment(const SceneRequest& request);
PreparedScene prepareScene(const SceneRequest& request, std::optional<EnvironmentMap> environment);

// Returns the scene file read again with more settings behind its name, and the camera and the
// environment of `loaded`. Throws Error as prepareScene() does.
PreparedScene withSettings(const PreparedScene& loaded, const std::string& settings);

// Returns the scene compiled with other factors of its lights (core/scene/compiled/light_factor.h).
// `loaded`: the scene as loaded. `words`: description of the factors.
PreparedScene withLights(const PreparedScene& loaded,
                         const std::shared_ptr<const CompiledScene>& scene,
                         const std::string& words);

// Chooses another camera of the scene. Throws badUsage if it does not exist.
void chooseCamera(PreparedScene& prepared, const std::string& nameOrIndex);

// Returns true and sets `missing` if the scene or environment file of the request is not found.
bool assetsMissing(const SceneRequest& request, std::string& missing);

// Prints each warning of the scene on stderr once.
void printWarnings(const PreparedScene& prepared);

// Completes a size with missing sides: the film's pixels, else 512 wide if both are missing, and
// the other side from the
// camera's aspect ratio, or square if the camera has none. Throws badInput naming the camera if the
// resulting side is outside 1..kMaxSide.
void completeResolution(const PreparedScene& prepared, uint32_t& width, uint32_t& height);

std::string hexHash(uint64_t hash);

// Returns the configuration as metadata of an image, without seed, sample count and times. The
// camera is the scene's.
std::map<std::string, std::string> describe(const PreparedScene& prepared,
                                            const SessionConfig& config);

// Replaces the camera in `words` by one that the scene does not have: `camera_index` is "none".
void describeCamera(const SceneCamera& camera, std::map<std::string, std::string>& words);

// Returns every bit of a view as text.
std::string cameraWords(const SceneCamera& camera);

}  // namespace restlab
