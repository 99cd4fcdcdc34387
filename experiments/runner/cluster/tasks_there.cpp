#include "experiments/runner/cluster/tasks_there.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/image/io/atomic_file.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

std::set<std::string> namesIn(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code status;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, status))
    names.insert(entry.path().filename().string());
  return names;
}

}  // namespace

uint64_t TasksThere::done() const {
  return uint64_t(std::count(isDone.begin(), isDone.end(), true));
}

std::vector<uint64_t> TasksThere::missing() const {
  std::vector<uint64_t> numbers;
  for (uint64_t index = 0; index < isDone.size(); ++index)
    if (!isDone[index]) numbers.push_back(index);
  return numbers;
}

TasksThere tasksThere(const fs::path& folder, const Plan& plan) {
  // A folder is listed once: to ask for each of 10^5 files takes a network file system minutes.
  std::map<fs::path, std::set<std::string>> names;
  for (const char* name : {"done", "chunks", "references", "at-work"})
    names[folder / name] = namesIn(folder / name);
  const auto isThereFile = [&](const fs::path& file) {
    return names[file.parent_path()].count(file.filename().string()) != 0;
  };
  TasksThere there;
  there.isDone.reserve(plan.tasks());
  for (const TaskGroup& group : plan.groups()) {
    std::optional<bool> isMerged;  // asked for once: the file has to be read
    for (uint64_t index = group.firstTask; index < group.endTask(); ++index) {
      const Task task = Plan::taskOf(group, index);
      // A whole reference may be there and not be good enough, or damaged.
      const bool isWhole = group.isReference && plan.references[group.of].isWhole;
      bool isDone = !isWhole && isThereFile(resultFile(folder, plan, task));
      if (!isDone && group.isReference) {
        if (!isMerged) isMerged = isThere(folder, plan, plan.references[group.of]);
        isDone = *isMerged;
      }
      there.isDone.push_back(isDone);
      if (isDone || !isThereFile(markFile(folder, index))) continue;
      if (const std::optional<Mark> mark = readMark(folder, index))
        there.marks.emplace(index, *mark);
    }
  }
  return there;
}

void removeLeftovers(const fs::path& folder, const Plan& plan, const TasksThere& there) {
  std::set<std::string> leftovers;
  for (const char* name : {"done", "chunks", "references", "at-work"})
    for (const std::string& file : namesIn(folder / name))
      if (file.find(kTemporary) != std::string::npos)
        leftovers.insert((folder / name / file).string());
  if (leftovers.empty()) return;
  const auto remove = [&](const fs::path& of) {
    const std::string beginning = of.string() + kTemporary;
    for (auto one = leftovers.lower_bound(beginning);
         one != leftovers.end() && one->rfind(beginning, 0) == 0; ++one) {
      std::error_code ignored;
      fs::remove(*one, ignored);
    }
  };
  const std::set<std::string> atWork = namesIn(folder / "at-work");
  for (const TaskGroup& group : plan.groups()) {
    for (uint64_t index = group.firstTask; index < group.endTask(); ++index) {
      const fs::path mark = markFile(folder, index);
      if (!there.isDone[index] || atWork.count(mark.filename().string()) != 0) continue;
      remove(mark);
      remove(resultFile(folder, plan, Plan::taskOf(group, index)));
    }
  }
}

std::string rangesText(const std::vector<uint64_t>& numbers) {
  std::string text;
  for (size_t i = 0; i < numbers.size();) {
    size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += text.empty() ? "" : ",";
    text +=
        last == i ? std::to_string(numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[last]);
    i = last + 1;
  }
  return text;
}

}  // namespace restlab
