#include "experiments/runner/reference.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "experiments/runner/accumulate.h"
#include "experiments/runner/backend_choice.h"
#include "experiments/runner/build_info.h"
#include "experiments/runner/interrupt.h"
#include "experiments/runner/log.h"

namespace restlab {

namespace {

// Below this many samples the two halves say too little about their own error.
constexpr uint64_t kMinSppForError = 16;
// The error is estimated after every so many pairs of samples: it costs about a tenth of a frame.
constexpr uint64_t kPairsPerCheck = 4;

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

bool targetReached(const ReferenceTarget& target, uint64_t spp, double relmse, double timeS) {
  if (target.spp && spp >= target.spp) return true;
  if (target.timeLimitS > 0.0 && timeS >= target.timeLimitS && spp >= 2) return true;
  return target.relmse > 0.0 && spp >= kMinSppForError && relmse <= target.relmse;
}

}  // namespace

ReferenceConfig referenceConfigOf(const SessionConfig& session) {
  ReferenceConfig config;
  config.width = session.width;
  config.height = session.height;
  config.maxBounces = session.maxBounces;
  config.components = session.components;
  config.pixelFilter = session.pixelFilter;
  config.multiscatter = session.multiscatter;
  config.seed = session.seed;
  config.threads = session.threads;
  config.backend = session.backend;
  config.device = session.device;
  config.rayTracing = session.rayTracing;
  config.validate = session.validate;
  return config;
}

std::string referenceKey(const PreparedScene& prepared, const ReferenceConfig& config) {
  const std::string text = fmt::format(
      "reference-2 {} camera {} {}x{} bounces {} {} {} multiscatter {} sources {}",
      hexHash(prepared.contentHash), prepared.camera, config.width, config.height,
      config.maxBounces, componentName(config.components), filterName(config.pixelFilter),
      config.multiscatter ? "on" : "off", buildInfo().referenceHash);
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return hexHash(hash.high64) + hexHash(hash.low64);
}

Reference renderReference(const PreparedScene& prepared, const ReferenceConfig& config,
                          const ReferenceTarget& target) {
  if (target.spp == 0 && !(target.relmse > 0.0) && !(target.timeLimitS > 0.0)) {
    failUsage("a reference needs a target: spp, target-relmse or time-limit");
  }
  if (target.spp == 1) failUsage("a reference needs at least 2 spp: one for each of its halves");
  SessionConfig session = pathConfig(prepared, config);
  session.seed = halfSeed(config.seed, 0);
  Session first(prepared.scene, session, kReferenceBytesPerPixel - 2 * sizeof(glm::vec3));
  session.seed = halfSeed(config.seed, 1);
  Session second(prepared.scene, session);
  logStartup(first);

  ImageSum sum0(true), sum1(true);
  HealthSum health;
  Progress progress("reference", target.spp);
  const auto start = std::chrono::steady_clock::now();
  double relmse = std::numeric_limits<double>::quiet_NaN(), timeS = 0.0;
  while (!targetReached(target, sum0.count() + sum1.count(), relmse, timeS)) {
    throwIfInterrupted("the reference is not finished and was not written");
    const bool isFirst = sum0.count() == sum1.count();
    Session& half = isFirst ? first : second;
    health.add(half.frame());
    (isFirst ? sum0 : sum1).add(half.radiance());
    timeS = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const uint64_t spp = sum0.count() + sum1.count();
    if (spp >= kMinSppForError && spp % (2 * kPairsPerCheck) == 0) {
      relmse = estimateRelmse(sum0, sum1);
    }
    progress.update(spp, std::isnan(relmse) ? "" : fmt::format("relmse {:.3g}", relmse));
  }
  progress.finish();

  Reference reference;
  reference.mean = ImageSum::meanOfBoth(sum0, sum1);
  reference.half0 = sum0.mean();
  reference.half1 = sum1.mean();
  reference.variance = ImageSum::varianceOfMean(sum0, sum1);
  reference.spp = sum0.count() + sum1.count();
  reference.relmse = estimateRelmse(sum0, sum1);
  reference.timeS = timeS;
  reference.metadata = describe(prepared, first.config());
  reference.metadata["device"] = first.device();
  reference.metadata["ray_tracing"] = first.rayTracing();
  reference.metadata["kind"] = "reference";
  reference.metadata["reference_key"] = referenceKey(prepared, config);
  reference.metadata["seed"] = std::to_string(config.seed);
  reference.metadata["spp"] = std::to_string(reference.spp);
  reference.metadata["relmse_estimate"] = fmt::format("{:.9g}", reference.relmse);
  reference.metadata["render_time_s"] = fmt::format("{:.6g}", timeS);
  reference.metadata["health"] = health.text();
  return reference;
}

void writeReference(const std::filesystem::path& file, const Reference& reference) {
  LayeredImage image;
  image.layers[""] = reference.mean;
  if (reference.half0) image.layers["half0"] = *reference.half0;
  if (reference.half1) image.layers["half1"] = *reference.half1;
  if (reference.variance) image.layers["variance"] = *reference.variance;
  image.metadata = reference.metadata;
  writeExr(file, image);
}

namespace {

double metadataNumber(const std::map<std::string, std::string>& metadata, const std::string& key) {
  const auto found = metadata.find(key);
  if (found == metadata.end()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(found->second.c_str(), &end);
  return *end == '\0' && end != found->second.c_str() ? value
                                                      : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Reference readReference(const std::filesystem::path& file) {
  LayeredImage image = readExr(file);
  const auto main = image.layers.find("");
  if (main == image.layers.end()) {
    failInput(fmt::format("{}: has no R, G, B channels outside named layers", file.string()));
  }
  Reference reference;
  reference.mean = std::move(main->second);
  for (const char* name : {"half0", "half1", "variance"}) {
    const auto layer = image.layers.find(name);
    if (layer == image.layers.end()) continue;
    std::optional<Image>& slot = std::string(name) == "half0"   ? reference.half0
                                 : std::string(name) == "half1" ? reference.half1
                                                                : reference.variance;
    slot = std::move(layer->second);
  }
  if (reference.half0.has_value() != reference.half1.has_value()) {
    failInput(
        fmt::format("{}: has one of the layers half0 and half1 but not the other", file.string()));
  }
  reference.metadata = std::move(image.metadata);
  const double spp = metadataNumber(reference.metadata, "spp");
  reference.spp = spp > 0.0 ? uint64_t(spp) : 0;
  reference.relmse = metadataNumber(reference.metadata, "relmse_estimate");
  reference.timeS = metadataNumber(reference.metadata, "render_time_s");
  return reference;
}

bool meetsTarget(const Reference& reference, const ReferenceTarget& target) {
  return targetReached(target, reference.spp, reference.relmse, reference.timeS);
}

void requireSameConfiguration(const std::string& file,
                              const std::map<std::string, std::string>& reference,
                              const std::map<std::string, std::string>& wanted) {
  if (reference.find("scene_hash") == reference.end()) {
    logWarning(fmt::format("{}: says nothing about its scene and settings; taken on trust", file));
    return;
  }
  for (const char* item : {"scene_hash", "camera_index", "width", "height", "max_bounces",
                           "component", "filter", "multiscatter", "reference_sources"}) {
    const auto have = reference.find(item), want = wanted.find(item);
    if (have == reference.end() || want == wanted.end() || have->second == want->second) continue;
    failInput(fmt::format("{}: the reference is of another configuration: {} is {}, not {}", file,
                          item, have->second, want->second));
  }
}

}  // namespace restlab
