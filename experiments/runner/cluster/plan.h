// A plan: a suite cut into tasks that any machine can do by their number (plan.json in a folder
// that all of them see). It grows with the number of tables, not with that of runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/runner/reference/reference_chunk.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// A table's place in the suite.
struct BlockPlace {
  size_t scene = 0, point = 0;  // indices after --scenes
  uint32_t component = 0;
};

// A reference that is to be rendered. Blocks with the same key share it.
struct PlannedReference {
  BlockPlace block;   // the first block that needs it
  size_t number = 0;  // of renderedReferences() of that block
  std::string key, label;
  bool isWhole = false;  // by one task: it ends by time, or its samples have a history
  double sampleS = 0.0;  // seconds of a sample per pixel; 0: not measured
  uint64_t pixels = 0;
};

struct PlannedTable {
  BlockPlace block;
  std::string label;
  std::string referenceHash;  // of the pixels of a file that the suite names; "" without one
  uint32_t runs = 0;
  std::vector<size_t> references;  // indices of those to be rendered
  double runS = 0.0;               // seconds of a run; 0: not measured
  double memoryMiB = 0.0;          // buffers of its methods
};

// Consecutive tasks of one kind.
struct TaskGroup {
  bool isReference = false;
  size_t of = 0;  // index of the reference or the table
  // Samples per pixel of a reference, or runs of a table. The last task may have fewer.
  uint64_t first = 0, end = 0, each = 1;
  uint64_t firstTask = 0;  // index of its first task; set by Plan::add()
  uint64_t tasks() const { return (end - first + each - 1) / each; }
  uint64_t endTask() const { return firstTask + tasks(); }
};

// One task: a chunk of a reference, or some runs of a table.
struct Task {
  uint64_t index = 0;
  bool isReference = false;
  size_t of = 0;
  uint64_t first = 0, end = 0;
};

struct Plan {
  std::string id;  // of suite, selection, sources and chunks; results of another plan are refused
  std::string suiteHash;         // of the text of suite.toml beside it
  nlohmann::ordered_json build;  // buildJson() of the program that planned
  std::string suite, file, suiteFolder, workingFolder, planned;
  std::vector<std::string> argv, scenes, methods, skipped;
  int threads = 0;
  uint64_t sppOfChunk = 0;   // samples per pixel of a chunk, as asked for; 0: nothing was
  double residentMiB = 0.0;  // of the planning program: scenes and kernels
  ReferenceTarget target;
  std::vector<DeviceUse> devices;  // of the methods, where it was planned
  std::vector<PlannedReference> references;
  std::vector<PlannedTable> tables;
  // Files outside the folder and the labels that they get in it; not written to plan.json.
  std::vector<std::pair<std::filesystem::path, std::string>> found;

  // Groups of tasks: references first; chunks that were added later stand at the end.
  const std::vector<TaskGroup>& groups() const { return groups_; }
  // Adds a group behind all others, so that tasks keep their indices.
  void add(TaskGroup group);
  uint64_t tasks() const { return groups_.empty() ? 0 : groups_.back().endTask(); }
  // Throws Error (badUsage) that names the last index if there is no such task.
  Task task(uint64_t index) const;
  // `index`: of a task of the group.
  static Task taskOf(const TaskGroup& group, uint64_t index);
  // Returns "runs 4 to 7 of cornell-box-all".
  std::string describe(const Task& task) const;

 private:
  std::vector<TaskGroup> groups_;
};

// Files of a plan's folder.
std::filesystem::path planFile(const std::filesystem::path& folder);
bool isPlanFolder(const std::filesystem::path& folder);
// Returns the file that holds the result of a task.
std::filesystem::path resultFile(const std::filesystem::path& folder, const Plan& plan,
                                 const Task& task);
// Returns the mark of a task at work. It stays if the worker ends without a result.
std::filesystem::path markFile(const std::filesystem::path& folder, uint64_t index);
std::filesystem::path referenceFileOf(const std::filesystem::path& folder,
                                      const std::string& label);

// Opens a folder and closes it: a network file system then asks its server for the names in it,
// where it would otherwise say for a minute that a new file is not there.
void lookAnew(const std::filesystem::path& folder);

// Returns the line about a suite's own reference whose pixels are not those of the plan.
std::string changedReferenceText(const std::filesystem::path& file);

// Returns whether the reference is in the folder and needs no more chunks.
bool isThere(const std::filesystem::path& folder, const Plan& plan,
             const PlannedReference& reference);

void writePlan(const std::filesystem::path& folder, const Plan& plan);
// Throws Error (badInput) naming the file: absent, damaged, or of another version or other sources
// of the program (both are named).
Plan readPlan(const std::filesystem::path& folder);

// Returns the plan's suites, from suite.toml in the folder: only its scenes and methods, with names
// of files as in the folder where it was planned. Enters that folder if it exists.
std::vector<Suite> openPlan(const std::filesystem::path& folder, const Plan& plan);

}  // namespace restlab
