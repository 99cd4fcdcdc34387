#include "experiments/runner/suite/suite_overrides.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "experiments/runner/suite/sweep.h"

namespace restlab {

namespace {

bool startsWith(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

// Applies method.KEY or method.NAME.KEY.
void overrideMethods(const ConfigTable& root, const std::string& key, const std::string& value,
                     const std::string& place) {
  std::string wanted, leaf;
  splitMethodKey(key, wanted, leaf);
  bool used = false;
  std::vector<std::string> names, leaves;
  for (ConfigTable& method : root.getTables("method")) {
    const std::string integrator = method.getString("integrator", "path");
    const std::string name = method.getString("name", integrator);
    names.push_back(name);
    const std::vector<std::string> known = methodKeys(method);
    leaves.insert(leaves.end(), known.begin(), known.end());
    const bool knows = std::find(known.begin(), known.end(), leaf) != known.end();
    if (wanted.empty() ? knows : wanted == name) {
      method.assign(leaf, value, place);
      used = true;
    }
  }
  if (used) return;
  if (wanted.empty()) {
    failUsage(
        fmt::format("{}: no method has a parameter '{}'{}", place, leaf, didYouMean(leaf, leaves)));
  }
  failUsage(fmt::format("{}: no method is named '{}'{}", place, wanted, didYouMean(wanted, names)));
}

// Applies KEY of [settings]. A size replaces one of the file in the other notation.
void overrideSetting(const ConfigTable& root, const std::string& key, const std::string& value,
                     const std::string& place) {
  ConfigTable settings = root.getTable("settings");
  const auto replace = [&](const char* other) {
    const bool isOfFile = settings.has(other) && !startsWith(settings.place(other), "--");
    if (isOfFile) settings.remove(other);
  };
  if (key == "resolution") {
    replace("width");
    replace("height");
  } else if (key == "width" || key == "height") {
    replace("resolution");
  }
  settings.assign(key, value, place);
}

}  // namespace

void applyOverride(ConfigTable& root, const std::string& assignment) {
  const auto [key, value] = splitAssignment(assignment);
  const std::string place = "--set " + key;
  if (startsWith(key, "method.")) {
    overrideMethods(root, key, value, place);
  } else if (startsWith(key, "reference.")) {
    root.getTable("reference").assign(key.substr(10), value, place);
  } else if (startsWith(key, "settings.")) {
    overrideSetting(root, key.substr(9), value, place);
  } else if (startsWith(key, "sweep.")) {
    root.getTable("sweep").assign(key.substr(6), value, place);
  } else if (key == "name" || key == "question" || key == "scenes") {
    root.assign(key, value, place);
  } else if (key.find('.') != std::string::npos) {
    failUsage(
        fmt::format("{}: unknown table; known are settings, reference, method and sweep", place));
  } else {
    overrideSetting(root, key, value, place);
  }
}

}  // namespace restlab
