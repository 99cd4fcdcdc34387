#include "experiments/runner/reference/reference_halves.h"

#include <xxhash.h>

#include <algorithm>
#include <chrono>

#include "core/frame/method.h"
#include "experiments/runner/suite/backend_choice.h"

namespace restlab {

namespace {

// Keeps the seeds of the halves far from the seeds of the methods.
uint32_t halfSeed(uint32_t seed, uint32_t half) {
  const uint32_t words[3] = {seed, half, 0x72656665u};
  return uint32_t(XXH3_64bits(words, sizeof(words)));
}

SessionConfig halfOf(const PreparedScene& prepared, const ReferenceConfig& config, uint32_t seed,
                     uint32_t half) {
  SessionConfig session = referenceSession(prepared, config);
  session.seed = halfSeed(seed, half);
  return session;
}

void startAt(uint64_t frame, Session& session) {
  if (frame > 0) session.reset(session.config().seed, uint32_t(frame));
}

double spentSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void addName(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

}  // namespace

SessionConfig referenceSession(const PreparedScene& prepared, const ReferenceConfig& config) {
  SessionConfig session;
  session.integrator = config.integrator;
  session.mode = findMode(findIntegrator(config.integrator), config.mode);
  session.parameters = config.parameters;
  session.width = config.width;
  session.height = config.height;
  session.camera = prepared.camera;
  static_cast<TransportSettings&>(session) = referenceTransport(config);
  session.components = config.components;
  session.threads = config.threads;
  session.backend = config.backend;
  session.device = config.device;
  session.rayTracing = config.rayTracing;
  session.validate = config.validate;
  return session;
}

double estimateRelmse(const BlockSum& a, const BlockSum& b) {
  // For variance s^2 per sample, the difference of the halves has the variance s^2 (1/n0 + 1/n1),
  // their mean s^2 / (n0 + n1).
  const Image half0 = a.mean(), half1 = b.mean(), mean = BlockSum::meanOfBoth(a, b);
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

void addDueCheck(ReferenceState& state) {
  if (!RelmseChecks::isDue(state.spp())) return;
  state.checks.add({state.spp(), estimateRelmse(state.half0, state.half1), state.health.raysPath});
}

ReferenceHalves::ReferenceHalves(const PreparedScene& prepared, const ReferenceConfig& config,
                                 ReferenceState& state, size_t hostBytesPerPixel, uint64_t firstSpp)
    : first_(prepared.scene, halfOf(prepared, config, state.id.seed, 0), hostBytesPerPixel),
      second_(prepared.scene, halfOf(prepared, config, state.id.seed, 1)),
      state_(state) {
  logStartup(first_);
  if (const SceneCamera* camera = cameraInsteadOf(prepared, config)) {
    first_.setCamera(*camera);
    second_.setCamera(*camera);
  }
  startAt(firstSpp / 2 + state.half0.count(), first_);
  startAt(firstSpp / 2 + state.half1.count(), second_);
  addName(state.devices, first_.device());
  addName(state.rayTracing, first_.rayTracing());
}

bool ReferenceHalves::addSample(const std::function<bool()>& isStopped) {
  if (!addUnchecked(isStopped)) return false;
  const auto start = std::chrono::steady_clock::now();
  addDueCheck(state_);
  state_.timeS += spentSince(start);
  return true;
}

bool ReferenceHalves::addUnchecked(const std::function<bool()>& isStopped) {
  const auto start = std::chrono::steady_clock::now();
  const bool isFirst = state_.half0.count() == state_.half1.count();
  Session& half = isFirst ? first_ : second_;
  const std::optional<FrameStats> stats =
      isStopped ? half.frameUnless(isStopped) : std::optional(half.frame());
  if (!stats) return false;
  const Image& frame = half.radiance();
  // Nothing below throws: a kept state holds whole samples.
  (isFirst ? state_.half0 : state_.half1).add(frame);
  state_.squares.addSquares(frame);
  state_.health.add(*stats);
  state_.timeS += spentSince(start);
  return true;
}

}  // namespace restlab
