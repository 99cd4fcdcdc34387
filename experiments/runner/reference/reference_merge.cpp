// Merges chunks of a reference.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/reference/reference_chunk.h"
#include "experiments/runner/reference/reference_chunk_file.h"
#include "experiments/runner/reference/reference_stop.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

struct Chunk {
  fs::path file;
  ChunkInfo info;
};

// Throws Error (badInput) unless the chunk is of `id`. `wanted`: the picture of `id`, in words.
void requireOfReference(const Chunk& chunk, const ReferenceId& id,
                        const std::map<std::string, std::string>& wanted) {
  const std::string file = chunk.file.string();
  if (chunk.info.id.key != id.key) {
    const auto by = chunk.info.metadata.find("integrator");
    if (by != chunk.info.metadata.end() && by->second != wanted.at("integrator")) {
      failInput(fmt::format("{}: is a chunk of a reference by {}, not {}", file, by->second,
                            wanted.at("integrator")));
    }
    requireSameConfiguration(file, chunk.info.metadata, wanted);
    failInput(fmt::format("{}: is of another scene, setting or version (key {}, wanted {})", file,
                          chunk.info.id.key.substr(0, 8), id.key.substr(0, 8)));
  }
  for (const auto& [item, its, other] :
       {std::tuple("seed", std::to_string(chunk.info.id.seed), std::to_string(id.seed)),
        std::tuple("backend", chunk.info.id.backend, id.backend)}) {
    if (its != other) failInput(fmt::format("{}: is of {} {}, not {}", file, item, its, other));
  }
}

// Throws Error (badInput) unless the chunks, in this order, go on after `spp` samples without a
// gap.
void requireWhole(const std::vector<Chunk>& chunks, uint64_t spp) {
  std::string before = "the samples before it";
  for (const auto& [file, info] : chunks) {
    const uint64_t first = info.range.firstSpp;
    if (first < spp) {
      failInput(fmt::format("{}: begins at sample {}, but {} go on to sample {}", file.string(),
                            first, before, spp - 1));
    }
    if (first > spp) {
      failInput(fmt::format("{}: begins at sample {}, but samples {} to {} of a pixel are missing",
                            file.string(), first, spp, first - 1));
    }
    spp = info.range.end();
    before = fmt::format("those of {}", file.string());
  }
}

void addNames(std::vector<std::string>& names, const std::vector<std::string>& more) {
  for (const std::string& name : more) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
}

}  // namespace

ReferenceState mergeChunks(const PreparedScene& prepared, const ReferenceConfig& config,
                           ReferenceState state, const std::vector<fs::path>& files,
                           const ReferenceTarget& target) {
  const ReferenceId id{referenceKey(prepared, config), config.seed, config.backend};
  if (state.spp() == 0) state.id = id;
  if (state.id != id) {
    failInput(fmt::format("the samples to go on from are of another reference (key {}, wanted {})",
                          state.id.key.substr(0, 8), id.key.substr(0, 8)));
  }
  const std::map<std::string, std::string> picture = pictureWords(prepared, config);
  std::vector<Chunk> chunks;
  for (const fs::path& file : files) {
    chunks.push_back({file, readChunkInfo(file)});
    requireOfReference(chunks.back(), id, picture);
  }
  std::sort(chunks.begin(), chunks.end(), [](const Chunk& a, const Chunk& b) {
    return std::pair(a.info.range.firstSpp, a.file) < std::pair(b.info.range.firstSpp, b.file);
  });
  requireWhole(chunks, state.spp());
  requireMemory("merged chunks", config.width, config.height,
                kStateBytesPerPixel + kBlockBytesPerPixel);
  const ReferenceStop stop(prepared, config, target);
  for (const Chunk& chunk : chunks) {
    if (stop.isReached(state)) break;
    ChunkReader reader(chunk.file);
    addNames(state.devices, chunk.info.devices);
    addNames(state.rayTracing, chunk.info.rayTracing);
    while (reader.hasNext() && !stop.isReached(state)) reader.addNext(state);
  }
  return state;
}

}  // namespace restlab
