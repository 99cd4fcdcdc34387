// Converged references: made by `path` with Russian roulette off, in two independent halves, so
// that their own error is known; kept under a key of everything they depend on, and extended where
// they have too few samples.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/image/image.h"
#include "experiments/runner/run/prepare.h"
#include "experiments/runner/reference/reference_progress.h"

namespace restlab {

// What a reference depends on besides the scene.
struct ReferenceConfig {
  uint32_t width = 0, height = 0;
  // Instead of the scene's camera: one of a camera path, say.
  std::optional<SceneCamera> camera;
  uint32_t maxBounces = 8;
  uint32_t components = rl::RL_COMPONENT_ALL;
  uint32_t pixelFilter = rl::RL_FILTER_BOX;
  bool multiscatter = false;
  uint32_t seed = 1;  // not part of the key
  int threads = 0;
  // What renders it; not part of the key either.
  std::string backend = "cpu", device, rayTracing;
  bool validate = false;
};

// What `session` asks of a reference: the same picture on the same device, without its
// method.
ReferenceConfig referenceConfigOf(const SessionConfig& session);

// The camera of `config` where its view is not exactly that of the scene's camera; else nothing.
const SceneCamera* cameraInsteadOf(const PreparedScene& prepared, const ReferenceConfig& config);

// When to stop: at the first target that is reached; 0 is no target. One must be set. What was
// rendered in earlier calls counts. `relmse` is reached when all estimates since half of the
// samples are at most that, and every light was drawn often enough (light_draws.h).
struct ReferenceTarget {
  uint64_t spp = 0;         // samples per pixel of both halves together, at least 2
  double relmse = 0.0;      // mean d^2/(r^2+1e-2) of the mean, estimated from the halves
  double timeLimitS = 0.0;  // seconds of rendering
};

// An error that is small enough waits for lights that were drawn too seldom, until `spp` or
// `timeLimitS`. Where neither is set it waits for no more than so many times the samples that it
// took itself: what needs more stops, and is not called converged.
constexpr double kMostForLights = 4.0;

// `relmseSinceHalf` as RelmseChecks has it; NaN where it is not known. `sppForLights`: samples per
// pixel with which every light is drawn often enough (light_draws.h); 0 where that is not known.
bool targetReached(const ReferenceTarget& target, uint64_t spp, double relmseSinceHalf,
                   double timeS, double sppForLights);

struct Reference {
  Image mean;
  std::optional<Image> half0, half1;  // absent in files made by other programs
  std::optional<Image> variance;      // of the mean, per pixel
  std::map<std::string, std::string> metadata;
  uint64_t spp = 0;
  double relmse = 0.0;           // estimate; NaN where unknown
  double relmseSinceHalf = 0.0;  // the largest of its checks; NaN where unknown
  double timeS = 0.0;            // rendering only
};

// Why its error may lack the share of some lights, which both halves may have missed: the lights
// and how often they were drawn (light_draws.h); "" where each was drawn often enough, or nobody
// knows.
std::string whyNotConverged(const Reference& reference);

// Layers of the file that writeReference makes: the mean, its variance, two halves.
constexpr uint32_t kReferenceLayers = 4;

// What renderReference holds, roughly: two sessions of `path`, each a buffer and an image; the
// sums; the layers and their copies.
constexpr size_t kReferenceBytesPerPixel =
    4 * sizeof(glm::vec3) + kStateBytesPerPixel + 2 * kReferenceLayers * sizeof(glm::vec3);

// The key: scene and environment bytes, camera (the number of the scene's, all numbers of another
// one), size, bounces, components, filter, multiscatter and the sources of core/ and
// integrators/path.
std::string referenceKey(const PreparedScene& prepared, const ReferenceConfig& config);

// Renders until the target is reached, from the progress that `store` has of this key, seed and
// backend; the result is bit for bit that of one rendering on the same device. Progress goes to
// stderr and, now and then, to `store`. Throws Error (interrupted) on SIGINT; that and any other
// error costs nothing that was rendered, where the store can be written. `unused`: why a stored
// file does not serve, which is said together with what is done about it.
Reference renderReference(const PreparedScene& prepared, const ReferenceConfig& config,
                          const ReferenceTarget& target, const ReferenceStore& store = {},
                          const std::string& unused = "");

struct ReferenceState;
// What a state holds so far, with its metadata. Both halves have a sample.
Reference referenceOf(const PreparedScene& prepared, const ReferenceConfig& config,
                      const ReferenceState& state);

// EXR with layers "" (mean), "variance", "half0", "half1" and the metadata.
void writeReference(const std::filesystem::path& file, const Reference& reference);
Reference readReference(const std::filesystem::path& file);

// What a file of references holds.
struct StoredReference {
  std::optional<Reference> reference;  // of the wanted key, whole, with halves
  std::string unused;                  // a line that says why there is none; "": there is no file
};
StoredReference readStored(const std::filesystem::path& file, const std::string& key);

// True when `reference` is at least as good as the target asks.
bool meetsTarget(const Reference& reference, const ReferenceTarget& target);

// Throws Error (badInput) where a reference given as a file holds values that are not finite, or is
// an image of restlab's that no reference is.
void requireUsable(const std::string& file, const Reference& reference);

// Throws Error (badInput) naming the first item in which a reference given as a file disagrees with
// what is asked; a file without restlab's metadata passes with a warning.
void requireSameConfiguration(const std::string& file,
                              const std::map<std::string, std::string>& reference,
                              const std::map<std::string, std::string>& wanted);

// The reference for a row of `run`: from `folder` or the user's cache where the key agrees and the
// samples are enough, else continued or rendered, and stored in both. A stored one may be of
// another seed, with which it is continued, or backend. `label` names the file inside `folder`.
Reference obtainReference(const PreparedScene& prepared, const ReferenceConfig& config,
                          const ReferenceTarget& target, const std::filesystem::path& folder,
                          const std::string& label);

}  // namespace restlab
