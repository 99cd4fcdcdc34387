// Session: scene + integrator + cache + denoiser + backend -> frames. The one thing that the
// experiment runner, the renderer, the viewer and the tests all drive.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/integrator.h"
#include "core/scene/scene.h"

namespace restlab {

class CompiledScene;   // core/scene/compiled_scene.h
struct StartupReport;  // core/backend/backend.h

struct SessionConfig {
  std::string integrator = "path";
  std::string mode;   // "": the integrator's first
  std::string cache;  // "": the first one; of integrators with reservoirs only
  std::string backend = "cpu";
  std::string device;      // of the Vulkan backend, a part of its name; "": the preferred one
  std::string rayTracing;  // "embree", "bvh", "query"; "": the backend's best
  bool validate = false;   // with Vulkan's validation layers
  std::string denoiser = "none";
  uint32_t width = 512, height = 512;
  uint32_t camera = 0;
  uint32_t seed = 1;
  uint32_t maxBounces = 8;
  uint32_t components = rl::RL_COMPONENT_ALL;
  uint32_t pixelFilter = rl::RL_FILTER_BOX;
  bool russianRoulette = false;
  bool multiscatter = false;  // multiple-scattering compensation of rough reflection
  bool specialise = true;     // false: the general kernel
  int threads = 0;            // 0: all cores
  ParameterMap parameters;    // of the method, e.g. confidence_cap
};

struct PassTiming {
  std::string name;
  double timeMs = 0.0;
  uint64_t raysPath = 0, raysShadow = 0;
};

struct Health {
  std::array<uint64_t, rl::RL_HEALTH_COUNT> counts{};
  static const std::array<const char*, rl::RL_HEALTH_COUNT>& names();
};

struct FrameStats {
  double timeMs = 0.0;  // sum of the passes, a filter on the host among them; no metrics, no I/O
  std::vector<PassTiming> passes;
  uint64_t raysPath = 0, raysShadow = 0;
  Health health;  // of this frame
};

class Session {
 public:
  // Throws Error on unknown names or parameters, and before anything is allocated where there is
  // not enough memory for the buffers and `hostBytesPerPixel` that the caller will hold beside
  // them. The compiled scene is shared between sessions.
  Session(std::shared_ptr<const CompiledScene> scene, const SessionConfig& config,
          size_t hostBytesPerPixel = 0);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Renders the next frame of the history.
  FrameStats frame();
  // Renders the next frames, whose images nobody asks for: a device need not wait between them, but
  // for a denoiser that runs on the host.
  std::vector<FrameStats> frames(uint32_t count);
  // Drops the history and starts again with another seed (an independent run). The next frame has
  // the number `firstFrame`: a method without a history then renders what it would have rendered
  // after that many frames. Throws badUsage where a method with a history is to start anywhere
  // but at 0.
  void reset(uint32_t seed, uint32_t firstFrame = 0);
  // Changes parameters of the method, from the next frame on; what is not named keeps its value.
  // The next frame then counts as one of a new view. True where the history starts anew, as buffers
  // have another size or a parameter begins one (ParameterInfo::beginsHistory). Throws Error as the
  // constructor does; parameters stay as they were then.
  bool setParameters(const ParameterMap& parameters);
  // Another size of the image, with the camera of the configuration; the history starts anew.
  // Throws Error as the constructor does; the size stays as it was then.
  void resize(uint32_t width, uint32_t height);
  // The same scene with other light (core/scene/light_factor.h), from the next frame on. The
  // history goes on and knows nothing of it: it holds the light that was. Throws badUsage where the
  // scenes differ in more, and nothing changes then.
  void setScene(std::shared_ptr<const CompiledScene> scene);
  // What the method keeps of a pixel after the last frame, by name: its layers (Method::layers()),
  // its reservoir and path.
  std::vector<ProbeValue> probe(uint32_t x, uint32_t y) const;
  // Where its reservoir took candidates from in the last frame. Throws Error (badUsage) where there
  // is no such pixel; empty before the first frame.
  std::vector<Donor> donors(uint32_t x, uint32_t y) const;
  // For a moving camera, from the next frame on; the previous one is kept for reprojection.
  void setCamera(const SceneCamera& camera);

  // Of the last frame; read from the device when it is first asked for.
  const Image& radiance() const;
  // How many frames of a still view a shown pixel averages, once its history is old: 1 where every
  // frame stands alone.
  double averagedFrames() const;
  // Of the film samples of the last frame, traced once when the first is asked for; one of
  // aovNames(): radiance; at the first hit positionW, normalW (unit, shading, on the viewer's
  // side), albedo (diffuse + specular at normal incidence + transmission), depth (distance along
  // the ray, in every channel), object (1 + the index in Scene::instances, in every channel),
  // emission (radiance towards the camera), motion (to where the last frame's film showed it, in
  // pixels to the right and down, and its distance from that camera); zero where nothing is hit,
  // but for the environment's emission and motion. Or a layer of the method (Method::layers()), its
  // numbers in every channel. Throws Error (badUsage) with the nearest name, and where the history
  // has no frame yet.
  Image aov(const std::string& name) const;
  static const std::vector<std::string>& aovNames();  // of every method

  uint32_t featuresNeeded() const;
  uint32_t featuresUsed() const;  // of the smallest compiled superset
  size_t bytesPerPixel() const;   // of all buffers
  size_t bytesPerPixelOf(uint32_t width, uint32_t height) const;  // of an image of another size
  const SessionConfig& config() const;
  const StartupReport& startup() const;  // what was compiled, and how long it took
  std::string rayTracing() const;        // the one in use
  std::string device() const;            // what kernels run on
  std::vector<std::pair<std::string, size_t>> bufferBytesPerPixel() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Names for reports: "textures+alpha", "none".
std::string featureNames(uint32_t mask);

}  // namespace restlab
