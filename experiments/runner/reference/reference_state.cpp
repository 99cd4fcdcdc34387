// File layout: a prefix of fixed size, a head in JSON, the sums of each kind (complete blocks, then
// the open one; none for no samples), and the hash of all sums.
#include "experiments/runner/reference/reference_state.h"

#include <fmt/format.h>

#include <array>
#include <fstream>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "core/image/io/atomic_file.h"
#include "experiments/runner/reference/stored_sums.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

constexpr StoredKind kStateFile = {
    {'r', 'l', 'r', 'e', 'f', 's', 't', '\n'}, 2, "stored progress of a reference", 1u << 16};

nlohmann::ordered_json headOf(const ReferenceState& state) {
  nlohmann::ordered_json head = {{"key", state.id.key},
                                 {"seed", state.id.seed},
                                 {"backend", state.id.backend},
                                 {"width", state.half0.width()},
                                 {"height", state.half0.height()},
                                 {"samples_of_block", kBlockSpp},
                                 {"samples_half0", state.half0.count()},
                                 {"samples_half1", state.half1.count()},
                                 {"relmse_checks", checksJson(state.checks)},
                                 {"render_time_s", state.timeS},
                                 {"devices", state.devices},
                                 {"ray_tracing", state.rayTracing}};
  head.update(countersJson(state.health));
  return head;
}

nlohmann::json readStateHead(const fs::path& file, std::istream& in) {
  const StoredPrefix prefix = readPrefix(file, kStateFile, in);
  return readHead(file, prefix, in);
}

ReferenceId idOf(const nlohmann::json& head) {
  return {head.at("key").get<std::string>(), head.at("seed").get<uint32_t>(),
          head.at("backend").get<std::string>()};
}

ReferenceState fromHead(const fs::path& file, const nlohmann::json& head) {
  ReferenceState state;
  state.id = idOf(head);
  state.timeS = head.at("render_time_s").get<double>();
  state.checks = checksOf(head.at("relmse_checks"));
  state.health = countersOf(file, head);
  state.devices = head.at("devices").get<std::vector<std::string>>();
  state.rayTracing = head.at("ray_tracing").get<std::vector<std::string>>();
  return state;
}

ReferenceState readState(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) failInput(fmt::format("{}: {}", file.string(), unreadableReason(file)));
  const nlohmann::json head = readStateHead(file, in);
  ReferenceState state = fromHead(file, head);
  const auto width = head.at("width").get<uint32_t>();
  const auto height = head.at("height").get<uint32_t>();
  const auto count0 = head.at("samples_half0").get<uint64_t>();
  const auto count1 = head.at("samples_half1").get<uint64_t>();
  const bool byTurns = count1 > 0 && (count0 == count1 || count0 == count1 + 1);
  if (!byTurns || width == 0 || height == 0 || width > kMaxSide || height > kMaxSide ||
      head.at("samples_of_block").get<uint64_t>() != kBlockSpp) {
    failDamaged(file, "its header makes no sense");
  }
  const std::array<uint64_t, 3> counts = {count0, count1, count0 + count1};
  const std::array<BlockSum*, 3> sums = {&state.half0, &state.half1, &state.squares};
  uint64_t parts = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    const uint64_t block = sums[i]->framesOfBlock();
    parts += uint64_t(counts[i] >= block) + uint64_t(counts[i] % block > 0);
  }
  const uint64_t expected = uint64_t(in.tellg()) +
                            uint64_t(width) * height * parts * sizeof(glm::dvec3) +
                            sizeof(uint64_t);
  if (fs::file_size(file) != expected)
    failDamaged(file, fmt::format("it has {} bytes, not {}", fs::file_size(file), expected));
  SumsHash hash;
  for (size_t i = 0; i < counts.size(); ++i) {
    const uint64_t block = sums[i]->framesOfBlock(), open = counts[i] % block;
    ImageSum blocks = readSums(in, width, height, counts[i] - open, hash);
    *sums[i] = BlockSum(block, std::move(blocks), readSums(in, width, height, open, hash));
  }
  uint64_t stored = 0;
  in.read(reinterpret_cast<char*>(&stored), sizeof(stored));
  if (!in || stored != hash.value()) failDamaged(file, "its sums are not what was written");
  return state;
}

}  // namespace

void writeReferenceState(const fs::path& file, const ReferenceState& state) {
  const std::string head = headText(headOf(state));
  const StoredPrefix prefix = prefixOf(kStateFile, head);
  AtomicFile output(file);
  output.stream().write(reinterpret_cast<const char*>(&prefix), sizeof(prefix));
  output.stream().write(head.data(), std::streamsize(head.size()));
  SumsHash hash;
  for (const BlockSum* sum : {&state.half0, &state.half1, &state.squares}) {
    writeSums(output.stream(), sum->blocks(), hash);
    writeSums(output.stream(), sum->open(), hash);
  }
  const uint64_t value = hash.value();
  output.stream().write(reinterpret_cast<const char*>(&value), sizeof(value));
  output.commit();
}

ReferenceState readReferenceState(const fs::path& file) {
  try {
    return readState(file);
  } catch (const nlohmann::json::exception&) {
    failDamaged(file, "its header makes no sense");
  } catch (const fs::filesystem_error& error) {
    failInput(fmt::format("{}: cannot be read: {}", file.string(), error.code().message()));
  }
}

uint64_t storedSamples(const fs::path& file, const ReferenceId& id) {
  try {
    std::ifstream in(file, std::ios::binary);
    if (!in) return 0;
    const nlohmann::json head = readStateHead(file, in);
    if (idOf(head) != id) return 0;
    return head.at("samples_half0").get<uint64_t>() + head.at("samples_half1").get<uint64_t>();
  } catch (const std::exception&) {
    return 0;  // reading the file reports what is wrong
  }
}

}  // namespace restlab
