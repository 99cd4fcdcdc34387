// What a suite says of all of its methods: [settings], [reference], [[mask]] and [[camera_path]].
// All throw Error (badUsage) with the place.
#pragma once

#include <set>

#include "core/config.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Of `max_bounces`.
constexpr int64_t kMaxBouncesOfSuites = 1024;
// Of frames and runs.
constexpr int64_t kMaxCount = 1000000;

// One name or several; "cpu" and so on, each once.
std::vector<std::string> readBackends(const ConfigTable& table,
                                      const std::vector<std::string>& fallback);
// `swept`: keys whose values are those of a sweep.
void readSettings(const ConfigTable& table, Suite& suite, const std::set<std::string>& swept = {});
// The keys that [settings] has: those that readSettings() asks for.
const std::vector<std::string>& settingsKeys();
// Every [[camera_path]] and what is switched on it; "still" needs none.
void readPaths(const ConfigTable& root, Suite& suite);
// Makes one of them the suite's; `place`: where it is named, for errors.
void takePath(Suite& suite, const std::string& name, const std::string& place);
// Does it go with what the suite measures?
void checkPath(const ConfigTable& settings, const Suite& suite);
// Of the scenes, which are read.
void readMasks(const ConfigTable& root, Suite& suite);
void readReference(const ConfigTable& table, Suite& suite);

}  // namespace restlab
