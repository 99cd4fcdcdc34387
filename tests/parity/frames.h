// Whole frames of sessions on two machines, compared pixel by pixel, and what explains each
// difference.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/compiled_scene.h"
#include "core/session.h"

namespace restlab::parity {

// An integrator in a mode on a cache; integrators without reservoirs have no cache to choose. Or
// `path` with a denoiser.
struct Combination {
  std::string integrator, mode, cache, denoiser = "none";
  bool endsPaths = false;  // in cells of radiance
  std::string name() const;
  bool hasFilter() const;  // a denoiser that asks for guides
};
void PrintTo(const Combination& what, std::ostream* out);
std::vector<Combination> combinations();
// Those whose kernels differ in how they trace: of denoisers, which trace nothing, one with guides.
std::vector<Combination> combinationsThatTrace();

// Where a session runs.
struct Machine {
  const char* name;
  const char* backend;
  const char* rayTracing;
  bool specialise;
};
constexpr Machine kVulkan{"vulkan", "vulkan", "bvh", false};
constexpr Machine kVulkanSpecialised{"vulkan specialised", "vulkan", "bvh", true};
constexpr Machine kCpuBvh{"cpu bvh", "cpu", "bvh", false};
constexpr Machine kCpuEmbree{"cpu embree", "cpu", "embree", false};

SessionConfig configOf(const Combination& what, const Machine& where, uint32_t width,
                       uint32_t height, uint32_t seed);

// A pixel differs when it does by more than 1e-3 of (its length + the image's mean length), which
// rounding does not reach but another decision does.
constexpr double kSameWithin = 1e-3;

struct FrameDifference {
  size_t pixels = 0;
  size_t different = 0;  // all of the next four
  size_t edges = 0;      // another first hit, by a ray within 1e-4 of an edge of a triangle
  size_t ties = 0;       // another first hit, as far away as this one
  size_t later = 0;      // the same first hit: a later decision
  size_t unexplained = 0;
  // Of `different`: those where another intersector alone makes a difference (excuse()).
  size_t excused = 0;
  std::string firstUnexplained;
  // Pixels that differ by more than 1e-4, 1e-2 and 1e-1.
  size_t beyond1em4 = 0, beyond1em2 = 0, beyond1em1 = 0;

  double share() const { return double(different) / double(pixels); }
  size_t counted() const { return different - excused; }
  void add(const FrameDifference& other);
  std::string text() const;
};

// How many pixels differ, without a reason.
FrameDifference countDifferent(const Image& a, const Image& b);
// Of the pixels in which a and b differ, those in which b differs from `other` too: the image that
// b's machine makes with a's intersector. Between round columns a rounding error nearly doubles
// with every bounce, so that two intersectors part without any doing of the machines.
void excuse(FrameDifference& difference, const Image& a, const Image& b, const Image& other);
// Of the first frames of two sessions over one scene.
FrameDifference classify(const std::shared_ptr<const CompiledScene>& scene, Session& a, Session& b);

// The built-in scene, or "everything" (everything_scene.h), or one of gateNames(); compiled once a
// process.
std::shared_ptr<const CompiledScene> sceneNamed(const std::string& name);

// The camera stands in the first two frames and walks from then on, to its right and ahead.
SceneCamera cameraOf(const CompiledScene& scene, uint32_t frame);
std::vector<std::string> sceneNames();
// Scenes with other renderers' images, which are not part of the project: "gates/...".
std::vector<std::string> gateNames();
// False for a gate whose file is not at hand (RESTLAB_SCENES names the collection).
bool isAtHand(const std::string& scene);

// True where some device can be used. A test is skipped otherwise, with kNoDevice.
bool hasVulkan();

}  // namespace restlab::parity
