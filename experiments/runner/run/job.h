// Jobs: one run of every method of a block. A job is a folder named by its key. It appears by a
// rename once complete, and is reused if the key agrees.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/base/build_info.h"
#include "experiments/runner/run/experiment.h"

namespace restlab {

// Names and values that a job's results depend on.
struct JobIdentity {
  nlohmann::ordered_json words;
  std::string key() const;  // 32 hexadecimal digits
};

// `build`: sources and compiler of this program; `referenceHash`: hash of the pixels that errors
// are measured against; `devices`: all devices in use.
JobIdentity jobIdentity(const Suite& suite, const PreparedScene& prepared, const BlockResult& block,
                        uint32_t run, const BuildInfo& build, const std::string& referenceHash,
                        const std::vector<DeviceUse>& devices);

// Returns a hash of the pixels.
std::string imageHash(const Image& image);
// Returns a hash of the pixels of the mean and the halves.
std::string referenceHash(const Reference& reference);

// Job folders in DIR/jobs.
class JobStore {
 public:
  // `out`: must exist and be writable.
  explicit JobStore(const std::filesystem::path& out) : folder_(out / "jobs") {}

  // Returns the folder of a job, even if it does not exist.
  std::filesystem::path folderOf(const std::string& key) const { return folder_ / key; }
  // Returns lines and images of the job; nothing if it is absent or damaged. Logs damage.
  std::optional<JobData> load(const std::string& key) const;
  // Returns the job.json without images: "identity" in words, "methods" with their "lines". Returns
  // nothing, silently, if it is absent or damaged.
  std::optional<nlohmann::ordered_json> record(const std::string& key) const;
  // Writes the job under its key. Throws Error (badInput) if the disk is full or read-only, and
  // then leaves nothing under the key.
  void save(const JobIdentity& identity, const JobData& job) const;
  // Returns the keys of existing jobs, sorted.
  std::vector<std::string> keys() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace restlab
