// What a suite says of all of its methods: [settings], [reference], [[mask]] and [[camera_path]].
// All throw Error (badUsage) with the place.
#pragma once

#include "core/config.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Of `max_bounces`.
constexpr int64_t kMaxBouncesOfSuites = 1024;

// One name or several; "cpu" and so on, each once.
std::vector<std::string> readBackends(const ConfigTable& table,
                                      const std::vector<std::string>& fallback);
void readSettings(const ConfigTable& table, Suite& suite);
// The keys that [settings] has: those that readSettings() asks for.
const std::vector<std::string>& settingsKeys();
// The [[camera_path]] that the settings name; "still" needs none.
void chooseCameraPath(const ConfigTable& root, const ConfigTable& settings, Suite& suite);
// Of the scenes, which are read.
void readMasks(const ConfigTable& root, Suite& suite);
void readReference(const ConfigTable& table, Suite& suite);

}  // namespace restlab
