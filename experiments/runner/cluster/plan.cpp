#include "experiments/runner/cluster/plan.h"

#include <dirent.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/base/control_characters.h"
#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "core/image/io/atomic_file.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/suite/prepare.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr int kPlanSchema = 1;

Json placeJson(const BlockPlace& place) { return {place.scene, place.point, place.component}; }

BlockPlace placeOf(const Json& json) {
  return {json.at(0).get<size_t>(), json.at(1).get<size_t>(), json.at(2).get<uint32_t>()};
}

Json referencesJson(const Plan& plan) {
  Json all = Json::array();
  for (const PlannedReference& reference : plan.references) {
    all.push_back({{"block", placeJson(reference.block)},
                   {"number", reference.number},
                   {"key", reference.key},
                   {"label", reference.label},
                   {"whole", reference.isWhole},
                   {"sample_s", reference.sampleS},
                   {"pixels", reference.pixels}});
  }
  return all;
}

Json tablesJson(const Plan& plan) {
  Json all = Json::array();
  for (const PlannedTable& table : plan.tables) {
    all.push_back({{"block", placeJson(table.block)},
                   {"label", table.label},
                   {"reference_hash", table.referenceHash},
                   {"runs", table.runs},
                   {"references", table.references},
                   {"run_s", table.runS},
                   {"memory_mib", table.memoryMiB}});
  }
  return all;
}

Json groupsJson(const Plan& plan) {
  Json all = Json::array();
  for (const TaskGroup& group : plan.groups()) {
    all.push_back({{"kind", group.isReference ? "reference" : "runs"},
                   {"of", group.of},
                   {"first", group.first},
                   {"end", group.end},
                   {"each", group.each}});
  }
  return all;
}

Plan planOfJson(const Json& json) {
  Plan plan;
  plan.id = json.at("id").get<std::string>();
  plan.suiteHash = json.at("suite_hash").get<std::string>();
  plan.suite = json.at("suite").get<std::string>();
  plan.file = json.at("file").get<std::string>();
  plan.suiteFolder = json.at("suite_folder").get<std::string>();
  plan.workingFolder = json.at("working_folder").get<std::string>();
  plan.planned = json.at("planned").get<std::string>();
  plan.argv = json.at("argv").get<std::vector<std::string>>();
  plan.scenes = json.at("scenes").get<std::vector<std::string>>();
  plan.methods = json.at("methods").get<std::vector<std::string>>();
  plan.skipped = json.at("skipped").get<std::vector<std::string>>();
  plan.threads = json.at("threads").get<int>();
  plan.sppOfChunk = json.at("chunk_spp").get<uint64_t>();
  plan.residentMiB = json.at("resident_mib").get<double>();
  plan.target = {json.at("target").at("spp").get<uint64_t>(),
                 json.at("target").at("relmse").get<double>(),
                 json.at("target").at("time_limit_s").get<double>()};
  for (const Json& use : json.at("devices")) {
    plan.devices.push_back(
        {use.at(0).get<std::string>(), use.at(1).get<std::string>(), use.at(2).get<std::string>()});
  }
  for (const Json& one : json.at("references")) {
    plan.references.push_back({placeOf(one.at("block")), one.at("number").get<size_t>(),
                               one.at("key").get<std::string>(), one.at("label").get<std::string>(),
                               one.at("whole").get<bool>(), one.at("sample_s").get<double>(),
                               one.at("pixels").get<uint64_t>()});
  }
  for (const Json& one : json.at("tables")) {
    plan.tables.push_back({placeOf(one.at("block")), one.at("label").get<std::string>(),
                           one.at("reference_hash").get<std::string>(),
                           one.at("runs").get<uint32_t>(),
                           one.at("references").get<std::vector<size_t>>(),
                           one.at("run_s").get<double>(), one.at("memory_mib").get<double>()});
  }
  for (const Json& one : json.at("groups")) {
    TaskGroup group{one.at("kind").get<std::string>() == "reference", one.at("of").get<size_t>(),
                    one.at("first").get<uint64_t>(), one.at("end").get<uint64_t>(),
                    one.at("each").get<uint64_t>()};
    const size_t count = group.isReference ? plan.references.size() : plan.tables.size();
    if (group.of >= count || group.each == 0 || group.end <= group.first)
      failInput("its groups of tasks are wrong");
    plan.add(group);
  }
  for (const PlannedTable& table : plan.tables) {
    for (const size_t reference : table.references)
      if (reference >= plan.references.size()) failInput("its references are wrong");
  }
  return plan;
}

