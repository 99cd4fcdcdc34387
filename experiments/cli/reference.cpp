// restlab reference: renders a converged image in two independent halves, whole or in chunks.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/image/io/exr_limits.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/reference/reference_chunk.h"

namespace restlab {

namespace {

struct ReferenceOptions {
  SceneOptions scene;
  std::string output, integrator = "path";
  BackendChoice backend;
  ReferenceTarget target;
  double checkpointS = ReferenceStore().intervalS;
  bool anew = false;
  std::string samples;             // FIRST:COUNT of a chunk; "": a whole reference
  std::vector<std::string> merge;  // chunks; none: renders
  bool isChunk() const { return !samples.empty(); }
};

// Parses FIRST:COUNT. Throws badUsage.
ChunkRange parseSamples(const std::string& text) {
  ChunkRange range;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.firstSpp);
  const bool hasColon = first.ec == std::errc() && first.ptr != end && *first.ptr == ':';
  const auto count = std::from_chars(hasColon ? first.ptr + 1 : end, end, range.spp);
  if (!hasColon || count.ec != std::errc() || count.ptr != end) {
    failUsage(fmt::format("--samples {}: is not FIRST:COUNT, two whole numbers such as {}:{}", text,
                          4 * kBlockSpp, 2 * kBlockSpp));
  }
  const std::string why = whyNoRange(range);
  if (!why.empty()) failUsage(fmt::format("--samples {}: {}", text, why));
  return range;
}

// Returns the reference in `file` if it is of the same samples and good enough; else sets `unused`
// to the reason.
std::optional<Reference> sameReference(const std::string& file, const ReferenceId& id,
                                       const ReferenceTarget& target, std::string& unused) {
  StoredReference stored = readStored(file, id.key);
  unused = stored.unused;
  if (!stored.reference) return std::nullopt;
  for (const auto& [item, wanted] :
       {std::pair("seed", std::to_string(id.seed)), std::pair("backend", id.backend)}) {
    const std::string its = stored.reference->metadata[item];
    if (its == wanted) continue;
    unused = fmt::format("{}: is of {} {}, not {}", file, item, its, wanted);
    return std::nullopt;
  }
  if (meetsTarget(*stored.reference, target)) return std::move(stored.reference);
  unused = fmt::format("{}: has {} spp, less than wanted", file, stored.reference->spp);
  return std::nullopt;
}

// Returns the reference at --output, rendered or extended if necessary.
Reference updatedReference(const PreparedScene& prepared, const ReferenceConfig& config,
                           const ReferenceOptions& options) {
  ReferenceStore store;
  std::string unused;
  if (!options.anew) {
    const ReferenceId id{referenceKey(prepared, config), config.seed, config.backend};
    std::optional<Reference> same = sameReference(options.output, id, options.target, unused);
    if (same) {
      logInfo(fmt::format("{}: is of this scene and these settings already, and stays as it is",
                          options.output));
      return std::move(*same);
    }
    store.folder = referenceCacheFolder();
    store.intervalS = options.checkpointS;
    if (store.folder.empty()) {
      logWarning(
          "the progress of the reference is not kept: neither XDG_CACHE_HOME nor HOME is set");
    }
  }
  Reference reference = renderReference(prepared, config, options.target, store, unused);
  writeReference(options.output, reference);
  return reference;
}

// Returns the reference of the chunks. Its progress is kept, so that the same command without
// --merge goes on where they end.
Reference mergedReference(const PreparedScene& prepared, const ReferenceConfig& config,
                          const ReferenceOptions& options) {
  const std::vector<std::filesystem::path> files(options.merge.begin(), options.merge.end());
  const ReferenceState state = mergeChunks(prepared, config, {}, files, options.target);
  Reference reference = referenceOf(prepared, config, state);
  writeReference(options.output, reference);
  if (!options.anew) {
    ReferenceStore store;
    store.folder = referenceCacheFolder();
    ReferenceProgress(store, state.id).save(state);
  }
  return reference;
}

// Throws badUsage if options are missing, or exclude each other.
void checkTargets(const ReferenceOptions& options) {
  const ReferenceTarget& target = options.target;
  const bool hasTarget = target.spp > 0 || target.relmse > 0.0 || target.timeLimitS > 0.0;
  if (!hasTarget && !options.isChunk() && options.merge.empty())
    failUsage("reference: needs one of --spp, --target-relmse, --time-limit");
  if (options.isChunk() && hasTarget) {
    failUsage(
        "--samples: says how many there are; --spp, --target-relmse and --time-limit are "
        "for whole references");
  }
}

void makeReference(ReferenceOptions options) {
  resolveResolution(options.scene);
  const std::vector<std::string>& known = referenceIntegrators();
  if (std::find(known.begin(), known.end(), options.integrator) == known.end()) {
    failUsage(fmt::format("--integrator {}: a reference is made by {}, whose error is known",
                          options.integrator, fmt::join(known, " or ")));
  }
  checkTargets(options);
  const ChunkRange range = options.isChunk() ? parseSamples(options.samples) : ChunkRange();
  MethodOptions method;
  method.backend = options.backend;
  SessionConfig session = makeConfig(options.scene, method);
  checkWritable(options.output);
  checkOutputs({{"--output", options.output, options.isChunk() ? kChunkExtension : ".exr"}},
               options.scene.request);

  const PreparedScene prepared = prepareScene(options.scene.request);
  printWarnings(prepared);
  completeConfig(prepared, options.scene, session);
  ReferenceConfig config = referenceConfigOf(session);
  config.integrator = options.integrator;
  if (options.isChunk()) {
    renderChunk(prepared, config, range, options.output);
    return;
  }
  requireExrSize(options.output, session.width, session.height, kReferenceLayers);
  const Reference reference = options.merge.empty() ? updatedReference(prepared, config, options)
                                                    : mergedReference(prepared, config, options);
  if (options.target.relmse > 0.0 && !(reference.relmseSinceHalf <= options.target.relmse)) {
    const bool isBelow = reference.relmse <= options.target.relmse;
    logWarning(fmt::format(
        "{}: relmse {:.3g} is {} the target of {:g}{}: stopped by {}", options.output,
        reference.relmse, isBelow ? "not above" : "above", options.target.relmse,
        isBelow ? ", but has not been so since half of the samples" : "",
        !options.merge.empty()                                          ? "the last chunk"
        : options.target.spp > 0 && reference.spp >= options.target.spp ? "--spp"
                                                                        : "--time-limit"));
  }
  if (const std::string why = whyNotConverged(reference); !why.empty()) {
    if (options.target.relmse > 0.0) {
      const bool isBounded = options.target.spp > 0 || options.target.timeLimitS > 0.0;
      logWarning(fmt::format("{}: is not converged, whatever its halves agree on: {}{}",
                             options.output, why,
                             isBounded ? "" : "; --spp or --time-limit let it go on that far"));
    } else {
      logInfo(fmt::format("{}: {}", options.output, why));
    }
  }
  logInfo(fmt::format("{}: {} spp in {:.1f} s, relmse {:.3g} (estimated from the halves)",
                      options.output, reference.spp, reference.timeS, reference.relmse));
}

}  // namespace

