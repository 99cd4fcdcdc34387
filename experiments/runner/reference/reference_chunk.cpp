#include "experiments/runner/reference/reference_chunk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <system_error>

#include "core/backend/stop.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/reference/reference_chunk_file.h"
#include "experiments/runner/reference/reference_halves.h"
#include "experiments/runner/reference/reference_stop.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

uint64_t wholeBlocks(uint64_t spp) { return (spp + kBlockSpp - 1) / kBlockSpp * kBlockSpp; }

// Renders the next sample, unless a signal has come.
void addSample(ReferenceHalves& halves, Progress& progress, const fs::path& file) {
  while (true) {
    if (interruptRequested()) {
      progress.finish();
      throw Error(ExitCode::interrupted,
                  fmt::format("interrupted: {} is not written, and its samples are not kept",
                              file.string()));
    }
    try {
      halves.addUnchecked();
      return;
    } catch (const FrameStopped&) {
    }
  }
}

}  // namespace

std::string whyNoRange(const ChunkRange& range) {
  if (range.firstSpp % kBlockSpp != 0) {
    return fmt::format("its first sample is {}, not a multiple of {}", range.firstSpp, kBlockSpp);
  }
  if (range.spp == 0) return "it has no samples";
  if (range.firstSpp == 0 && range.spp < 2)
    return "it has 1 sample; the first chunk needs one of each half";
  if (range.firstSpp > kMostSpp || range.spp > kMostSpp - range.firstSpp)
    return fmt::format("a pixel has at most {} samples", kMostSpp);
  return "";
}

std::vector<ChunkRange> chunkRanges(uint64_t firstSpp, uint64_t endSpp, uint64_t sppOfChunk) {
  const uint64_t step = std::max(kBlockSpp, wholeBlocks(sppOfChunk));
  std::vector<ChunkRange> ranges;
  for (uint64_t at = firstSpp; at < endSpp; at += step)
    ranges.push_back({at, std::min(step, endSpp - at)});
  return ranges;
}

uint64_t sppExpected(const Reference& reference, const ReferenceTarget& target) {
  if (meetsTarget(reference, target)) return reference.spp;
  const double spp = double(reference.spp);
  double wanted = std::numeric_limits<double>::infinity();
  if (target.relmse > 0.0) {
    // The error falls as 1 / spp, and must stay below the target for a doubling.
    wanted =
        std::isfinite(reference.relmse) ? 2.0 * spp * reference.relmse / target.relmse : 2.0 * spp;
    const auto need = reference.metadata.find("light_draws_need_spp");
    if (need != reference.metadata.end())
      wanted = std::max(wanted, std::strtod(need->second.c_str(), nullptr));
  }
  if (target.timeLimitS > 0.0 && reference.timeS > 0.0)
    wanted = std::min(wanted, spp * target.timeLimitS / reference.timeS);
  wanted = std::clamp(wanted, spp + 1.0, 4.0 * std::max(spp, double(kBlockSpp)));
  uint64_t end = wholeBlocks(uint64_t(std::ceil(wanted)));
  while (!RelmseChecks::isDue(end)) end += kBlockSpp;
  return target.spp > 0 ? std::min(end, target.spp) : end;
}

ChunkInfo readChunkInfo(const fs::path& file) { return ChunkReader(file).info(); }

std::string whyNotChunk(const PreparedScene& prepared, const ReferenceConfig& config,
                        const ChunkRange& range, const fs::path& file,
                        const ReferenceTarget& target) {
  try {
    ChunkReader reader(file);
    const ChunkInfo& info = reader.info();
    const ReferenceId id{referenceKey(prepared, config), config.seed, config.backend};
    bool isOwn = info.id == id && info.range == range;
    if (info.id == id && range.firstSpp == 0 && info.range.firstSpp == 0 &&
        info.range.spp < std::min(range.spp, kBlockSpp)) {
      ReferenceState state;
      reader.addNext(state);
      isOwn = ReferenceStop(prepared, config, target).isReached(state);
    }
    if (!isOwn)
      return fmt::format("{}: is of another reference, seed, backend or range", file.string());
    reader.requireUndamaged();
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

bool renderChunk(const PreparedScene& prepared, const ReferenceConfig& config,
                 const ChunkRange& range, const fs::path& file, const ReferenceTarget& target) {
  if (const std::string why = whyNoRange(range); !why.empty())
    failUsage("a chunk of a reference: " + why);
  const ReferenceId id{referenceKey(prepared, config), config.seed, config.backend};
  std::error_code status;
  if (fs::exists(file, status)) {
    const std::string why = whyNotChunk(prepared, config, range, file, target);
    if (why.empty()) {
      logInfo(fmt::format("{}: has these samples already, and stays as it is", file.string()));
      return false;
    }
    logInfo(why + "; rendered anew");
  }
  requireMemory(config.integrator, config.width, config.height, kChunkBytesPerPixel);
  ChunkWriter writer(file);
  ReferenceState block;
  block.id = id;
  ReferenceHalves halves(prepared, config, block, kChunkBytesPerPixel - 2 * sizeof(glm::vec3),
                         range.firstSpp);
  ChunkInfo info = {id,  range,         config.width,     config.height,
                    0.0, block.devices, block.rayTracing, pictureWords(prepared, config)};
  RelmseChecks checks;
  const ReferenceStop stop(prepared, config, target);
  Progress progress(fmt::format("samples {}:{}", range.firstSpp, range.spp), range.spp);
  for (uint64_t done = 1; done <= info.range.spp; ++done) {
    addSample(halves, progress, file);
    const bool isFirstBlock = range.firstSpp == 0 && done <= kBlockSpp;
    if (isFirstBlock) {
      addDueCheck(block);
      if (stop.isReached(block)) info.range.spp = done;
    }
    progress.update(done);
    if (done % kBlockSpp != 0 && done != info.range.spp) continue;
    if (isFirstBlock) checks = block.checks;
    writer.add(block);
    info.timeS += block.timeS;
    block = ReferenceState();
  }
  progress.finish();
  info.metadata.merge(provenanceWords());
  info.metadata["kind"] = "chunk";
  writer.commit(info, checks);
  logInfo(fmt::format("{}: samples {} to {} in {:.1f} s", file.string(), info.range.firstSpp,
                      info.range.end() - 1, info.timeS));
  return true;
}

}  // namespace restlab
