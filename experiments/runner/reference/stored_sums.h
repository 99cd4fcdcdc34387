// Parts of the files that hold sums of samples: a prefix of fixed size, a head in JSON, and sums as
// they lie in memory, in the byte order of the machine that wrote the file.
#pragma once

#include <xxhash.h>

#include <array>
#include <filesystem>
#include <istream>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/reference/relmse_checks.h"
#include "experiments/statistics/image_sum.h"

namespace restlab {

// Kind of such a file.
struct StoredKind {
  std::array<char, 8> magic;
  uint32_t version;
  const char* name;  // "stored progress of a reference"
  uint32_t maxHeadBytes;
};

// First bytes of such a file.
struct StoredPrefix {
  std::array<char, 8> magic{};
  uint32_t version = 0;
  uint32_t headBytes = 0;
  uint64_t headHash = 0;
};
static_assert(sizeof(StoredPrefix) == 24);

// Returns the text of a head. Replaces invalid UTF-8: a driver may give its device any name.
std::string headText(const nlohmann::ordered_json& head);
StoredPrefix prefixOf(const StoredKind& kind, const std::string& headText);
// Throw Error (badInput) that begins with the file.
StoredPrefix readPrefix(const std::filesystem::path& file, const StoredKind& kind,
                        std::istream& in);
// Reads the head, at which `in` stands.
nlohmann::json readHead(const std::filesystem::path& file, const StoredPrefix& prefix,
                        std::istream& in);
[[noreturn]] void failDamaged(const std::filesystem::path& file, const std::string& why);

// Hash of sums.
class SumsHash {
 public:
  SumsHash() : state_(XXH3_createState(), XXH3_freeState) { XXH3_64bits_reset(state_.get()); }
  void add(const ImageSum& sum);
  uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

// Write and read the sums alone, and add them to the hash. A sum of no frames takes no bytes.
void writeSums(std::ostream& out, const ImageSum& sum, SumsHash& hash);
ImageSum readSums(std::istream& in, uint32_t width, uint32_t height, uint64_t count,
                  SumsHash& hash);

// Counters and checks as a head has them. Reading throws Error (badInput) or a JSON exception.
nlohmann::ordered_json countersJson(const HealthSum& sum);
HealthSum countersOf(const std::filesystem::path& file, const nlohmann::json& head);
nlohmann::ordered_json checksJson(const RelmseChecks& checks);
RelmseChecks checksOf(const nlohmann::json& checks);

}  // namespace restlab
