#include "experiments/runner/cluster/make_plan.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <map>

#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/cluster/asked.h"
#include "experiments/runner/results/measured_cost.h"
#include "experiments/runner/run/block.h"
#include "experiments/runner/run/block_label.h"
#include "experiments/runner/run/job.h"
#include "experiments/runner/run/suite_check.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// Returns the file of the folder or of the user's cache that has the reference, good enough; ""
// without one.
fs::path storedReference(const fs::path& folder, const Suite& suite, const NeededReference& needed,
                         const std::string& key) {
  std::vector<fs::path> files = {referenceFileOf(folder, needed.label)};
  if (const fs::path cache = referenceCacheFolder(); !cache.empty())
    files.push_back(cache / (key + ".exr"));
  for (const fs::path& file : files) {
    const StoredReference stored = readStored(file, key);
    if (stored.reference && meetsTarget(*stored.reference, suite.target)) return file;
  }
  return {};
}

class Planner {
 public:
  Planner(const std::vector<Suite>& points, const PlanRequest& request)
      : points_(points), request_(request) {}

  Plan make() {
    const std::vector<SuiteCheck> checks = checkSuites(points_);
    const Suite& front = points_.front();
    describe(front);
    for (const SuiteCheck& found : checks) {
      for (const DeviceUse& use : found.devices) {
        if (std::find(plan_.devices.begin(), plan_.devices.end(), use) == plan_.devices.end())
          plan_.devices.push_back(use);
      }
    }
    for (size_t s = 0; s < front.scenes.size(); ++s) {
      std::string missing;
      if (front.scenes[s].optional && assetsMissing(front.scenes[s].request, missing)) {
        plan_.skipped.push_back(
            fmt::format("skipped {}: {} is not here", front.scenes[s].name, missing));
        continue;
      }
      const PreparedScene prepared =
          checks.front().only ? *checks.front().only : prepareScene(front.scenes[s].request);
      for (size_t p = 0; p < points_.size(); ++p) addTables(s, p, prepared);
    }
    plan_.residentMiB = request_.measures ? peakResidentMiB() : 0.0;
    makeGroups();
    const std::string& suite = points_.front().resolved;
    plan_.suiteHash = hexHash(XXH3_64bits(suite.data(), suite.size()));
    plan_.id = idOf();
    return std::move(plan_);
  }

 private:
  void describe(const Suite& suite) {
    plan_.build = buildJson();
    plan_.suite = suite.name;
    plan_.file = suite.file;
    plan_.suiteFolder = fs::absolute(fs::path(suite.file)).parent_path().string();
    plan_.workingFolder = fs::current_path().string();
    plan_.planned = utcNow();
    plan_.argv = request_.argv;
    plan_.threads = suite.threads;
    plan_.target = suite.target;
    plan_.sppOfChunk = request_.sppOfChunk;
    for (const SuiteScene& scene : suite.scenes) plan_.scenes.push_back(scene.name);
    for (const SuiteMethod& method : suite.methods) plan_.methods.push_back(method.name);
  }

  void addTables(size_t s, size_t p, const PreparedScene& prepared) {
    const SuiteScene& scene = points_[p].scenes[s];
    const Suite suite = ofScene(points_[p], scene);
    for (const uint32_t component : suite.components) {
      throwIfInterrupted("nothing was written");
      BlockResult block = blockOf(suite, scene, prepared, component);
      PlannedTable table;
      table.block = {s, p, component};
      table.label = blockLabel(suite, block);
      if (!scene.reference.empty())
        table.referenceHash = referenceHash(readReference(referenceFileNamed(scene)));
      table.runs = suite.runs;
      const std::vector<NeededReference> needed = renderedReferences(suite, scene, prepared, block);
      for (size_t number = 0; number < needed.size(); ++number) {
        const std::optional<size_t> index =
            referenceIndex(suite, table.block, number, needed[number], prepared, block);
        if (index) table.references.push_back(*index);
      }
      if (request_.measures) {
        const MeasuredCost cost = measureRun(suite, prepared, block);
        table.runS = cost.runS;
        table.memoryMiB = double(block.width) * block.height * double(cost.bytesPerPixel) / kMiB;
      }
      plan_.tables.push_back(std::move(table));
    }
  }

  // Returns the reference's place in the plan; nothing if it is there already.
  std::optional<size_t> referenceIndex(const Suite& suite, const BlockPlace& place, size_t number,
                                       const NeededReference& needed, const PreparedScene& prepared,
                                       const BlockResult& block) {
    const std::string key = referenceKey(needed.scene, needed.config);
    const auto [known, isNew] = byKey_.try_emplace(key);
    if (isNew) known->second.file = storedReference(request_.out, suite, needed, key);
    if (!known->second.file.empty()) {
      plan_.found.emplace_back(known->second.file, needed.label);
      return std::nullopt;
    }
    if (!isNew) return known->second.index;
    PlannedReference reference;
    reference.block = place;
    reference.number = number;
    reference.key = key;
    reference.label = needed.label;
    // Samples of a method with a history depend on one another.
    reference.isWhole = suite.target.timeLimitS > 0.0 || !suite.referenceMethod.empty();
    reference.pixels = uint64_t(block.width) * block.height;
    if (request_.measures) reference.sampleS = secondsOfSample(suite, prepared, block);
    known->second.index = plan_.references.size();
    plan_.references.push_back(std::move(reference));
    return known->second.index;
  }

