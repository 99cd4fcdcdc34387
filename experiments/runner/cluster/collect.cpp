#include "experiments/runner/cluster/collect.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/base/control_characters.h"
#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/cluster/task_file.h"
#include "experiments/runner/cluster/tasks_there.h"
#include "experiments/runner/results/folder_lock.h"
#include "experiments/runner/results/results_folder.h"
#include "experiments/runner/results/results_log.h"
#include "experiments/runner/run/block.h"
#include "experiments/runner/run/job.h"
#include "experiments/runner/run/run_record.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

class Collector {
 public:
  Collector(const fs::path& folder, const Plan& plan, const fs::path& out)
      : folder_(folder), plan_(plan), out_(out), store_(out) {}

  Collected collect() {
    makeWritableDirectory(out_);
    isElsewhere_ = !fs::equivalent(out_, folder_);
    if (isElsewhere_) requireOwnFolder();
    requirePlannedFiles();
    // A job whose image is damaged in `out_` is unpacked again, which needs a second time.
    if (!makeTables() && !makeTables())
      failInput(
          fmt::format("{}: images in it are damaged as soon as they are written", out_.string()));
    return std::move(collected_);
  }

 private:
  // Returns false if some jobs were damaged. They are removed.
  bool makeTables() {
    const uint64_t setAside = collected_.setAside;
    collected_ = Collected();
    collected_.setAside = setAside;
    references_.clear();
    Json blocks = Json::array();
    {
      const FolderLock lock(out_);
      makeWritableDirectory(out_ / "references");
      makeWritableDirectory(out_ / "jobs");
      if (isElsewhere_) {
        fs::copy_file(folder_ / "suite.toml", out_ / "suite.toml",
                      fs::copy_options::overwrite_existing);
      }
      ResultsLog log(out_ / "results.jsonl");
      const TasksThere there = tasksThere(folder_, plan_);
      removeLeftovers(folder_, plan_, there);
      collected_.tasks = plan_.tasks();
      for (const TaskGroup& group : plan_.groups()) {
        if (group.isReference) continue;  // a merged reference needs no chunk any more
        Json block;
        for (uint64_t index = group.firstTask; index < group.endTask(); ++index) {
          const Task task = Plan::taskOf(group, index);
          if (!there.isDone[index] || !take(task, log, block)) collected_.missing.push_back(index);
        }
        if (!block.is_null()) blocks.push_back(std::move(block));
      }
      writeRecord(std::move(blocks));
    }
    RemadeOutputs made = remakeOutputs(out_);
    for (const std::string& key : made.missing) {
      std::error_code status;
      fs::remove_all(store_.folderOf(key), status);
    }
    collected_.tables = std::move(made.tables);
    return made.missing.empty();
  }

  // Throws unless the files that the suite names are those that errors were measured against.
  void requirePlannedFiles() const {
    std::map<std::string, std::string> hashes;
    std::vector<Suite> points;
    for (const PlannedTable& table : plan_.tables) {
      if (table.referenceHash.empty()) continue;
      if (points.empty()) points = openPlan(folder_, plan_);
      const fs::path file =
          referenceFileNamed(points.at(table.block.point).scenes.at(table.block.scene));
      std::string& hash = hashes[file.string()];
      if (hash.empty()) hash = referenceHash(readReference(file));
      if (hash != table.referenceHash) failInput(changedReferenceText(file));
    }
  }

  void requireOwnFolder() const {
    std::error_code status;
    if (!fs::exists(out_ / "run.json", status)) return;
    const ResultsFolder there = openResults(out_);
    if (there.record.value("plan_id", "") == plan_.id) return;
    failInput(fmt::format("{}: has results of something else; choose another folder with -o",
                          out_.string()));
  }

  // Adds the task's jobs to the folder and its block. Returns false, with a line, if its file is
  // damaged.
  bool take(const Task& task, ResultsLog& log, Json& block) {
    const fs::path file = resultFile(folder_, plan_, task);
    try {
      const Json head = readTaskHead(file);
      if (head.at("plan").get<std::string>() != plan_.id ||
          head.at("task").get<uint64_t>() != task.index)
        failInput(fmt::format("{}: is of another plan or task", file.string()));
      const std::string& reference = plan_.tables[task.of].referenceHash;
      if (!reference.empty() && head.at("reference_hash").get<std::string>() != reference)
        failInput(fmt::format("{}: is measured against another reference", file.string()));
      requireSameReference(task, head, file);
      unpack(file, head);
      std::vector<std::pair<std::string, JobData>> jobs;
      for (const char* list : {"jobs", "images"}) {
        for (const Json& key : head.at(list)) {
          const std::string name = key.get<std::string>();
          const std::optional<Json> record = store_.record(name);
          if (!record) failInput(fmt::format("{}: its job {} is damaged", file.string(), name));
          jobs.emplace_back(name, linesOf(*record));
        }
      }
      takeReference(head.at("reference").get<std::string>());
      for (const auto& [key, job] : jobs) {
        log.add(key, job);
        noteMachines(job);
      }
      for (const Json& use : head.at("devices")) devices_.insert(use.dump());
      addTo(block, head);
      return true;
    } catch (const Error& error) {
      if (std::string(error.what()).rfind(file.string(), 0) != 0) throw;
      setAside(task, file, error.what());
    } catch (const nlohmann::json::exception& error) {
      setAside(task, file, fmt::format("{}: is damaged: {}", file.string(), error.what()));
    }
    return false;
  }

