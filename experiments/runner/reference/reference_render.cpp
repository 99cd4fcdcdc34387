// Rendering of references: samples go by turns to two halves, from wherever stored progress ended.
#include <fmt/format.h>

#include <xxhash.h>

#include <algorithm>
#include <chrono>

#include "core/backend/stop.h"
#include "core/error.h"
#include "core/memory.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/run/build_info.h"
#include "experiments/runner/run/interrupt.h"
#include "experiments/runner/run/log.h"
#include "experiments/runner/reference/reference.h"

namespace restlab {

namespace {

// The seeds of the halves are far from those that methods are run with.
uint32_t halfSeed(uint32_t seed, uint32_t half) {
  const uint32_t words[3] = {seed, half, 0x72656665u};
  return uint32_t(XXH3_64bits(words, sizeof(words)));
}

SessionConfig pathConfig(const PreparedScene& prepared, const ReferenceConfig& config) {
  SessionConfig session;
  session.integrator = "path";
  session.mode = findIntegrator("path").modes.front().name;
  session.width = config.width;
  session.height = config.height;
  session.camera = prepared.camera;
  session.maxBounces = config.maxBounces;
  session.components = config.components;
  session.pixelFilter = config.pixelFilter;
  session.multiscatter = config.multiscatter;
  session.russianRoulette = false;
  session.threads = config.threads;
  session.backend = config.backend;
  session.device = config.device;
  session.rayTracing = config.rayTracing;
  session.validate = config.validate;
  return session;
}

// relmse_e1e-2 of the mean of both halves against the truth: their difference has the variance
// s^2 (1/n0 + 1/n1), the mean s^2 / (n0 + n1).
double estimateRelmse(const ImageSum& a, const ImageSum& b) {
  const Image half0 = a.mean(), half1 = b.mean(), mean = ImageSum::meanOfBoth(a, b);
  const double n0 = double(a.count()), n1 = double(b.count());
  const double factor = n0 * n1 / ((n0 + n1) * (n0 + n1));
  double sum = 0.0;
  for (size_t i = 0; i < mean.pixels.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(half0.pixels[i]) - glm::dvec3(half1.pixels[i]);
    const glm::dvec3 r(mean.pixels[i]);
    const glm::dvec3 relative = factor * d * d / (r * r + 1e-2);
    sum += relative.x + relative.y + relative.z;
  }
  return sum / (3.0 * double(mean.pixels.size()));
}

void addName(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

// One session a half. Each starts at the frame after those that its half has.
class Halves {
 public:
  Halves(const PreparedScene& prepared, const ReferenceConfig& config, ReferenceState& state,
         size_t hostBytesPerPixel)
      : first_(prepared.scene, withSeed(prepared, config, state.id.seed, 0), hostBytesPerPixel),
        second_(prepared.scene, withSeed(prepared, config, state.id.seed, 1)),
        state_(state) {
    logStartup(first_);
    if (const SceneCamera* camera = cameraInsteadOf(prepared, config)) {
      first_.setCamera(*camera);
      second_.setCamera(*camera);
    }
    start(first_, state.half0);
    start(second_, state.half1);
    addName(state.devices, first_.device());
    addName(state.rayTracing, first_.rayTracing());
  }

  void addSample() {
    const bool isFirst = state_.half0.count() == state_.half1.count();
    Session& half = isFirst ? first_ : second_;
    const FrameStats stats = half.frame();
    const Image& frame = half.radiance();
    // From here on nothing fails: a state that is kept holds whole samples.
    (isFirst ? state_.half0 : state_.half1).add(frame);
    state_.squares.addSquares(frame);
    state_.health.add(stats);
  }

 private:
  static SessionConfig withSeed(const PreparedScene& prepared, const ReferenceConfig& config,
                                uint32_t seed, uint32_t half) {
    SessionConfig session = pathConfig(prepared, config);
    session.seed = halfSeed(seed, half);
    return session;
  }
  static void start(Session& session, const ImageSum& half) {
    if (half.count() > 0) session.reset(session.config().seed, uint32_t(half.count()));
  }

  Session first_, second_;
  ReferenceState& state_;
};

void renderUntil(Halves& halves, ReferenceState& state, const ReferenceTarget& target,
                 ReferenceProgress& kept) {
  Progress progress("reference", target.spp, state.spp());
  const double earlierS = state.timeS;
  const auto start = std::chrono::steady_clock::now();
  while (!targetReached(target, state.spp(), state.checks.sinceHalf(), state.timeS)) {
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
      continue;  // with what there was before this sample
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    state.timeS = earlierS + spent.count();
    if (RelmseChecks::isDue(state.spp()))
      state.checks.add(estimateRelmse(state.half0, state.half1));
    kept.update(state);
    const std::vector<double>& checks = state.checks.kept();
    progress.update(state.spp(), checks.empty() ? "" : fmt::format("relmse {:.3g}", checks.back()));
  }
  progress.finish();
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, " + "));
}

Reference referenceOf(const PreparedScene& prepared, const ReferenceConfig& config,
                      const ReferenceState& state) {
  Reference reference;
  reference.mean = ImageSum::meanOfBoth(state.half0, state.half1);
  reference.half0 = state.half0.mean();
  reference.half1 = state.half1.mean();
  reference.variance = ImageSum::varianceOfMean(state.half0, state.half1, state.squares);
  reference.spp = state.spp();
  reference.relmse = estimateRelmse(state.half0, state.half1);
  reference.relmseSinceHalf = state.checks.sinceHalf();
  reference.timeS = state.timeS;
  reference.metadata = describe(prepared, pathConfig(prepared, config));
  if (const SceneCamera* camera = cameraInsteadOf(prepared, config)) {
    describeCamera(*camera, reference.metadata);
  }
  reference.metadata.merge(provenanceWords());  // of the program that rendered the last of it
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
  return reference;
}

}  // namespace

Reference renderReference(const PreparedScene& prepared, const ReferenceConfig& config,
                          const ReferenceTarget& target, const ReferenceStore& store,
                          const std::string& unused) {
  if (target.spp == 0 && !(target.relmse > 0.0) && !(target.timeLimitS > 0.0)) {
    failUsage("a reference needs a target: spp, target-relmse or time-limit");
  }
  if (target.spp == 1) failUsage("a reference needs at least 2 spp: one for each of its halves");
  requireMemory("path", config.width, config.height, kReferenceBytesPerPixel);
  const ReferenceId id{referenceKey(prepared, config), config.seed, config.backend};
  ReferenceProgress kept(store, id);
  std::optional<ReferenceState> found = kept.load();
  ReferenceState state;
  state.id = id;
  if (found) state = std::move(*found);

  const bool isEnough = targetReached(target, state.spp(), state.checks.sinceHalf(), state.timeS);
  if (found) {
    logInfo(fmt::format("{}: {} {} spp of {}", unused.empty() ? "reference" : unused,
                        isEnough ? "made of the" : "continues after the", state.spp(),
                        kept.file().string()));
  } else if (!unused.empty()) {
    logInfo(unused + "; rendered anew");
  }
  if (!isEnough) {
    const size_t there = 2 * sizeof(glm::vec3) + (state.spp() > 0 ? kStateBytesPerPixel : 0);
    Halves halves(prepared, config, state, kReferenceBytesPerPixel - there);
    try {
      renderUntil(halves, state, target, kept);
    } catch (...) {
      kept.save(state);  // a lost device, say: what came before it is kept
      throw;
    }
    kept.save(state);
  }
  return referenceOf(prepared, config, state);
}

}  // namespace restlab
