// Converged references: rendered by `path`, or by `bdpt` where that is asked for, with Russian
// roulette off, in two independent halves that give an estimate of the error; cached under a key of
// all their inputs, and extended on demand.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/image/image.h"
#include "experiments/runner/reference/reference_progress.h"
#include "experiments/runner/suite/prepare.h"
#include "experiments/runner/suite/reference_target.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Inputs of a reference besides the scene.
struct ReferenceConfig : TransportSettings {
  std::string integrator = "path";  // one of referenceIntegrators(), or that of a suite's method
  std::string mode = {};            // ""; the first one
  ParameterMap parameters = {};     // of a suite's method: resolved
  uint32_t width = 0, height = 0;
  // Replaces the scene's camera, e.g. by one on a camera path.
  std::optional<SceneCamera> camera;
  uint32_t components = rl::RL_COMPONENT_ALL;
  uint32_t seed = 1;  // not part of the key
  int threads = 0;
  // Device that renders; not part of the key.
  std::string backend = "cpu", device, rayTracing;
  bool validate = false;
};

// Returns the reference of what `session` renders: same picture, same device, without the method.
ReferenceConfig referenceConfigOf(const SessionConfig& session);

// Returns the reference of a picture of a suite.
ReferenceConfig referenceOfSuite(const Suite& suite, const SessionConfig& picture);

// Returns the camera of `config` if its view is not exactly that of the scene's camera; else
// nothing.
const SceneCamera* cameraInsteadOf(const PreparedScene& prepared, const ReferenceConfig& config);

// Limit of waiting for rarely drawn lights after the error is small enough. The wait ends at `spp`
// or `timeLimitS`; if neither is set, a rendering that needs more than this many times its samples
// stops, and is not called converged.
constexpr double kMostForLights = 4.0;

// `relmseSinceHalf`: from RelmseChecks; NaN if unknown. `sppForLights`: samples per pixel with
// which every light is drawn often enough (light_draws.h); 0 if unknown.
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

// Returns which lights were drawn too seldom and how often (light_draws.h): both halves may have
// missed their share. "" if every light was drawn often enough, or nothing is known.
std::string whyNotConverged(const Reference& reference);

// Layers of the file that writeReference makes: the mean, its variance, two halves.
constexpr uint32_t kReferenceLayers = 4;

// Approximate memory of renderReference: two sessions of `path`, each a buffer and an image; the
// sums, fewer where no second block begins; the layers and their copies. Buffers of another
// integrator are counted by its sessions.
constexpr size_t referenceBytesPerPixel(const ReferenceTarget& target) {
  const bool isOneBlock = target.spp > 0 && target.spp <= kBlockSpp;
  return 4 * sizeof(glm::vec3) + (isOneBlock ? kBlockBytesPerPixel : kStateBytesPerPixel) +
         2 * kReferenceLayers * sizeof(glm::vec3);
}

// Hash of the sources of core/ and of the integrator that renders a reference.
const std::string& referenceSources(const std::string& integrator);

// Hashes the bytes of scene and environment, camera (the number of the scene's, all numbers of
// another one), size, bounces, components, filter, multiscatter and referenceSources().
std::string referenceKey(const PreparedScene& prepared, const ReferenceConfig& config);

// Renders until the target is reached, from the progress that `store` has of this key, seed and
// backend. The result is bit for bit that of one rendering on the same device. Writes progress to
// stderr and regularly to `store`. Throws Error (interrupted) on SIGINT; no error loses rendered
// samples if the store can be written. `unused`: why a stored file cannot be used, for the log.
Reference renderReference(const PreparedScene& prepared, const ReferenceConfig& config,
                          const ReferenceTarget& target, const ReferenceStore& store = {},
                          const std::string& unused = "");

struct ReferenceState;
// Returns scene, camera, settings and sources, as a reference's metadata name them.
std::map<std::string, std::string> pictureWords(const PreparedScene& prepared,
                                                const ReferenceConfig& config);
// Returns the current result of a state, with its metadata. Both halves must have a sample.
Reference referenceOf(const PreparedScene& prepared, const ReferenceConfig& config,
                      const ReferenceState& state);

// EXR with layers "" (mean), "variance", "half0", "half1" and the metadata.
void writeReference(const std::filesystem::path& file, const Reference& reference);
Reference readReference(const std::filesystem::path& file);

// Result of reading a stored reference.
struct StoredReference {
  std::optional<Reference> reference;  // of the wanted key, complete, with halves
  std::string unused;                  // why the file cannot be used, one line; "": no file
};
StoredReference readStored(const std::filesystem::path& file, const std::string& key);

// Returns whether `reference` is at least as good as the target asks.
bool meetsTarget(const Reference& reference, const ReferenceTarget& target);

// Throws Error (badInput) if a reference given as a file holds values that are not finite, or is a
// restlab image of another kind.
void requireUsable(const std::string& file, const Reference& reference);

// Returns a word of an image's metadata. A camera without words for its shift and mirroring has
// none of them.
std::optional<std::string> pictureWord(const std::map<std::string, std::string>& metadata,
                                       const std::string& key);

// Throws Error (badInput) that names the first item in which a reference given as a file disagrees
// with `wanted`. A file without restlab's metadata passes with a warning.
void requireSameConfiguration(const std::string& file,
                              const std::map<std::string, std::string>& reference,
                              const std::map<std::string, std::string>& wanted);

// Obtains the reference for a row of `run`: from `folder` or the user's cache if the key agrees and
// the samples are enough, else continued or rendered, and stored in both. A stored reference may be
// of another seed, with which it is continued, or of another backend. `label` names the file inside
// `folder`.
Reference obtainReference(const PreparedScene& prepared, const ReferenceConfig& config,
                          const ReferenceTarget& target, const std::filesystem::path& folder,
                          const std::string& label);

}  // namespace restlab
