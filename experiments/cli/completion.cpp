#include "experiments/cli/completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/backend/backend.h"
#include "core/backend/kernel_choice.h"
#include "core/scene/scene.h"
#include "experiments/cli/option_text.h"
#include "experiments/runner/registries/registries.h"
#include "experiments/runner/suite/reference_target.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;
using CompletionWords = std::vector<std::string>;

CompletionWords namesIn(const Json& all) {
  CompletionWords names;
  for (const Json& one : all)
    if (one.value("available", true)) names.push_back(one.at("name").get<std::string>());
  return names;
}

// Values of all parameters of all parts by "NAME="; none for numbers and free text.
std::map<std::string, std::set<std::string>> parameterValues() {
  std::map<std::string, std::set<std::string>> all;
  for (const Json& parts : {integratorsJson(), cachesJson(), denoisersJson()}) {
    for (const Json& part : parts) {
      for (const Json& parameter : part.value("parameters", Json::array())) {
        std::set<std::string>& values = all[parameter.at("name").get<std::string>() + "="];
        if (parameter.at("default").is_boolean()) values.insert({"true", "false"});
        for (const Json& choice : parameter.value("choices", Json::array()))
          values.insert(choice.get<std::string>());
      }
    }
  }
  return all;
}

CompletionWords splitAt(const std::string& text, char at) {
  CompletionWords parts;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(at, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// Values that an option takes: those of its type ("box|center", "{half,directions}"), or names of a
// registry; none for numbers, free text and files.
CompletionWords completionsOf(const CLI::Option& option,
                              const std::map<std::string, CompletionWords>& registries) {
  const std::string kind = kindOf(option);
  if (kind.find('|') != std::string::npos) return splitAt(kind, '|');
  if (kind.size() > 2 && kind.front() == '{' && kind.find('}') != std::string::npos)
    return splitAt(kind.substr(1, kind.find('}') - 1), ',');
  for (const std::string& name : option.get_lnames()) {
    // Names of the viewer's second pane begin with "b-".
    const auto found = registries.find(name.rfind("b-", 0) == 0 ? name.substr(2) : name);
    if (found != registries.end()) return found->second;
  }
  return {};
}

// Takes an argument: all but flags, and but those whose value is behind a '='.
bool takesValue(const CLI::Option& option) { return option.get_expected_max() > 0; }

constexpr const char* kScript =
    R"(# Completion of restlab by bash. Made by `restlab list completion`.
_restlab() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} verb=${{COMP_WORDS[1]-}}
  local options='' words='' place='' takes=' ' program
  COMPREPLY=()
  # A word ends at '=': --option=value is three of them, and "--set name=" what stands before name's.
  local first=$((COMP_CWORD - 1))
  if [[ $word == '=' ]]; then
    word=
  elif [[ $before == '=' ]]; then
    first=$((COMP_CWORD - 2))
    before=${{COMP_WORDS[first]}}
  else
    first=0
  fi
  ((first < 2)) || [[ $before == -* ]] || before="${{COMP_WORDS[first - 1]}} $before="
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W '{verbs} help --help --version' -- "$word"))
    return
  fi
  case $verb in
    help) COMPREPLY=($(compgen -W '{verbs}' -- "$word")); return ;;
{cases}  esac
  case "$verb $before" in
{values}  esac
  if [[ $words ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    [[ ${{COMPREPLY[0]-}} != *= ]] || compopt -o nospace 2>/dev/null
    return
  fi
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
    return
  fi
  # The value of an option that has no names: a file, or free text.
  [[ $before != *= && $takes != *" $before "* ]] || return
  case $place in
    scene) words='{scenes}' ;;
    suite)
      program=$(type -P -- "${{COMP_WORDS[0]}}")
      program=$(readlink -f -- "$program")
      for words in "${{program%/bin/*}}"/share/restlab/suites/*.toml; do
        [[ -e $words ]] || continue
        words=${{words##*/}}
        COMPREPLY+=($(compgen -W "${{words%.toml}}" -- "$word"))
      done
      words= ;;
    *) words=$place ;;
  esac
  COMPREPLY+=($(compgen -W "$words" -- "$word"))
  # Names of files beside those of scenes and suites.
  case $place in
    scene | suite)
      compopt -o filenames 2>/dev/null
      mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -f -- "$word") ;;
  esac
}}
complete -o default -F _restlab restlab
)";

}  // namespace

