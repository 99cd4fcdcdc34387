// Reads what a suite sets for all methods: [settings], [reference], [[mask]] and [[camera_path]].
// All functions throw Error (badUsage) with the place.
#pragma once

#include <set>

#include "core/base/config.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Limit of frames and runs.
constexpr int64_t kMaxCount = 1000000;

// Reads one name or several: "cpu" and so on, each once.
std::vector<std::string> readBackends(const ConfigTable& table,
                                      const std::vector<std::string>& fallback);
// Reads the given ones of transportSchema().
ParameterMap readTransport(const ConfigTable& table);
// `swept`: keys with swept values.
void readSettings(const ConfigTable& table, Suite& suite, const std::set<std::string>& swept = {});
// Returns the known keys of [settings].
const std::vector<std::string>& settingsKeys();
// Reads every [[camera_path]] and its events; "still" needs no table.
void readPaths(const ConfigTable& root, Suite& suite);
// Selects a path for the suite. `place`: where it is named, for errors.
void takePath(Suite& suite, const std::string& name, const std::string& place);
// Throws if the path conflicts with what the suite measures.
void checkPath(const ConfigTable& settings, const Suite& suite);
// Requires that the scenes have been read.
void readMasks(const ConfigTable& root, Suite& suite);
void readReference(const ConfigTable& table, Suite& suite);

}  // namespace restlab
