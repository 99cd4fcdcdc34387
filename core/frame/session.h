// Session: scene + integrator + cache + denoiser + backend -> frames. The experiment runner, the
// renderer, the viewer and the tests all use it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/backend/kernel_choice.h"
#include "core/frame/drawn_lights.h"
#include "core/frame/feature_names.h"
#include "core/frame/integrator.h"
#include "core/frame/transport_settings.h"
#include "core/image/image.h"
#include "core/scene/scene.h"

namespace restlab {

class FrameGraph;      // core/frame/frame_graph.h
class CompiledScene;   // core/scene/compiled/compiled_scene.h
struct StartupReport;  // core/backend/backend.h

struct SessionConfig : TransportSettings {
  std::string integrator = "path";
  std::string mode;   // "": the integrator's first
  std::string cache;  // "": the first one; only for integrators with reservoirs
  std::string backend = "cpu";
  std::string device;      // part of a Vulkan device's name; "": the preferred one
  std::string rayTracing;  // "embree", "bvh", "query"; "": the backend's best
  bool validate = false;   // use Vulkan's validation layers
  std::string denoiser = "none";
  uint32_t width = 512, height = 512;
  uint32_t camera = 0;
  uint32_t seed = 1;
  uint32_t components = rl::RL_COMPONENT_ALL;
  KernelChoice kernels = defaultKernelChoice();  // on the CPU
  // false: the session tells what it would use, compiles nothing and renders no frame.
  bool renders = true;
  int threads = 0;          // 0: all cores
  ParameterMap parameters;  // method parameters, such as confidence_cap
};

struct PassTiming {
  std::string name;
  double timeMs = 0.0;
  uint64_t raysPath = 0, raysShadow = 0;
  bool isOnce = false;  // work for the scene, not for this frame
};

struct Health {
  std::array<uint64_t, rl::RL_HEALTH_COUNT> counts{};
  static const std::array<const char*, rl::RL_HEALTH_COUNT>& names();
  // Say what is counted, and whether it matters.
  static const std::array<const char*, rl::RL_HEALTH_COUNT>& meanings();
};

struct FrameStats {
  // Sum of the passes, including a filter on the host, without work for the scene; no metrics, no
  // I/O.
  double timeMs = 0.0;
  double sceneMs = 0.0;  // work for the scene that this frame did: PassTiming::isOnce
  std::vector<PassTiming> passes;
  uint64_t raysPath = 0, raysShadow = 0;
  Health health;  // counted in this frame
};

class Session {
 public:
  // Throws Error on unknown names or parameters, and before any allocation if memory does not
  // suffice for the buffers and the `hostBytesPerPixel` that the caller will hold beside them.
  // Sessions may share the compiled scene.
  Session(std::shared_ptr<const CompiledScene> scene, const SessionConfig& config,
          size_t hostBytesPerPixel = 0);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Renders the next frame of the history.
  FrameStats frame();
  // Renders several frames without reading their images: a device need not wait between them,
  // except for a denoiser that runs on the host.
  std::vector<FrameStats> frames(uint32_t count);
  // Renders the next frame, but returns nullopt and undoes it if `isStopped` returns true before
  // its end. Several threads call `isStopped`, often. Copies every buffer before the frame, which
  // doubles their memory; if that does not fit, the frame cannot be stopped. A filter on the host
  // cannot be stopped, either. A signal ends the frame as in frame().
  std::optional<FrameStats> frameUnless(const std::function<bool()>& isStopped);
  // Done fraction of the work of the frame under way, 0 to 1: a rough number, for people.
  // Callable by `isStopped` of frameUnless().
  double frameFraction() const;
  // Undoes the last frame. Requires that frameUnless() has rendered it, that only const members
  // were called since, and that canTakeBack() is true (false if memory did not suffice).
  void takeBack();
  bool canTakeBack() const;
  // Drops the history and starts again with another seed (an independent run). The next frame has
  // the number `firstFrame`: a method without a history then renders what it would have rendered
  // after that many frames. Throws badUsage if a method with a history is to start at another frame
  // than 0.
  void reset(uint32_t seed, uint32_t firstFrame = 0);
  // Changes parameters of the method, from the next frame on; parameters not named keep their
  // value. The next frame then counts as a new view. Returns true if the history starts anew,
  // because buffers change their size or a parameter begins a history
  // (ParameterInfo::beginsHistory). Throws Error as the constructor does; parameters then stay
  // unchanged.
  bool setParameters(const ParameterMap& parameters);
  // Changes the size of the image, with the camera of the configuration; the history starts anew.
  // Throws Error as the constructor does; the size then stays unchanged.
  void resize(uint32_t width, uint32_t height);
  // Sets the same scene with other light (core/scene/compiled/light_factor.h), from the next frame
  // on. The history continues and still holds the old light. Throws badUsage, and changes nothing,
  // if the scenes differ in more than light.
  void setScene(std::shared_ptr<const CompiledScene> scene);
  // Values that the method keeps for a pixel after the last frame, by name: its layers
  // (Method::layers()), its reservoir and path.
  std::vector<ProbeValue> probe(uint32_t x, uint32_t y) const;
  // Donors of the candidates of the pixel's reservoir in the last frame. Throws Error (badUsage) if
  // there is no such pixel; empty before the first frame.
  std::vector<Donor> donors(uint32_t x, uint32_t y) const;
  // Path of the sample that the pixel's reservoir holds after the last frame, from x1 to the vertex
  // that reconnects: what lies behind that is kept as its radiance alone. Throws as
  // donors() does; empty if there is none.
  std::vector<PathVertex> path(uint32_t x, uint32_t y) const;
  // How far an iterated solution was from the next one, by iteration, over the light of the
  // sources; empty if the method has none, and before the first frame.
  std::vector<double> residuals() const;
  // Sets the camera from the next frame on; the previous one is kept for reprojection.
  void setCamera(const SceneCamera& camera);