std::string bashCompletion(const CLI::App& app, const std::vector<std::string>& kinds) {
  const CompletionWords integrators = namesIn(integratorsJson());
  const std::map<std::string, std::set<std::string>> parameters = parameterValues();
  CompletionWords parameterNames;
  for (const auto& [name, its] : parameters) parameterNames.push_back(name);
  const std::map<std::string, CompletionWords> registries = {
      {"integrator", integrators},      {"against", referenceIntegrators()},
      {"cache", namesIn(cachesJson())}, {"denoiser", namesIn(denoisersJson())},
      {"backend", backendNames()},      {"metric", namesIn(metricsJson())},
      {"kernels", kernelChoiceNames()}, {"component", {"all", "direct", "indirect"}},
      {"scene", builtinSceneNames()},   {"set", parameterNames}};
  // CompletionWords of what is given by its place, but for scenes and suites, which may be files.
  const std::map<std::string, CompletionWords> places = {{"scene", {"scene"}},
                                                         {"suite", {"suite"}},
                                                         {"method", integrators},
                                                         {"kind", namesIn(closuresJson())},
                                                         {"what", kinds}};
  CompletionWords verbs;
  std::string cases, values;
  for (const CLI::App* verb : app.get_subcommands({})) {
    const std::string& name = verb->get_name();
    verbs.push_back(name);
    CompletionWords all, takes, place;
    std::map<CompletionWords, CompletionWords>
        byValues;  // patterns of options, by the words that they take
    for (const CLI::Option* option : verb->get_options()) {
      const CompletionWords names = dashedNames(*option);
      if (names.empty()) {
        const auto found = places.find(option->get_name(true));
        if (place.empty() && found != places.end()) place = found->second;
        continue;
      }
      all.insert(all.end(), names.begin(), names.end());
      if (!takesValue(*option)) continue;
      takes.insert(takes.end(), names.begin(), names.end());
      // Settings of a suite and parameters of a closure are no parameters of methods.
      const bool isOther = option->check_lname("set") &&
                           (name == "bsdf" || verb->get_option_no_throw("suite") != nullptr);
      const bool isOfReference = option->check_lname("integrator") && name == "reference";
      const CompletionWords its = isOther         ? CompletionWords{}
                                  : isOfReference ? referenceIntegrators()
                                                  : completionsOf(*option, registries);
      if (its == parameterNames) {
        for (const auto& [parameter, choices] : parameters)
          if (!choices.empty())
            byValues[{choices.begin(), choices.end()}].push_back(
                fmt::format("'{} --set {}'", name, parameter));
      }
      for (const std::string& one : names)
        if (!its.empty()) byValues[its].push_back(fmt::format("'{} {}'", name, one));
    }
    cases += fmt::format("    {}) options='{}' takes=' {} ' place='{}' ;;\n", name,
                         fmt::join(all, " "), fmt::join(takes, " "), fmt::join(place, " "));
    for (const auto& [its, patterns] : byValues)
      values +=
          fmt::format("    {}) words='{}' ;;\n", fmt::join(patterns, " | "), fmt::join(its, " "));
  }
  return fmt::format(kScript, fmt::arg("verbs", fmt::join(verbs, " ")), fmt::arg("cases", cases),
                     fmt::arg("values", values),
                     fmt::arg("scenes", fmt::join(builtinSceneNames(), " ")));
}

}  // namespace restlab
