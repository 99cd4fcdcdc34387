// File of a chunk of a reference: the sums of each of its blocks, one after the other, and a head.
// It is written and read block by block.
#pragma once

#include <fstream>

#include "core/image/io/atomic_file.h"
#include "experiments/runner/reference/reference_chunk.h"
#include "experiments/runner/reference/stored_sums.h"

namespace restlab {

class ChunkWriter {
 public:
  // Throws Error (badInput) if the file cannot be created.
  explicit ChunkWriter(const std::filesystem::path& file);
  // Adds the next block: a state that holds its samples alone. Throws Error (badInput) if the disk
  // is full.
  void add(const ReferenceState& block);
  // Completes the file. `checks`: those of the first block of a reference.
  void commit(const ChunkInfo& info, const RelmseChecks& checks);

 private:
  AtomicFile output_;
  nlohmann::ordered_json blocks_ = nlohmann::ordered_json::array();
};

class ChunkReader {
 public:
  // Reads the head. Throws Error (badInput): the file, and what is wrong with it.
  explicit ChunkReader(const std::filesystem::path& file);
  const ChunkInfo& info() const { return info_; }
  bool hasNext() const { return next_ < blocks_.size(); }
  // Reads the next block and adds it to `state`, which has all samples before it, with the check
  // that is due. Throws Error (badInput), and leaves `state` as it was, if the block is damaged.
  void addNext(ReferenceState& state);
  // Reads all further blocks for their checksums alone. Throws as addNext() does.
  void requireUndamaged();

 private:
  struct Block;
  Block read();
  void open();
  std::filesystem::path file_;
  std::ifstream in_;
  ChunkInfo info_;
  RelmseChecks checks_;
  nlohmann::json blocks_;
  size_t next_ = 0;
};

}  // namespace restlab
