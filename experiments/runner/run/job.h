// Jobs: one run of every method of a block. A job is a folder named by its key; it appears by a
// rename when all of it is written, and is taken again where the key agrees.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/run/build_info.h"
#include "experiments/runner/run/experiment.h"

namespace restlab {

// What a job's results depend on, in words.
struct JobIdentity {
  nlohmann::ordered_json words;
  std::string key() const;  // 32 hexadecimal digits
};

// `build`: what this program was built from, and how; `referenceHash`: of the
// pixels that errors are measured against; `devices`: what kernels run on.
JobIdentity jobIdentity(const Suite& suite, const PreparedScene& prepared, const BlockResult& block,
                        uint32_t run, const BuildInfo& build, const std::string& referenceHash,
                        const std::vector<DeviceUse>& devices);

// Of the pixels.
std::string imageHash(const Image& image);
// Of the pixels of the mean and the halves.
std::string referenceHash(const Reference& reference);

// DIR/jobs.
class JobStore {
 public:
  // `out` exists and is writable.
  explicit JobStore(const std::filesystem::path& out) : folder_(out / "jobs") {}

  // The folder of a job, whether it is there or not.
  std::filesystem::path folderOf(const std::string& key) const { return folder_ / key; }
  // Lines and images of the job; nothing where it is not there or, with one line that says what is
  // wrong, where it is damaged.
  std::optional<JobData> load(const std::string& key) const;
  // Its job.json without the images: "identity" in words, "methods" with their "lines". Nothing
  // where that is not there or damaged, about which nothing is said.
  std::optional<nlohmann::ordered_json> record(const std::string& key) const;
  // Writes it under its key. Throws Error (badInput) where the disk is full or read-only; nothing
  // is left under the key then.
  void save(const JobIdentity& identity, const JobData& job) const;
  // Keys of the jobs that are there, sorted.
  std::vector<std::string> keys() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace restlab