  void makeGroups() {
    for (size_t r = 0; r < plan_.references.size(); ++r) {
      TaskGroup group{true, r, 0, 1, 1};
      if (!plan_.references[r].isWhole) {
        const ReferenceTarget& target = plan_.target;
        // Some to begin with, where the error decides: later ones are added to the plan.
        group.end = target.relmse > 0.0 ? kBlockSpp : target.spp;
        if (target.relmse > 0.0 && target.spp > 0) group.end = std::min(group.end, target.spp);
        group.each = sppOfChunk(group.end, request_.sppOfChunk);
      }
      plan_.add(group);
    }
    for (size_t t = 0; t < plan_.tables.size(); ++t)
      plan_.add({false, t, 0, plan_.tables[t].runs, request_.runsOfTask});
  }

  // Returns a hash of what results depend on, besides keys of their own.
  std::string idOf() const {
    nlohmann::ordered_json words = {
        points_.front().resolved, plan_.scenes,       plan_.methods, plan_.threads,
        request_.runsOfTask,      request_.sppOfChunk};
    for (const char* what : {"version", "source_hash", "measuring_hash"})
      words.push_back(plan_.build.at(what));
    for (const PlannedTable& table : plan_.tables)
      if (!table.referenceHash.empty()) words.push_back(table.referenceHash);
    const std::string text = words.dump();
    return hexHash(XXH3_64bits(text.data(), text.size()));
  }

  const std::vector<Suite>& points_;
  const PlanRequest& request_;
  Plan plan_;
  // Where a reference is: a file, or one of the plan.
  struct Known {
    fs::path file;
    size_t index = 0;
  };
  std::map<std::string, Known> byKey_;
};

std::string durationText(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace

uint64_t sppOfChunk(uint64_t spp, uint64_t wanted) {
  if (wanted == 0) wanted = (spp + kMostChunks - 1) / kMostChunks;
  return std::max<uint64_t>(1, (wanted + kBlockSpp - 1) / kBlockSpp) * kBlockSpp;
}

Plan makePlan(const std::vector<Suite>& points, const PlanRequest& request) {
  return Planner(points, request).make();
}

void savePlan(const std::vector<Suite>& points, const PlanRequest& request, const Plan& plan) {
  const fs::path& out = request.out;
  for (const char* folder : {"", "references", "chunks", "done", "at-work"})
    makeWritableDirectory(out / folder);
  if (isPlanFolder(out)) {
    const Plan there = readPlan(out);
    if (there.id != plan.id) {
      failInput(fmt::format(
          "{}: is the plan of another suite, selection or division into tasks (planned {}); choose "
          "another folder with -o, or remove this one",
          planFile(out).string(), there.planned));
    }
    logInfo(fmt::format("{}: has this plan already, of {}", out.string(), there.planned));
    return;
  }
  std::error_code status;
  for (const char* folder : {"done", "chunks", "at-work"}) {
    if (!fs::is_empty(out / folder, status)) {
      failInput(fmt::format(
          "{}: holds results of a plan that is gone; remove the folder {}, or choose another one "
          "with -o",
          (out / folder).string(), out.string()));
    }
  }
  if (fs::exists(out / "run.json", status)) {
    failInput(
        fmt::format("{}: is a folder of results of `run`; choose another one for the plan with -o",
                    out.string()));
  }
  for (const auto& [file, label] : plan.found) {
    const fs::path own = referenceFileOf(out, label);
    if (own != file) writeReference(own, readReference(file));
  }
  writeTextFile(out / "suite.toml", points.front().resolved);
  writePlan(out, plan);  // last: a folder with it is complete
}

std::string planTable(const Plan& plan) {
  std::string lines;
  double allS = 0.0, mostMiB = 0.0;
  uint64_t chunks = 0;
  bool isKnown = true;
  for (const TaskGroup& group : plan.groups()) {
    const Task task = Plan::taskOf(group, group.firstTask);
    const Asked asked = estimateOf(plan, task);
    const double groupS = asked.seconds * double(group.end - group.first) /
                          double(std::max<uint64_t>(1, task.end - task.first));
    if (group.isReference) chunks += group.tasks();
    isKnown = isKnown && asked.seconds > 0.0;
    allS += groupS;
    mostMiB = std::max(mostMiB, asked.memoryMiB);
    const std::string& label =
        group.isReference ? plan.references[group.of].label : plan.tables[group.of].label;
    lines += fmt::format(
        "| {} {} | {} | {} | {} |\n", group.isReference ? "reference" : "runs of", label,
        group.tasks(), asked.seconds > 0.0 ? durationText(asked.seconds) : "not measured",
        asked.memoryMiB > 0.0 ? fmt::format("{:.0f} MiB", asked.memoryMiB) : "not measured");
  }
  std::string text = "| stage | tasks | time of a task | memory of a task |\n|---|---|---|---|\n" +
                     lines +
                     fmt::format("\n{}: {} of references, then {}", counted(plan.tasks(), "task"),
                                 chunks, counted(plan.tasks() - chunks, "task") + " of runs");
  if (isKnown)
    text += fmt::format("; {:.3g} node hours, at most {:.0f} MiB", allS / 3600.0, mostMiB);
  text += ".\n";
  if (plan.target.relmse > 0.0 && chunks > 0)
    text += "References are to reach a relmse: the chunks that this takes are added later.\n";
  for (const std::string& line : plan.skipped) text += line + "\n";
  return text;
}

}  // namespace restlab
