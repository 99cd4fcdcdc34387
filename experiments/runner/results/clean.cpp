#include "experiments/runner/results/clean.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <regex>
#include <set>

#include "core/base/error.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/runner/results/folder_lock.h"
#include "experiments/runner/results/results_folder.h"
#include "experiments/runner/run/image_rows.h"
#include "experiments/runner/run/job.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

uint64_t bytesOf(const fs::path& path) {
  std::error_code status;
  if (!fs::is_directory(path, status)) {
    const uint64_t bytes = fs::file_size(path, status);
    return status ? 0 : bytes;
  }
  uint64_t bytes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path, status)) {
    if (entry.is_regular_file(status)) bytes += entry.file_size(status);
  }
  return bytes;
}

// Matches the names that JobStore and AtomicFile give. Jobs are written under the folder's lock,
// which this process holds. Files may also be written by `render` or `figure`: their names have the
// process number and the machine, and only those of dead processes of this one match.
bool isUnfinished(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.rfind(".unfinished-", 0) == 0) return true;
  static const std::regex names(R"(.+\.tmp-([0-9]+)-[0-9]+(-.*)?)");
  std::smatch match;
  if (!std::regex_match(name, match, names)) return false;
  if (match[2].matched && match[2].str() != "-" + nodeName()) return false;
  const std::string process = match[1].str();
  return process.size() > 9 || (kill(pid_t(std::stol(process)), 0) != 0 && errno == ESRCH);
}

// Rejects links: the folder they lead to may belong to somebody else.
bool isOwnFolder(const fs::path& folder) {
  std::error_code status;
  if (fs::is_symlink(folder, status)) {
    logInfo(fmt::format("{}: is a link; nothing is removed there", folder.string()));
    return false;
  }
  return fs::is_directory(folder, status);
}

std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code status;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, status))
    found.push_back(entry.path());
  return found;
}

// Returns whether the plan uses this reference, also as that of the frame before the measured one.
bool usesReference(const ResultsFolder& results, const fs::path& file) {
  std::error_code status;
  for (const PlannedBlock& block : results.plan) {
    fs::path used = results.folder / block.reference;
    if (fs::equivalent(file, used, status)) return true;
    used.replace_filename(used.stem().string() + "-before.exr");
    if (fs::equivalent(file, used, status)) return true;
  }
  // Plain-scene files from which the references of scenes with Truth::same are made.
  if (file.stem().string().ends_with(kPlainReference)) {
    for (const Suite& suite : results.points) {
      for (const SuiteScene& scene : suite.scenes)
        if (scene.truth == Truth::same) return true;
    }
  }
  return std::any_of(results.points.begin(), results.points.end(),
                     [&](const Suite& suite) { return readsFile(suite, file); });
}

}  // namespace

bool readsFile(const Suite& suite, const fs::path& file) {
  std::error_code status;
  for (const fs::path& image : imageFiles(suite)) {
    if (fs::equivalent(file, image, status)) return true;
  }
  for (const SuiteScene& scene : suite.scenes) {
    for (const std::string& name : {scene.reference, scene.request.environment}) {
      if (!name.empty() && fs::equivalent(file, findAsset(name), status)) return true;
    }
  }
  return false;
}

Cleaned cleanResults(const fs::path& folder) {
  openResults(folder);  // throws for other folders before one is locked
  const FolderLock lock(folder);
  const ResultsFolder results = openResults(folder);
  Cleaned cleaned;
  cleaned.isFinished = results.record.at("status").get<std::string>() == "finished";
  std::error_code status;
  const auto remove = [&](const fs::path& path) {
    const uint64_t bytes = bytesOf(path);
    fs::remove_all(path, status);
    if (status)
      failInput(fmt::format("{}: cannot be removed: {}", path.string(), status.message()));
    cleaned.bytes += bytes;
  };
  std::set<std::string> parts = {""};
  for (const char* part : {"jobs", "references", "images", "plots"}) {
    if (isOwnFolder(folder / part)) parts.insert(part);
  }
  for (const std::string& part : parts) {
    for (const fs::path& path : entriesOf(folder / part)) {
      if (!isUnfinished(path)) continue;
      remove(path);
      ++cleaned.unfinished;
    }
  }
  const JobStore store(folder);
  const std::vector<fs::path> references = entriesOf(folder / "references");
  cleaned.jobsKept = store.keys().size();
  cleaned.referencesKept = references.size();
  if (!cleaned.isFinished) return cleaned;
  std::set<std::string> used;
  for (const PlannedBlock& block : results.plan) {
    used.insert(block.jobs.begin(), block.jobs.end());
    used.insert(block.images.begin(), block.images.end());
  }
  for (const std::string& key : store.keys()) {
    if (used.count(key) != 0 || parts.count("jobs") == 0) continue;
    remove(store.folderOf(key));
    ++cleaned.jobs;
  }
  for (const fs::path& file : references) {
    if (file.extension() != ".exr" || usesReference(results, file)) continue;
    if (parts.count("references") == 0) continue;
    remove(file);
    cleaned.references.push_back(file.filename().string());
  }
  std::sort(cleaned.references.begin(), cleaned.references.end());
  cleaned.jobsKept -= cleaned.jobs;
  cleaned.referencesKept -= cleaned.references.size();
  return cleaned;
}

}  // namespace restlab
