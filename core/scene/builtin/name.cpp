#include "core/scene/builtin/name.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/error.h"

namespace restlab {

namespace {

std::optional<double> plainNumber(std::string_view text) {
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

// Parses "0.5", "1e-3", or a power "2^-13": a decimal fraction would need many digits for that.
std::optional<double> numberOf(std::string_view text) {
  const size_t caret = text.find('^');
  if (caret == std::string_view::npos) return plainNumber(text);
  const auto base = plainNumber(text.substr(0, caret)), power = plainNumber(text.substr(caret + 1));
  if (!base || !power) return std::nullopt;
  const double value = std::pow(*base, *power);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  for (size_t from = 0; from <= text.size();) {
    const size_t end = std::min(text.find(at, from), text.size());
    parts.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return parts;
}

}  // namespace

std::optional<double> BuiltinName::value(const std::string& parameter) const {
  for (const Given& one : given) {
    if (one.name == parameter) return one.value;
  }
  for (const SceneParameter& known : builtinSceneParameters(base)) {
    if (known.name == parameter) return known.fallback;
  }
  return std::nullopt;
}

std::string BuiltinName::text(const std::string& parameter) const {
  for (const Given& one : given) {
    if (one.name == parameter) return one.text;
  }
  return "";
}

BuiltinName parseBuiltinName(const std::string& name) {
  const size_t mark = name.find('?');
  BuiltinName parsed;
  parsed.base = name.substr(0, mark);
  const std::vector<SceneParameter> known = builtinSceneParameters(parsed.base);
  if (mark == std::string::npos) return parsed;
  std::vector<std::string> names;
  for (const SceneParameter& parameter : known) names.push_back(parameter.name);
  for (const std::string& part : split(name.substr(mark + 1), '&')) {
    const size_t equals = part.find('=');
    const std::string key = part.substr(0, equals);
    const auto found =
        std::find_if(known.begin(), known.end(),
                     [&](const SceneParameter& parameter) { return parameter.name == key; });
    if (found == known.end()) {
      failInput(fmt::format("scene '{}': {} has no parameter '{}' (it has: {}){}", name,
                            parsed.base, key, fmt::join(names, ", "), didYouMean(key, names)));
    }
    if (std::any_of(parsed.given.begin(), parsed.given.end(),
                    [&](const auto& other) { return other.name == key; }))
      failInput(fmt::format("scene '{}': '{}' is given twice", name, key));
    const std::string text = equals == std::string::npos ? "" : part.substr(equals + 1);
    if (!found->choices.empty()) {
      const auto choice = std::find(found->choices.begin(), found->choices.end(), text);
      if (choice == found->choices.end()) {
        failInput(fmt::format("scene '{}': {} is '{}', not one of {}{}", name, key, text,
                              fmt::join(found->choices, ", "), didYouMean(text, found->choices)));
      }
      parsed.given.push_back({key, text, double(choice - found->choices.begin())});
      continue;
    }
    const std::optional<double> value = numberOf(text);
    if (!value) {
      failInput(fmt::format("scene '{}': {} is '{}', not a number such as 0.5, 1e-3 or 2^-13", name,
                            key, text));
    }
    if (*value < found->lo || *value > found->hi) {
      failInput(fmt::format("scene '{}': {} is {}, but must be in {:g}..{:g}", name, key, text,
                            found->lo, found->hi));
    }
    parsed.given.push_back({key, text, *value});
  }
  return parsed;
}

std::string withoutRelations(const std::string& name) {
  const size_t mark = name.find('?');
  if (mark == std::string::npos) return name;
  std::string kept;
  for (const std::string& part : split(name.substr(mark + 1), '&')) {
    const std::string key = part.substr(0, part.find('='));
    if (key == kScaleParameter || key == kRadianceParameter || key == kMoveParameter ||
        key == kRepresentationParameter)
      continue;
    kept += (kept.empty() ? "?" : "&") + part;
  }
  return name.substr(0, mark) + kept;
}

}  // namespace restlab
