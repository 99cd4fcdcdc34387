#include "experiments/runner/suite/scene_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/scene/builtin/name.h"

namespace restlab {

SweptParameter sweptParameter(const std::vector<std::string>& names) {
  std::vector<BuiltinName> parsed;
  for (const std::string& name : names) {
    if (!isBuiltinScene(name)) {
      failUsage(fmt::format("several scenes are a sweep of one built-in, but '{}' is none", name));
    }
    parsed.push_back(parseBuiltinName(name));
    if (parsed.back().base != parsed.front().base) {
      failUsage(fmt::format("several scenes are a sweep of one built-in, but '{}' is not of {}",
                            name, parsed.front().base));
    }
  }
  SweptParameter swept;
  std::string common;
  for (const SceneParameter& parameter : builtinSceneParameters(parsed.front().base)) {
    const bool isSame = std::all_of(parsed.begin(), parsed.end(), [&](const BuiltinName& name) {
      return name.value(parameter.name) == parsed.front().value(parameter.name);
    });
    if (isSame) {
      const std::string text = parsed.front().text(parameter.name);
      if (!text.empty())
        common += fmt::format("{}{}={}", common.empty() ? "?" : "&", parameter.name, text);
      continue;
    }
    if (!swept.name.empty()) {
      failUsage(
          fmt::format("several scenes are a sweep of one parameter, but these differ in '{}' "
                      "and '{}'",
                      swept.name, parameter.name));
    }
    swept.name = parameter.name;
  }
  swept.scene = parsed.front().base + common;
  if (swept.name.empty()) failUsage("several scenes are a sweep, but these are all the same");
  std::set<double> seen;
  for (size_t i = 0; i < names.size(); ++i) {
    const std::optional<double> value = parsed[i].value(swept.name);
    if (!value) {
      failUsage(fmt::format("several scenes are a sweep of '{}', but '{}' does not say it",
                            swept.name, names[i]));
    }
    if (!seen.insert(*value).second)
      failUsage(fmt::format("the sweep of '{}' has a value twice: '{}'", swept.name, names[i]));
    const std::string text = parsed[i].text(swept.name);
    swept.values.push_back(*value);
    swept.texts.push_back(text.empty() ? fmt::format("{:g}", *value) : text);
  }
  return swept;
}

}  // namespace restlab
