#include "experiments/runner/cluster/submissions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/control_characters.h"
#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "experiments/runner/cluster/tasks_there.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

fs::path submissionsFile(const fs::path& folder) { return folder / "submissions.json"; }

// Returns the numbers of "0-3,7".
std::vector<uint64_t> numbersOf(const std::string& ranges) {
  std::vector<uint64_t> numbers;
  const char* at = ranges.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    const uint64_t first = std::strtoull(at, &end, 10);
    uint64_t last = first;
    if (*end == '-') last = std::strtoull(end + 1, &end, 10);
    if (end == at || (*end != ',' && *end != '\0')) failInput("has ranges that are none");
    for (uint64_t number = first; number <= last; ++number) numbers.push_back(number);
    at = *end == ',' ? end + 1 : end;
  }
  return numbers;
}

}  // namespace

const Submission* Submissions::last(uint64_t task) const {
  for (auto one = all.rbegin(); one != all.rend() && one->round == round(); ++one)
    if (std::binary_search(one->tasks.begin(), one->tasks.end(), task)) return &*one;
  return nullptr;
}

int Submissions::attempts(uint64_t task) const {
  return int(std::count_if(all.begin(), all.end(), [&](const Submission& one) {
    return one.round == round() && std::binary_search(one.tasks.begin(), one.tasks.end(), task);
  }));
}

bool Submissions::isOfRound(const Mark& mark, uint64_t task) const {
  const std::string job = mark.job.substr(0, mark.job.find('_'));
  return std::any_of(all.begin(), all.end(), [&](const Submission& one) {
    if (one.round != round() || !std::binary_search(one.tasks.begin(), one.tasks.end(), task))
      return false;
    // Processes here have no ids, but one clock.
    return one.id.empty() ? mark.started >= one.written : one.id == job;
  });
}

Submissions readSubmissions(const fs::path& folder) {
  Submissions submissions;
  std::ifstream in(submissionsFile(folder), std::ios::binary);
  if (!in) return submissions;
  try {
    const Json json = Json::parse(in);
    submissions.engine = json.at("engine").get<std::string>();
    submissions.options = json.at("options").get<std::string>();
    submissions.collected = json.at("collected").get<uint64_t>();
    for (const Json& one : json.at("submissions")) {
      submissions.all.push_back(
          {one.at("id").get<std::string>(),
           numbersOf(one.at("tasks").get<std::string>()),
           {one.at("asked_s").get<double>(), one.at("asked_mib").get<double>()},
           one.at("round").get<uint64_t>(),
           one.at("written").get<std::string>()});
    }
  } catch (const std::exception& error) {
    failInput(fmt::format("{}: {}", submissionsFile(folder).string(), error.what()));
  }
  return submissions;
}

void writeSubmissions(const fs::path& folder, const Submissions& submissions) {
  Json all = Json::array();
  for (const Submission& one : submissions.all) {
    all.push_back({{"id", one.id},
                   {"tasks", rangesText(one.tasks)},
                   {"asked_s", one.asked.seconds},
                   {"asked_mib", one.asked.memoryMiB},
                   {"round", one.round},
                   {"written", one.written}});
  }
  const Json json = {{"engine", submissions.engine},
                     {"options", submissions.options},
                     {"collected", submissions.collected},
                     {"submissions", std::move(all)}};
  writeTextFile(submissionsFile(folder), jsonWithoutControls(json.dump(1)) + "\n");
}

}  // namespace restlab