std::string versionOf(const Json& build) {
  return fmt::format("{} (commit {}, sources {}, measuring {})",
                     build.at("version").get<std::string>(),
                     build.at("git_commit").get<std::string>(),
                     build.at("source_hash").get<std::string>().substr(0, 8),
                     build.at("measuring_hash").get<std::string>().substr(0, 8));
}

void requireOwnVersion(const fs::path& file, const Json& planned) {
  const Json own = buildJson();
  for (const char* what : {"version", "source_hash", "measuring_hash"}) {
    if (planned.at(what) == own.at(what)) continue;
    failInput(fmt::format(
        "{}: was made by restlab {}, this program is {}: plan into another folder, or use the "
        "program that planned",
        file.string(), versionOf(planned), versionOf(own)));
  }
}

template <class Item, class Names>
void keepListed(std::vector<Item>& items, const Names& names) {
  std::erase_if(items, [&](const Item& item) {
    return std::find(names.begin(), names.end(), item.name) == names.end();
  });
}

}  // namespace

void Plan::add(TaskGroup group) {
  group.firstTask = tasks();
  groups_.push_back(group);
}

Task Plan::taskOf(const TaskGroup& group, uint64_t index) {
  const uint64_t first = group.first + (index - group.firstTask) * group.each;
  return {index, group.isReference, group.of, first, std::min(first + group.each, group.end)};
}

Task Plan::task(uint64_t index) const {
  const auto group = std::upper_bound(
      groups_.begin(), groups_.end(), index,
      [](uint64_t wanted, const TaskGroup& one) { return wanted < one.endTask(); });
  if (group != groups_.end()) return taskOf(*group, index);
  failUsage(groups_.empty()
                ? fmt::format("--index {}: the plan has no task", index)
                : fmt::format("--index {}: the plan has tasks 0 to {}", index, tasks() - 1));
}

std::string Plan::describe(const Task& task) const {
  if (task.isReference) {
    const PlannedReference& reference = references[task.of];
    if (reference.isWhole) return fmt::format("reference {}", reference.label);
    return fmt::format("samples {} to {} of reference {}", task.first, task.end - 1,
                       reference.label);
  }
  const std::string& label = tables[task.of].label;
  if (task.end == task.first + 1) return fmt::format("run {} of {}", task.first, label);
  return fmt::format("runs {} to {} of {}", task.first, task.end - 1, label);
}

fs::path planFile(const fs::path& folder) { return folder / "plan.json"; }

bool isPlanFolder(const fs::path& folder) {
  std::error_code status;
  return fs::is_regular_file(planFile(folder), status);
}

fs::path referenceFileOf(const fs::path& folder, const std::string& label) {
  return folder / "references" / (safeFileName(label) + ".exr");
}

fs::path resultFile(const fs::path& folder, const Plan& plan, const Task& task) {
  if (!task.isReference) return folder / "done" / fmt::format("{:06}.tar", task.index);
  const PlannedReference& reference = plan.references[task.of];
  if (reference.isWhole) return referenceFileOf(folder, reference.label);
  return folder / "chunks" / fmt::format("{}-{:010}{}", reference.key, task.first, kChunkExtension);
}

fs::path markFile(const fs::path& folder, uint64_t index) {
  return folder / "at-work" / fmt::format("{:06}.json", index);
}

void lookAnew(const fs::path& folder) {
  if (DIR* opened = opendir(folder.c_str())) closedir(opened);
}

std::string changedReferenceText(const fs::path& file) {
  return fmt::format(
      "{}: is not the reference that was planned with: its pixels have changed; put the file back, "
      "or plan into another folder",
      file.string());
}

