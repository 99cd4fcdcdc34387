// Parts of a reference that several machines render: ranges of its samples, each in a file, merged
// to the bits that one machine gives. Sums are made by blocks of kBlockSpp samples (see
// reference_state.h); a chunk is a range of whole blocks, whose sums its file holds apart.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/runner/reference/reference.h"
#include "experiments/runner/reference/reference_state.h"

namespace restlab {

constexpr const char* kChunkExtension = ".chunk";

// Samples firstSpp to end() - 1 of every pixel, counted from 0 over both halves.
struct ChunkRange {
  uint64_t firstSpp = 0;  // a multiple of kBlockSpp
  uint64_t spp = 0;       // at least 1; a multiple of kBlockSpp unless nothing follows
  uint64_t end() const { return firstSpp + spp; }
  bool operator==(const ChunkRange&) const = default;
};

// Last sample that has a number of its own, plus one.
constexpr uint64_t kMostSpp = uint64_t(1) << 32;

// Returns why nothing can be rendered of a range: it is empty, does not begin at a block, ends
// beyond kMostSpp, or begins at 0 without a sample of each half; "" if it can.
std::string whyNoRange(const ChunkRange& range);

// Cuts the samples from `firstSpp` (a multiple of kBlockSpp) to `endSpp` into chunks of
// `sppOfChunk` samples, rounded up to whole blocks. The last one may be shorter.
std::vector<ChunkRange> chunkRanges(uint64_t firstSpp, uint64_t endSpp, uint64_t sppOfChunk);

// Returns how many samples per pixel a reference probably needs until it meets the target, in whole
// blocks unless target.spp ends it before: at least one block more than it has, and at most four
// times as many, as its error is an estimate. Returns what it has if it meets the target.
uint64_t sppExpected(const Reference& reference, const ReferenceTarget& target);

// Head of a chunk's file, without its sums.
struct ChunkInfo {
  ReferenceId id;
  ChunkRange range;
  uint32_t width = 0, height = 0;
  double timeS = 0.0;  // spent rendering
  std::vector<std::string> devices, rayTracing;
  // Scene, camera, settings, machine, and what made the file, as the metadata of an image.
  std::map<std::string, std::string> metadata;
};

// Reads the head of a chunk's file. Throws Error (badInput): the file, and what is wrong with it.
ChunkInfo readChunkInfo(const std::filesystem::path& file);

// Bytes of memory of renderChunk(): two sessions, each a buffer and an image, and the sums of one
// block. Buffers of the integrator are counted by its sessions.
constexpr size_t kChunkBytesPerPixel = 4 * sizeof(glm::vec3) + kBlockBytesPerPixel;
// Bytes of the file of a chunk of `spp` samples, without its head of a few kilobytes.
constexpr uint64_t chunkFileBytesPerPixel(uint64_t spp) {
  return (spp + kBlockSpp - 1) / kBlockSpp * kBlockBytesPerPixel;
}

// Returns why the file does not hold these samples, undamaged; "" if it does. `target`: as for
// renderChunk().
std::string whyNotChunk(const PreparedScene& prepared, const ReferenceConfig& config,
                        const ChunkRange& range, const std::filesystem::path& file,
                        const ReferenceTarget& target = {});

// Renders a chunk to `file`, which appears complete or not at all. A sample is the same wherever
// it is rendered. A chunk that begins at 0 ends before the range does where its first block meets
// the target: one rendering would stop there. If the file holds these samples already (same key,
// seed, backend and range, and undamaged), nothing is rendered and the result is false; any other
// file is replaced, and a line says why. Progress goes to stderr. Throws Error: `interrupted` on a
// signal, `badUsage` if a method has a history and the range does not begin at 0, `badInput` if the
// file cannot be written, and what sessions throw. After a throw nothing stays; the next call
// begins anew.
bool renderChunk(const PreparedScene& prepared, const ReferenceConfig& config,
                 const ChunkRange& range, const std::filesystem::path& file,
                 const ReferenceTarget& target = {});

// Adds chunks to `state`, in the order of their samples, whatever the order of `files`: the result
// is bit for bit the state of one rendering (but for times, and devices where they differ).
// `state`: empty, or an earlier result, at whose last sample the first file goes on. With a target,
// blocks that one rendering would not have rendered are left out: those after the block in which it
// is reached. Throws Error (badInput) that names the file: chunks of another scene, setting,
// version, seed or backend than `config`, gaps, overlaps, a short chunk that is not the last, and
// damaged files. Needs the memory of a state and of one block.
ReferenceState mergeChunks(const PreparedScene& prepared, const ReferenceConfig& config,
                           ReferenceState state, const std::vector<std::filesystem::path>& files,
                           const ReferenceTarget& target = {});

// Stores a merged reference where obtainReference() looks for it: as `label` in `folder`, in the
// user's cache, and its progress there, so that later calls continue it. What the cache holds of
// more samples stays. Returns the reference; meetsTarget() says whether it needs further chunks.
// Throws Error (badInput) if `folder` cannot be written; a cache that cannot is a line.
Reference storeMerged(const PreparedScene& prepared, const ReferenceConfig& config,
                      const ReferenceState& state, const std::filesystem::path& folder,
                      const std::string& label);

}  // namespace restlab
