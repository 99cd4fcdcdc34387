// File layout: a prefix of fixed size, the three sums of each block, and a head in JSON, which is
// known last.
#include "experiments/runner/reference/reference_chunk_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "experiments/runner/reference/reference_halves.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

constexpr StoredKind kChunkFile = {
    {'r', 'l', 'c', 'h', 'u', 'n', 'k', '\n'}, 1, "chunk of a reference", 1u << 26};

void write(std::ostream& out, const StoredPrefix& prefix) {
  out.write(reinterpret_cast<const char*>(&prefix), sizeof(prefix));
}

// Returns the frames of the halves and of the squares in a block of `spp` samples.
std::array<uint64_t, 3> framesOf(uint64_t spp) { return {(spp + 1) / 2, spp / 2, spp}; }

}  // namespace

ChunkWriter::ChunkWriter(const fs::path& file) : output_(file) {
  write(output_.stream(), StoredPrefix{});
}

void ChunkWriter::add(const ReferenceState& block) {
  SumsHash hash;
  for (const BlockSum* sum : {&block.half0, &block.half1, &block.squares})
    writeSums(output_.stream(), sum->onlyBlock(), hash);
  nlohmann::ordered_json entry = {{"render_time_s", block.timeS}, {"hash", hash.value()}};
  entry.update(countersJson(block.health));
  blocks_.push_back(entry);
  // Further blocks would be lost with this one.
  if (!output_.stream().flush()) output_.commit();
}

void ChunkWriter::commit(const ChunkInfo& info, const RelmseChecks& checks) {
  const std::string head = headText({{"key", info.id.key},
                                     {"seed", info.id.seed},
                                     {"backend", info.id.backend},
                                     {"width", info.width},
                                     {"height", info.height},
                                     {"samples_of_block", kBlockSpp},
                                     {"first_sample", info.range.firstSpp},
                                     {"samples", info.range.spp},
                                     {"render_time_s", info.timeS},
                                     {"devices", info.devices},
                                     {"ray_tracing", info.rayTracing},
                                     {"metadata", info.metadata},
                                     {"relmse_checks", checksJson(checks)},
                                     {"blocks", blocks_}});
  output_.stream().write(head.data(), std::streamsize(head.size()));
  output_.stream().seekp(0);
  write(output_.stream(), prefixOf(kChunkFile, head));
  output_.commit();
}

// Sums and counters of a block.
struct ChunkReader::Block {
  ImageSum half0, half1, squares;
  HealthSum health;
  double timeS = 0.0;
};

ChunkReader::ChunkReader(const fs::path& file) : file_(file), in_(file, std::ios::binary) {
  try {
    open();
  } catch (const nlohmann::json::exception&) {
    failDamaged(file_, "its header makes no sense");
  } catch (const fs::filesystem_error& error) {
    failInput(fmt::format("{}: cannot be read: {}", file_.string(), error.code().message()));
  }
}

void ChunkReader::open() {
  if (!in_) failInput(fmt::format("{}: {}", file_.string(), unreadableReason(file_)));
  const StoredPrefix prefix = readPrefix(file_, kChunkFile, in_);
  const uint64_t bytes = fs::file_size(file_);
  if (bytes < sizeof(prefix) + prefix.headBytes) failDamaged(file_, "its end is missing");
  in_.seekg(std::streamoff(bytes - prefix.headBytes));
  const nlohmann::json head = readHead(file_, prefix, in_);
  info_.id = {head.at("key").get<std::string>(), head.at("seed").get<uint32_t>(),
              head.at("backend").get<std::string>()};
  info_.range = {head.at("first_sample").get<uint64_t>(), head.at("samples").get<uint64_t>()};
  info_.width = head.at("width").get<uint32_t>();
  info_.height = head.at("height").get<uint32_t>();
  info_.timeS = head.at("render_time_s").get<double>();
  info_.devices = head.at("devices").get<std::vector<std::string>>();
  info_.rayTracing = head.at("ray_tracing").get<std::vector<std::string>>();
  info_.metadata = head.at("metadata").get<std::map<std::string, std::string>>();
  checks_ = checksOf(head.at("relmse_checks"));
  blocks_ = head.at("blocks");
  if (const auto block = head.at("samples_of_block").get<uint64_t>(); block != kBlockSpp) {
    failInput(
        fmt::format("{}: its blocks are of {} samples, not {}", file_.string(), block, kBlockSpp));
  }
  const uint32_t width = info_.width, height = info_.height;
  if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide ||
      !whyNoRange(info_.range).empty() ||
      blocks_.size() != (info_.range.spp + kBlockSpp - 1) / kBlockSpp) {
    failDamaged(file_, "its header makes no sense");
  }
  uint64_t sums = 3 * blocks_.size();
  if (info_.range.spp % kBlockSpp == 1) --sums;  // no sample of the second half
  const uint64_t expected =
      sizeof(prefix) + prefix.headBytes + sums * uint64_t(width) * height * sizeof(glm::dvec3);
  if (bytes != expected)
    failDamaged(file_, fmt::format("it has {} bytes, not {}", bytes, expected));
  in_.seekg(sizeof(prefix));
}

ChunkReader::Block ChunkReader::read() {
  const uint64_t before = next_ * kBlockSpp;
  const auto frames = framesOf(std::min(kBlockSpp, info_.range.spp - before));
  const nlohmann::json& entry = blocks_.at(next_);
  Block block;
  SumsHash hash;
  const std::array<ImageSum*, 3> sums = {&block.half0, &block.half1, &block.squares};
  for (size_t i = 0; i < sums.size(); ++i)
    *sums[i] = readSums(in_, info_.width, info_.height, frames[i], hash);
  if (!in_ || entry.at("hash").get<uint64_t>() != hash.value()) {
    failDamaged(file_, fmt::format("its sums of the samples from {} on are not what was written",
                                   info_.range.firstSpp + before));
  }
  block.health = countersOf(file_, entry);
  block.timeS = entry.at("render_time_s").get<double>();
  ++next_;
  return block;
}

void ChunkReader::addNext(ReferenceState& state) {
  Block block = read();
  const bool isFirst = state.spp() == 0;
  state.half0.addBlock(std::move(block.half0));
  state.half1.addBlock(std::move(block.half1));
  state.squares.addBlock(std::move(block.squares));
  state.health.add(block.health);
  state.timeS += block.timeS;
  if (isFirst) {
    state.checks = checks_;
  } else {
    addDueCheck(state);
  }
}

void ChunkReader::requireUndamaged() {
  while (hasNext()) read();
}

}  // namespace restlab