bool isThere(const fs::path& folder, const Plan& plan, const PlannedReference& reference) {
  lookAnew(folder / "references");
  const StoredReference stored =
      readStored(referenceFileOf(folder, reference.label), reference.key);
  return stored.reference && meetsTarget(*stored.reference, plan.target);
}

void writePlan(const fs::path& folder, const Plan& plan) {
  Json devices = Json::array();
  for (const DeviceUse& use : plan.devices)
    devices.push_back({use.backend, use.device, use.rayTracing});
  const Json json = {{"schema", kPlanSchema},
                     {"id", plan.id},
                     {"suite_hash", plan.suiteHash},
                     {"suite", plan.suite},
                     {"file", plan.file},
                     {"suite_folder", plan.suiteFolder},
                     {"working_folder", plan.workingFolder},
                     {"planned", plan.planned},
                     {"argv", plan.argv},
                     {"build", plan.build},
                     {"threads", plan.threads},
                     {"chunk_spp", plan.sppOfChunk},
                     {"resident_mib", plan.residentMiB},
                     {"target",
                      {{"spp", plan.target.spp},
                       {"relmse", plan.target.relmse},
                       {"time_limit_s", plan.target.timeLimitS}}},
                     {"devices", devices},
                     {"scenes", plan.scenes},
                     {"methods", plan.methods},
                     {"skipped", plan.skipped},
                     {"tasks", plan.tasks()},
                     {"references", referencesJson(plan)},
                     {"tables", tablesJson(plan)},
                     {"groups", groupsJson(plan)}};
  writeTextFile(planFile(folder), jsonWithoutControls(json.dump(1)) + "\n");
}

Plan readPlan(const fs::path& folder) {
  const fs::path file = planFile(folder);
  lookAnew(folder);
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    failInput(fmt::format("{}: {}; `restlab plan SUITE -o {}` makes one", file.string(),
                          unreadableReason(file), folder.string()));
  }
  Json json;
  try {
    json = Json::parse(in);
    if (json.at("schema").get<int>() != kPlanSchema)
      failInput(fmt::format("has schema {}, this program reads {}", json.at("schema").dump(),
                            kPlanSchema));
    requireOwnVersion(file, json.at("build"));
  } catch (const Error& error) {
    const std::string text = error.what();
    throw Error(error.code(),
                text.rfind(file.string(), 0) == 0 ? text : file.string() + ": " + text);
  } catch (const std::exception& error) {
    failInput(fmt::format("{}: {}", file.string(), error.what()));
  }
  try {
    Plan plan = planOfJson(json);
    plan.build = json.at("build");
    return plan;
  } catch (const std::exception& error) {
    failInput(fmt::format("{}: {}", file.string(), error.what()));
  }
}

std::vector<Suite> openPlan(const fs::path& folder, const Plan& plan) {
  const fs::path file = fs::absolute(folder) / "suite.toml";
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  if (hexHash(XXH3_64bits(text.str().data(), text.str().size())) != plan.suiteHash) {
    failInput(
        fmt::format("{}: was changed since this was planned, or cannot be read; plan the changed "
                    "suite into another folder",
                    file.string()));
  }
  std::error_code status;
  if (fs::is_directory(plan.workingFolder, status)) fs::current_path(plan.workingFolder, status);
  std::vector<Suite> points = loadSuites(file, {}, {});
  for (Suite& suite : points) {
    keepListed(suite.scenes, plan.scenes);
    keepListed(suite.methods, plan.methods);
    suite.threads = plan.threads;
    for (SuiteScene& scene : suite.scenes) scene.request.suiteFolder = plan.suiteFolder;
    for (SuiteMethod& method : suite.methods)
      if (method.images) method.images->folder = plan.suiteFolder;
    if (suite.scenes.size() != plan.scenes.size() || suite.methods.size() != plan.methods.size())
      failInput(fmt::format("{}: is not the suite of plan.json beside it", file.string()));
  }
  for (const PlannedTable& table : plan.tables) {
    if (table.block.scene >= points.front().scenes.size() || table.block.point >= points.size())
      failInput(fmt::format("{}: is not the suite of plan.json beside it", file.string()));
  }
  return points;
}

}  // namespace restlab