  // Image of the last frame; read from the device at the first call.
  const Image& radiance() const;
  // The same image, which stays as it is while anyone holds it: later frames are read into another
  // one.
  std::shared_ptr<const Image> sharedRadiance() const;
  // Number of frames of a still view that a shown pixel averages once its history is old: 1 if
  // every frame stands alone.
  double averagedFrames() const;
  // Image of the last frame's film samples, traced once at the first call; one of aovNames():
  // radiance; at the first hit positionW, normalW (unit, shading, on the viewer's side), albedo
  // (diffuse + specular at normal incidence + transmission), depth (distance along the ray, in
  // every channel), object (1 + the index in Scene::instances, in every channel), emission
  // (radiance towards the camera), motion (to its place on the last frame's film, in pixels to the
  // right and down, and its distance from that camera), ambient (the part of the radiance that is
  // ambient light); zero where nothing is hit, except for the environment's emission and motion. Or
  // a layer of the method (Method::layers()), its numbers in every channel. Throws Error (badUsage)
  // with the nearest name, and if the history has no frame yet.
  Image aov(const std::string& name) const;
  static const std::vector<std::string>& aovNames();  // without the layers of a method

  // Light of the scene that the method does not look for, in words (IntegratorInfo::leavesOut).
  std::string lightLeftOut() const;
  // Lights that light samples were drawn from, since the session was opened or resized.
  DrawnLights drawnLights() const;
  rl::FeatureMask featuresNeeded() const;
  rl::FeatureMask featuresUsed() const;  // by the kernels
  // Machine code of the kernels that were compiled for the scene; 0 where all are built in.
  size_t codeBytes() const;
  size_t bytesPerPixel() const;                                   // sum over all buffers
  size_t bytesPerPixelOf(uint32_t width, uint32_t height) const;  // for an image of another size
  const SessionConfig& config() const;
  const StartupReport& startup() const;  // compiled kernels and compile times
  std::string rayTracing() const;        // the one in use
  std::string device() const;            // device that kernels run on
  std::vector<std::pair<std::string, size_t>> bufferBytesPerPixel() const;
  // Buffers and passes of the last frame; before the first one, those of a new view.
  const FrameGraph& graph() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace restlab
