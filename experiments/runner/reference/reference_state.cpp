// File layout: a prefix of fixed size, a header in JSON, the three sums as they lie in memory, and
// the hash of the sums. Doubles and integers are in the byte order of the machine that wrote the
// file.
#include "experiments/runner/reference/reference_state.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "core/image/io/atomic_file.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

constexpr std::array<char, 8> kMagic = {'r', 'l', 'r', 'e', 'f', 's', 't', '\n'};
constexpr uint32_t kVersion = 1;
constexpr uint32_t kMaxHeaderBytes = 1u << 16;

struct Prefix {
  std::array<char, 8> magic = kMagic;
  uint32_t version = kVersion;
  uint32_t headerBytes = 0;
  uint64_t headerHash = 0;
};
static_assert(sizeof(Prefix) == 24);

[[noreturn]] void failDamaged(const fs::path& file, const std::string& why) {
  failInput(fmt::format("{}: is damaged: {}", file.string(), why));
}

class Hash {
 public:
  Hash() : state_(XXH3_createState(), XXH3_freeState) { XXH3_64bits_reset(state_.get()); }
  void add(const void* bytes, size_t count) { XXH3_64bits_update(state_.get(), bytes, count); }
  uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

nlohmann::ordered_json headerOf(const ReferenceState& state) {
  return {{"key", state.id.key},
          {"seed", state.id.seed},
          {"backend", state.id.backend},
          {"width", state.half0.width()},
          {"height", state.half0.height()},
          {"samples_half0", state.half0.count()},
          {"samples_half1", state.half1.count()},
          {"relmse_checks", state.checks.kept()},
          {"render_time_s", state.timeS},
          {"health", state.health.health.counts},
          {"rays_path", state.health.raysPath},
          {"rays_shadow", state.health.raysShadow},
          {"devices", state.devices},
          {"ray_tracing", state.rayTracing}};
}

// Reads the header of an opened file and leaves the stream at the first sum.
nlohmann::json readHeader(const fs::path& file, std::ifstream& in) {
  Prefix prefix;
  in.read(reinterpret_cast<char*>(&prefix), sizeof(prefix));
  if (!in || prefix.magic != kMagic) {
    failInput(fmt::format("{}: is no stored progress of a reference", file.string()));
  }
  if (prefix.version != kVersion) {
    failInput(fmt::format("{}: is of version {}, not {}", file.string(), prefix.version, kVersion));
  }
  if (prefix.headerBytes > kMaxHeaderBytes) failDamaged(file, "its header is too long");
  std::string text(prefix.headerBytes, '\0');
  in.read(text.data(), std::streamsize(text.size()));
  if (!in || XXH3_64bits(text.data(), text.size()) != prefix.headerHash) {
    failDamaged(file, "its header is not what was written");
  }
  return nlohmann::json::parse(text);
}

ReferenceId idOf(const nlohmann::json& header) {
  return {header.at("key").get<std::string>(), header.at("seed").get<uint32_t>(),
          header.at("backend").get<std::string>()};
}

ReferenceState fromHeader(const fs::path& file, const nlohmann::json& header) {
  ReferenceState state;
  state.id = idOf(header);
  state.timeS = header.at("render_time_s").get<double>();
  // Earlier versions stored no checks: a target of error then waits for new ones.
  if (const auto checks = header.find("relmse_checks"); checks != header.end())
    state.checks = RelmseChecks(checks->get<std::vector<double>>());
  const auto health = header.at("health").get<std::vector<uint64_t>>();
  if (health.size() != state.health.health.counts.size()) {
    failDamaged(file, "its counters are not those of this program");
  }
  std::copy(health.begin(), health.end(), state.health.health.counts.begin());
  state.health.raysPath = header.at("rays_path").get<uint64_t>();
  state.health.raysShadow = header.at("rays_shadow").get<uint64_t>();
  state.devices = header.at("devices").get<std::vector<std::string>>();
  state.rayTracing = header.at("ray_tracing").get<std::vector<std::string>>();
  return state;
}

ReferenceState readState(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) failInput(fmt::format("{}: {}", file.string(), unreadableReason(file)));
  const nlohmann::json header = readHeader(file, in);
  ReferenceState state = fromHeader(file, header);
  const auto width = header.at("width").get<uint32_t>();
  const auto height = header.at("height").get<uint32_t>();
  const auto count0 = header.at("samples_half0").get<uint64_t>();
  const auto count1 = header.at("samples_half1").get<uint64_t>();
  const bool byTurns = count1 > 0 && (count0 == count1 || count0 == count1 + 1);
  if (!byTurns || width == 0 || height == 0 || width > kMaxSide || height > kMaxSide) {
    failDamaged(file, "its header makes no sense");
  }
  const size_t pixels = size_t(width) * height;
  const uint64_t expected = uint64_t(in.tellg()) + pixels * kStateBytesPerPixel + sizeof(uint64_t);
  if (fs::file_size(file) != expected) {
    failDamaged(file, fmt::format("it has {} bytes, not {}", fs::file_size(file), expected));
  }
  Hash hash;
  const auto readSum = [&](uint64_t count) {
    std::vector<glm::dvec3> sums(pixels);
    in.read(reinterpret_cast<char*>(sums.data()), std::streamsize(pixels * sizeof(glm::dvec3)));
    hash.add(sums.data(), pixels * sizeof(glm::dvec3));
    return ImageSum(width, height, count, std::move(sums));
  };
  state.half0 = readSum(count0);
  state.half1 = readSum(count1);
  state.squares = readSum(count0 + count1);
  uint64_t stored = 0;
  in.read(reinterpret_cast<char*>(&stored), sizeof(stored));
  if (!in || stored != hash.value()) failDamaged(file, "its sums are not what was written");
  return state;
}

}  // namespace

void writeReferenceState(const fs::path& file, const ReferenceState& state) {
  // Replace invalid UTF-8: a driver may give its device any name.
  const std::string header =
      headerOf(state).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  Prefix prefix;
  prefix.headerBytes = uint32_t(header.size());
  prefix.headerHash = XXH3_64bits(header.data(), header.size());
  AtomicFile output(file);
  output.stream().write(reinterpret_cast<const char*>(&prefix), sizeof(prefix));
  output.stream().write(header.data(), std::streamsize(header.size()));
  Hash hash;
  for (const ImageSum* sum : {&state.half0, &state.half1, &state.squares}) {
    const size_t bytes = sum->sums().size() * sizeof(glm::dvec3);
    output.stream().write(reinterpret_cast<const char*>(sum->sums().data()),
                          std::streamsize(bytes));
    hash.add(sum->sums().data(), bytes);
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
    const nlohmann::json header = readHeader(file, in);
    if (idOf(header) != id) return 0;
    return header.at("samples_half0").get<uint64_t>() + header.at("samples_half1").get<uint64_t>();
  } catch (const std::exception&) {
    return 0;  // reading the file reports what is wrong
  }
}

}  // namespace restlab
