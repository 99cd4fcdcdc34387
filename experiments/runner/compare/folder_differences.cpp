#include "experiments/runner/compare/folder_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "experiments/runner/run/job.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

// Keys of a job's identity that are not compared as words: names, what FolderOrigin has, and
// measured values. Seeds and reference get words of their own.
const std::set<std::string> kLeftOut = {"schema",    "results_schema",
                                        "kind",      "point",
                                        "run",       "seed",
                                        "methods",   "name",
                                        "program",   "pixels",
                                        "time_ms",   "source_hash",
                                        "cpu",       "reference_sources",
                                        "devices",   "reference",
                                        "measuring", "compiler",
                                        "flags",     "build_type"};

// Keys whose differences are reported without making the measured quantity another one: names of
// things that hashes and numbers identify beside them, further recorded outputs, seeds and devices.
const std::set<std::string> kNoSettings = {
    "scene_source", "environment", "camera", "camera_index", "figures",  "timing",
    "device",       "bias",        "seeds",  "images",       "reference"};

// Metadata that identify the picture of a reference.
std::vector<std::string> pictureKeys() {
  std::vector<std::string> keys = {"scene_hash",   "camera_to_world", "camera_yfov",
                                   "camera_shift", "camera_mirrored", "width",
                                   "height",       "component"};
  for (const auto& setting : transportTexts({}, true)) keys.push_back(setting.first);
  return keys;
}

constexpr const char* kNoKey = "no key";

std::string textOf(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void addWords(const Json& from, Words& words) {
  constexpr std::string_view kParameter = "parameter.";
  for (const auto& [key, value] : from.items()) {
    if (kLeftOut.count(key) != 0) continue;
    const bool isParameter = key.rfind(kParameter, 0) == 0;
    words[isParameter ? key.substr(kParameter.size()) : key] = textOf(value);
  }
}

// Returns "1-8" or "1, 4, 7".
std::string numbersText(std::vector<int64_t> numbers) {
  std::sort(numbers.begin(), numbers.end());
  const bool isDense =
      numbers.size() > 2 && numbers.back() - numbers.front() + 1 == int64_t(numbers.size());
  if (isDense) return fmt::format("{}-{}", numbers.front(), numbers.back());
  return fmt::format("{}", fmt::join(numbers, ", "));
}

// Includes a hash of the pixels, which decides whether two references are the same.
std::string referenceText(const Reference& reference, const std::string& pixels) {
  const auto key = reference.metadata.find("reference_key");
  return fmt::format("({}, {} spp, pixels {})",
                     key == reference.metadata.end() ? kNoKey : "key " + key->second.substr(0, 8),
                     reference.spp, pixels.substr(0, 8));
}

// Returns whether the difference makes the measured quantity another one. A setting that only one
// program knows is a difference of the programs. References without a key may show anything.
bool isSetting(const std::string& name, const std::string& before, const std::string& after) {
  if (before.empty() || after.empty()) return false;
  if (name == "reference")
    return before.find(kNoKey) != std::string::npos || after.find(kNoKey) != std::string::npos;
  return kNoSettings.count(name) == 0;
}

std::string shown(const std::string& word) { return word.empty() ? "none" : word; }

// `from`: has "build" and "machine".
Words provenanceOf(const Json& from) {
  Words words;
  const auto add = [&](const char* part, std::initializer_list<const char*> names) {
    for (const char* name : names) words[name] = textOf(from.at(part).at(name));
  };
  add("build", {"version", "git_commit", "source_hash", "measuring_hash", "compiler", "flags",
                "build_type", "libraries"});
  add("machine", {"cpu", "cores", "governor", "system"});
  if (from.at("build").at("git_dirty").get<bool>()) words["git_commit"] += " (modified)";
  return words;
}

}  // namespace

FolderOrigin originOf(const ResultsFolder& results) {
  FolderOrigin origin;
  origin.folder = results.folder.string();
  origin.status = results.record.at("status").get<std::string>();
  // Runs kept from an earlier call may be of another build than the last program's.
  std::map<std::string, std::set<std::string>> values;
  const auto add = [&](const Json& from) {
    for (const auto& [name, word] : provenanceOf(from)) values[name].insert(word);
  };
  const JobStore store(results.folder);
  for (const PlannedBlock& block : results.plan) {
    for (const std::string& key : block.jobs) {
      if (const std::optional<Json> job = store.record(key))
        add(job->at("methods").at(0).at("lines").back().at("provenance"));
    }
  }
  if (values.empty()) add(results.record);
  for (const Json& use : results.record.at("devices"))
    values["devices"].insert(textOf(use.at("backend")) + ": " + textOf(use.at("device")));
  for (const auto& [name, all] : values)
    origin.words[name] = fmt::format("{}", fmt::join(all, " and "));
  return origin;
}

std::string originText(const FolderOrigin& origin) {
  const Words& words = origin.words;
  return fmt::format("{}: {}; commit {}, sources {}, {}, {}; {}, {} cores; {}", origin.folder,
                     origin.status, words.at("git_commit"), words.at("source_hash"),
                     words.at("compiler"), shown(words.at("build_type")), words.at("cpu"),
                     words.at("cores"), words.at("devices"));
}

std::vector<std::string> originDifferences(const FolderOrigin& before, const FolderOrigin& after) {
  std::vector<std::string> texts;
  for (const Difference& difference : differencesOf(before.words, after.words))
    texts.push_back(difference.text);
  return texts;
}

std::map<std::string, Words> blockWords(const ResultsFolder& results, const PlannedBlock& block,
                                        const Reference& reference) {
  std::map<std::string, Words> words;
  std::map<std::string, std::vector<int64_t>> seeds;
  const JobStore store(results.folder);
  for (const auto* keys : {&block.jobs, &block.images}) {
    for (const std::string& key : *keys) {
      const std::optional<Json> job = store.record(key);
      if (!job) continue;
      const Json& identity = job->at("identity");
      for (const Json& method : identity.at("methods")) {
        const std::string name = method.at("name").get<std::string>();
        Words& own = words[name];
        addWords(identity, own);
        addWords(method, own);
        own["reference"] = referenceText(reference, identity.at("reference").get<std::string>());
        seeds[name].push_back(identity.at(keys == &block.jobs ? "seed" : "run").get<int64_t>());
      }
    }
  }
  for (auto& [name, own] : words) {
    const bool isImage = own.count("integrator") == 0;
    if (isImage) {
      own["images"] = std::to_string(seeds[name].size());
    } else {
      own["seeds"] = numbersText(seeds[name]);
    }
    for (const std::string& word : pictureKeys()) {
      const std::optional<std::string> found = pictureWord(reference.metadata, word);
      if (found) own.emplace(word, *found);
    }
  }
  return words;
}

std::vector<Difference> differencesOf(const Words& before, const Words& after) {
  std::set<std::string> names;
  for (const Words* words : {&before, &after}) {
    for (const auto& [name, word] : *words) names.insert(name);
  }
  std::vector<Difference> differences;
  for (const std::string& name : names) {
    const auto a = before.find(name), b = after.find(name);
    const std::string was = a == before.end() ? "" : a->second;
    const std::string is = b == after.end() ? "" : b->second;
    if (was == is) continue;
    differences.push_back(
        {fmt::format("{} {} / {}", name, shown(was), shown(is)), isSetting(name, was, is)});
  }
  return differences;
}

}  // namespace restlab