Action addReferenceVerb(CLI::App& app) {
  auto options = std::make_shared<ReferenceOptions>();
  CLI::App* verb =
      app.add_subcommand("reference", "render a converged reference with its own error");
  addSceneOptions(*verb, options->scene);
  addOutput(*verb, options->output);
  verb->add_option("--integrator", options->integrator,
                   "path, or bdpt as a second opinion (default path)");
  addBackendOptions(*verb, options->backend);
  verb->add_option("--spp", options->target.spp, "samples per pixel of both halves together")
      ->transform(wholeNumberFrom(2, uint64_t(1) << 32));
  verb->add_option("--target-relmse", options->target.relmse,
                   "until the mean's estimated relmse_e1e-2 is at most this, and was since half of "
                   "the samples")
      ->transform(numberFrom(1e-12, 1e6));
  verb->add_option("--time-limit", options->target.timeLimitS, "seconds of rendering")
      ->transform(numberFrom(1e-3, 1e9, "seconds"));
  verb->add_option("--checkpoint", options->checkpointS,
                   "seconds between two writes of the progress (default 30)")
      ->transform(numberFrom(0.0, 1e9, "seconds"));
  verb->add_flag("--anew", options->anew,
                 "from the first sample to exactly the target; no progress is read or kept");
  CLI::Option* samples =
      verb->add_option("--samples", options->samples,
                       fmt::format("FIRST:COUNT, a chunk alone: COUNT samples per pixel from FIRST "
                                   "on, counted from 0, FIRST a multiple of {}; output is FILE{}",
                                   kBlockSpp, kChunkExtension))
          ->type_name("RANGE")
          ->excludes("--anew")
          ->excludes("--checkpoint");
  verb->add_option("--merge", options->merge,
                   "makes the reference of chunks, in any order; a target leaves out later ones")
      ->type_name("FILE")
      ->excludes(samples);
  return [options](Outcome&) { makeReference(*options); };
}

}  // namespace restlab
