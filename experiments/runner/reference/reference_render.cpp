// Renders references: samples alternate between two halves, starting from stored progress.
#include <fmt/format.h>

#include <algorithm>

#include "core/backend/stop.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/reference/reference_halves.h"
#include "experiments/runner/reference/reference_stop.h"
#include "experiments/runner/suite/backend_choice.h"

namespace restlab {

namespace {

void renderUntil(ReferenceHalves& halves, ReferenceState& state, const ReferenceTarget& target,
                 const ReferenceStop& stop, ReferenceProgress& kept) {
  Progress progress("reference", target.spp, state.spp());
  while (!stop.isReached(state)) {
    if (interruptRequested()) {
      progress.finish();
      throw Error(ExitCode::interrupted,
                  kept.save(state)
                      ? fmt::format("interrupted: the reference is not finished; its {} spp are "
                                    "kept, and the same command continues with them",
                                    state.spp())
                      : "interrupted: the reference is not finished, was not written, and its "
                        "samples are not kept");
    }
    try {
      halves.addSample();
    } catch (const FrameStopped&) {
      continue;  // with the samples before this one
    }
    kept.update(state);
    progress.update(state.spp(), stop.note(state));
  }
  progress.finish();
}

void describeLights(const PreparedScene& prepared, const ReferenceConfig& config,
                    const ReferenceState& state, std::map<std::string, std::string>& metadata) {
  const std::vector<DrawnLight> lights = sampledLights(prepared, config);
  if (lights.empty()) return;
  const double rays = double(state.health.raysPath);
  const RareLights rare = rareLights(lights, rays, double(state.spp()));
  metadata["fewest_light_draws"] = fmt::format("{:.6g}", rare.fewestDraws);
  metadata["light_draws_need_spp"] = fmt::format("{:.6g}", rare.sppNeeded);
  const std::string text = rareLightsText(rare, lights.size(), rays);
  if (!text.empty()) metadata["rare_lights"] = text;
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, " + "));
}

}  // namespace

std::map<std::string, std::string> pictureWords(const PreparedScene& prepared,
                                                const ReferenceConfig& config) {
  std::map<std::string, std::string> words = describe(prepared, referenceSession(prepared, config));
  if (const SceneCamera* camera = cameraInsteadOf(prepared, config)) describeCamera(*camera, words);
  words["reference_sources"] = referenceSources(config.integrator);
  return words;
}

Reference referenceOf(const PreparedScene& prepared, const ReferenceConfig& config,
                      const ReferenceState& state) {
  Reference reference;
  reference.mean = BlockSum::meanOfBoth(state.half0, state.half1);
  reference.half0 = state.half0.mean();
  reference.half1 = state.half1.mean();
  reference.variance = BlockSum::varianceOfMean(state.half0, state.half1, state.squares);
  reference.spp = state.spp();
  reference.relmse = estimateRelmse(state.half0, state.half1);
  reference.relmseSinceHalf = state.checks.sinceHalf();
  reference.timeS = state.timeS;
  reference.metadata = pictureWords(prepared, config);
  reference.metadata.merge(provenanceWords());  // of the program that rendered the last samples
  reference.metadata["device"] = joined(state.devices);
  reference.metadata["ray_tracing"] = joined(state.rayTracing);
  reference.metadata["kind"] = "reference";
  reference.metadata["reference_key"] = state.id.key;
  reference.metadata["seed"] = std::to_string(state.id.seed);
  reference.metadata["spp"] = std::to_string(reference.spp);
  reference.metadata["relmse_estimate"] = fmt::format("{:.9g}", reference.relmse);
  reference.metadata["relmse_since_half"] = fmt::format("{:.17g}", reference.relmseSinceHalf);
  reference.metadata["render_time_s"] = fmt::format("{:.6g}", state.timeS);
  reference.metadata["health"] = state.health.text();
  describeLights(prepared, config, state, reference.metadata);
  return reference;
}

Reference renderReference(const PreparedScene& prepared, const ReferenceConfig& config,
                          const ReferenceTarget& target, const ReferenceStore& store,
                          const std::string& unused) {
  if (target.spp == 0 && !(target.relmse > 0.0) && !(target.timeLimitS > 0.0)) {
    failUsage("a reference needs a target: spp, target-relmse or time-limit");
  }
  if (target.spp == 1) failUsage("a reference needs at least 2 spp: one for each of its halves");
  const size_t bytesPerPixel = referenceBytesPerPixel(target);
  requireMemory(config.integrator, config.width, config.height, bytesPerPixel);
  const ReferenceId id{referenceKey(prepared, config), config.seed, config.backend};
  ReferenceProgress kept(store, id);
  std::optional<ReferenceState> found = kept.load();
  ReferenceState state;
  state.id = id;
  if (found) state = std::move(*found);

  const ReferenceStop stop(prepared, config, target);
  const bool isFinished = stop.isReached(state);
  if (found) {
    logInfo(fmt::format("{}: {} {} spp of {}", unused.empty() ? "reference" : unused,
                        isFinished ? "made of the" : "continues after the", state.spp(),
                        kept.file().string()));
  } else if (!unused.empty()) {
    logInfo(unused + "; rendered anew");
  }
  if (!isFinished) {
    const size_t there = 2 * sizeof(glm::vec3) + state.bytesPerPixel();
    ReferenceHalves halves(prepared, config, state, bytesPerPixel - there);
    try {
      renderUntil(halves, state, target, stop, kept);
    } catch (...) {
      kept.save(state);  // keep the samples before e.g. a lost device
      throw;
    }
    kept.save(state);
  }
  return referenceOf(prepared, config, state);
}

}  // namespace restlab
