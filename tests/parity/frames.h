// Whole frames of sessions on two machines, compared pixel by pixel, with the cause of each
// difference.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "core/frame/session.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab::parity {

// An integrator in a mode on a cache (none for integrators without reservoirs), or `path` with a
// denoiser.
struct Combination {
  std::string integrator, mode, cache, denoiser = "none";
  bool endsPaths = false;  // in cells of the radiance cache
  std::string name() const;
  bool hasFilter() const;  // a denoiser that uses features
};
void PrintTo(const Combination& what, std::ostream* out);
std::vector<Combination> combinations();
// Combinations whose kernels trace rays differently; of denoisers, which trace nothing, only one
// with features.
std::vector<Combination> combinationsThatTrace();
// Combinations that each change is tested with; between them they run every kernel.
std::vector<Combination> byDay(std::vector<Combination> all);
// Whether a combination is one of the few that run every pass between them, for checks that look at
// passes and not at methods.
bool isOfEveryPass(const Combination& what);

// Backend and tracer that a session uses.
struct Machine {
  const char* name;
  const char* backend;
  const char* rayTracing;
  KernelChoice kernels;
};
constexpr Machine kVulkan{"vulkan", "vulkan", "bvh", KernelChoice::general};
constexpr Machine kVulkanSpecialised{"vulkan specialised", "vulkan", "bvh", KernelChoice::exact};
constexpr Machine kCpuBvh{"cpu bvh", "cpu", "bvh", KernelChoice::general};
constexpr Machine kCpuEmbree{"cpu embree", "cpu", "embree", KernelChoice::general};

SessionConfig configOf(const Combination& what, const Machine& where, uint32_t width,
                       uint32_t height, uint32_t seed);

// A pixel differs if the difference exceeds 1e-3 of (its length + the image's mean length):
// rounding stays below, another decision lies above.
constexpr double kSameWithin = 1e-3;

struct FrameDifference {
  size_t pixels = 0;
  size_t different = 0;  // sum of the next four
  size_t edges = 0;      // other first hit, by a ray within 1e-4 of a triangle's edge
  size_t ties = 0;       // other first hit, at the same distance
  size_t later = 0;      // same first hit: a later decision differs
  size_t unexplained = 0;
  // Part of `different` caused by the other intersector alone (excuse()).
  size_t excused = 0;
  std::string firstUnexplained;
  // Number of pixels that differ by more than 1e-4, 1e-2 and 1e-1.
  size_t beyond1em4 = 0, beyond1em2 = 0, beyond1em1 = 0;

  double share() const { return double(different) / double(pixels); }
  size_t counted() const { return different - excused; }
  void add(const FrameDifference& other);
  std::string text() const;
};

// Counts the pixels that differ, without a cause.
FrameDifference countDifferent(const Image& a, const Image& b);
// Counts as excused the pixels in which b differs both from a and from `other`, the image that b's
// machine makes with a's intersector. Between round columns a rounding error nearly doubles with
// every bounce: two intersectors diverge even on one machine.
void excuse(FrameDifference& difference, const Image& a, const Image& b, const Image& other);
// Classifies the differences between the first frames of two sessions over one scene.
FrameDifference classify(const std::shared_ptr<const CompiledScene>& scene, Session& a, Session& b);

// Returns the built-in scene, or "everything" (everything_scene.h), or one of gateNames(); compiled
// once per process.
std::shared_ptr<const CompiledScene> sceneNamed(const std::string& name);

// Camera that stands still in the first two frames and then moves to its right and ahead.
SceneCamera cameraOf(const CompiledScene& scene, uint32_t frame);
std::vector<std::string> sceneNames();
// Names of scenes with other renderers' images, outside the project: "gates/...".
std::vector<std::string> gateNames();
// False if the file of a gate scene is missing (RESTLAB_SCENES names the collection).
bool isAtHand(const std::string& scene);

// Kernels that read through texels and uniform blocks (fastest for a software driver) and kernels
// that read by addresses (every other device) must give equal bits.
void expectSameBitsByBothReads(const Combination& what, const std::string& scene,
                               const Machine& where);

// Returns whether a device can be used. If not, tests are skipped with kNoDevice.
bool hasVulkan();

}  // namespace restlab::parity