  // Renames a result that is not sound: whoever looks at names alone must not take it for done.
  void setAside(const Task& task, const fs::path& file, const std::string& why) {
    std::error_code status;
    fs::rename(file, file.string() + ".damaged", status);
    if (!status) ++collected_.setAside;
    logWarning(fmt::format("{}; `restlab work {} --index {}` does it anew", why, folder_.string(),
                           task.index));
  }

  // References by a limit of time are other ones when they are rendered anew.
  void requireSameReference(const Task& task, const Json& head, const fs::path& file) {
    const auto hash = head.at("reference_hash").get<std::string>();
    const auto [first, isFirst] = references_.try_emplace(task.of, hash, task.index);
    if (first->second.first == hash) return;
    failInput(fmt::format("{}: is measured against another reference than task {}", file.string(),
                          first->second.second));
  }

  // Returns the job without its images, which are read once, for the tables.
  static JobData linesOf(const Json& record) {
    JobData job;
    for (const Json& method : record.at("methods"))
      for (JobMethod& own = job.methods.emplace_back(); const Json& line : method.at("lines"))
        own.lines.push_back(line);
    return job;
  }

  // Unpacks beside the jobs, and gives each its name by a rename once it is whole.
  void unpack(const fs::path& file, const Json& head) {
    bool isThere = true;
    for (const char* list : {"jobs", "images"})
      for (const Json& key : head.at(list))
        isThere = isThere && store_.record(key.get<std::string>()).has_value();
    if (isThere) return;
    const fs::path unfinished = out_ / "jobs" / ".unfinished-task";
    std::error_code status;
    fs::remove_all(unfinished, status);
    unpackTask(file, unfinished);
    for (const fs::directory_entry& entry : fs::directory_iterator(unfinished)) {
      const fs::path job = out_ / "jobs" / entry.path().filename();
      fs::remove_all(job, status);
      fs::rename(entry.path(), job, status);
      if (status) failInput(fmt::format("{}: cannot be made: {}", job.string(), status.message()));
    }
    fs::remove_all(unfinished, status);
  }

  void takeReference(const std::string& name) const {
    if (!isElsewhere_ || fs::path(name).is_absolute()) return;
    std::error_code status;
    if (fs::exists(out_ / name, status)) return;
    writeReference(out_ / name, readReference(folder_ / name));
  }

  void noteMachines(const JobData& job) {
    for (const JobMethod& method : job.methods) {
      for (const Json& line : method.lines) {
        const Json machine = line.at("provenance").at("machine");
        if (machine_.is_null()) machine_ = machine;
        const auto add = [&](const char* key, std::vector<std::string>& names) {
          const std::string name = machine.value(key, "");
          if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        };
        add("cpu", processors_);
        add("node", nodes_);
      }
    }
  }

  static void addTo(Json& block, const Json& head) {
    if (block.is_null()) {
      block = {{"jobs", Json::array()}, {"images", Json::array()}, {"warnings", Json::array()}};
      for (const char* key :
           {"point", "scene", "camera", "component", "width", "height", "reference"})
        block[key] = head.at(key);
    }
    for (const char* key : {"jobs", "images"})
      for (const Json& item : head.at(key)) block[key].push_back(item);
    for (const Json& line : head.at("warnings")) {
      Json& lines = block["warnings"];
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
  }

  void writeRecord(Json blocks) {
    Json devices = Json::array();
    for (const std::string& text : devices_) {
      const Json use = Json::parse(text);
      devices.push_back(
          {{"backend", use.at(0)}, {"device", use.at(1)}, {"ray_tracing", use.at(2)}});
    }
    Json machine = machine_.is_null() ? machineJson() : machine_;
    if (!processors_.empty()) machine["cpu"] = fmt::format("{}", fmt::join(processors_, "; "));
    if (!nodes_.empty()) machine["node"] = fmt::format("{}", fmt::join(nodes_, ", "));
    const bool isFinished = collected_.missing.empty();
    const Json record = {
        {"schema", kResultsSchema},
        {"status", isFinished ? "finished"
                              : fmt::format("{} of {} tasks are missing", collected_.missing.size(),
                                            collected_.tasks)},
        {"suite", plan_.suite},
        {"file", plan_.file},
        {"argv", plan_.argv},
        {"methods", plan_.methods},
        {"started", plan_.planned},
        {"written", utcNow()},
        {"plan_id", plan_.id},
        {"build", plan_.build},
        {"machine", machine},
        {"devices", devices},
        {"skipped", plan_.skipped},
        {"plan", std::move(blocks)},
        {"peak_resident_mib", peakResidentMiB()}};
    writeTextFile(out_ / "run.json", jsonWithoutControls(record.dump(2)) + "\n");
  }

  const fs::path& folder_;
  const Plan& plan_;
  const fs::path& out_;
  JobStore store_;
  bool isElsewhere_ = false;
  Collected collected_;
  std::map<size_t, std::pair<std::string, uint64_t>> references_;  // by table: hash, first task
  std::set<std::string> devices_;
  std::vector<std::string> processors_, nodes_;
  Json machine_;
};

}  // namespace

Collected collectResults(const fs::path& folder, const Plan& plan, const fs::path& out) {
  return Collector(folder, plan, out).collect();
}

}  // namespace restlab
