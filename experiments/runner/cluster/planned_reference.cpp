#include "experiments/runner/cluster/planned_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "core/base/error.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/reference/reference_chunk.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

std::vector<Task> chunksOf(const Plan& plan, size_t reference) {
  std::vector<Task> tasks;
  for (const TaskGroup& group : plan.groups()) {
    if (!group.isReference || group.of != reference) continue;
    for (uint64_t index = group.firstTask; index < group.endTask(); ++index)
      tasks.push_back(Plan::taskOf(group, index));
  }
  return tasks;
}

// Returns whether there were damaged chunks, which have another name now.
bool setDamagedAside(const fs::path& folder, const Plan& plan, size_t reference,
                     const NeededReference& needed) {
  bool isAny = false;
  for (const Task& task : chunksOf(plan, reference)) {
    const fs::path file = resultFile(folder, plan, task);
    const std::string why = whyNotChunk(needed.scene, needed.config,
                                        {task.first, task.end - task.first}, file, plan.target);
    // A file that cannot be opened may be sound, and seen by other nodes.
    if (why.empty() || !std::ifstream(file)) continue;
    std::error_code status;
    fs::rename(file, file.string() + ".damaged", status);
    if (status) continue;
    logWarning(fmt::format("{}; task {} is to be done anew", why, task.index));
    isAny = true;
  }
  return isAny;
}

}  // namespace

NeededReference neededOf(const std::vector<Suite>& points, const PlannedReference& planned) {
  const Suite& point = points.at(planned.block.point);
  const SuiteScene& scene = point.scenes.at(planned.block.scene);
  const Suite suite = ofScene(point, scene);
  const PreparedScene prepared = prepareScene(scene.request);
  const BlockResult block = blockOf(suite, scene, prepared, planned.block.component);
  return renderedReferences(suite, scene, prepared, block).at(planned.number);
}

std::vector<uint64_t> missingChunks(const fs::path& folder, const Plan& plan, size_t reference) {
  lookAnew(folder / "chunks");
  std::vector<uint64_t> missing;
  for (const Task& task : chunksOf(plan, reference)) {
    std::error_code status;
    if (!fs::exists(resultFile(folder, plan, task), status)) missing.push_back(task.index);
  }
  return missing;
}

std::string notThereText(const Plan& plan, size_t reference, const std::vector<uint64_t>& missing) {
  constexpr size_t kMost = 8;
  std::string numbers;
  for (size_t i = 0; i < std::min(missing.size(), kMost); ++i)
    numbers += (i == 0 ? "" : ", ") + std::to_string(missing[i]);
  if (missing.size() > kMost) numbers += fmt::format(" and {} more", missing.size() - kMost);
  return fmt::format("reference {} is not there; tasks that are not done: {}",
                     plan.references[reference].label, numbers);
}

std::optional<Reference> mergedReference(const fs::path& folder, const Plan& plan, size_t reference,
                                         const NeededReference& needed) {
  std::vector<fs::path> files;
  for (const Task& task : chunksOf(plan, reference))
    files.push_back(resultFile(folder, plan, task));
  ReferenceState state;
  try {
    state = mergeChunks(needed.scene, needed.config, {}, files, plan.target);
  } catch (const Error&) {
    if (!setDamagedAside(folder, plan, reference, needed)) throw;
    return std::nullopt;
  }
  return storeMerged(needed.scene, needed.config, state, folder / "references",
                     plan.references[reference].label);
}

}  // namespace restlab
