#include "experiments/runner/suite/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <set>

#include "core/base/error.h"
#include "core/frame/method_settings.h"

namespace restlab {

namespace {

// Maximum number of combinations; reports with more tables are of no use, and slow to read.
constexpr int64_t kMaxCounted = 2000;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Throws unless some method of the suite has the axis's key.
void requireSomeMethod(const ConfigTable& root, const std::vector<std::string>& settingsKeys,
                       const SweepAxis& axis) {
  std::vector<std::string> names, leaves = methodKeys();
  bool named = false;
  for (const ConfigTable& table : root.getTables("method")) {
    const std::string integrator = table.getString("integrator", "path");
    const std::string name = table.getString("name", integrator);
    names.push_back(name);
    if (!axis.method.empty() && axis.method != name) continue;
    named = true;
    // Skip rows of images, which have nothing to sweep.
    if (table.has("image")) continue;
    const std::vector<std::string> known = methodKeys(table);
    if (contains(known, axis.leaf)) return;
    leaves.insert(leaves.end(), known.begin(), known.end());
  }
  if (!named && !axis.method.empty()) {
    failUsage(fmt::format("{}: no method is named '{}'{}", axis.place, axis.method,
                          didYouMean(axis.method, names)));
  }
  if (axis.method.empty()) leaves.insert(leaves.end(), settingsKeys.begin(), settingsKeys.end());
  failUsage(fmt::format("{}: neither a setting nor something of a method in the suite: '{}'{}",
                        axis.place, axis.leaf, didYouMean(axis.leaf, leaves)));
}

}  // namespace

std::string unquoted(const std::string& text) {
  const bool quoted = text.size() >= 2 && (text.front() == '\'' || text.front() == '"') &&
                      text.back() == text.front();
  return quoted ? text.substr(1, text.size() - 2) : text;
}

bool splitMethodKey(const std::string& key, std::string& method, std::string& leaf) {
  const std::string prefix = "method.";
  if (key.rfind(prefix, 0) != 0) return false;
  const std::string rest = key.substr(prefix.size());
  const size_t dot = rest.rfind('.');
  method = dot == std::string::npos ? "" : rest.substr(0, dot);
  leaf = dot == std::string::npos ? rest : rest.substr(dot + 1);
  return true;
}

const std::vector<std::string>& methodKeys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    for (const MethodSetting& setting : methodSettings()) all.emplace_back(setting.key);
    all.emplace_back("kernels");
    return all;
  }();
  return keys;
}

std::vector<std::string> methodKeys(const std::string& integrator, const std::string& denoiser) {
  std::vector<std::string> names = methodKeys();
  // With any cache, because the cache may be swept too.
  for (std::string& name : parameterNames(integrator, denoiser)) names.push_back(std::move(name));
  return names;
}

std::vector<std::string> methodKeys(const ConfigTable& method) {
  if (method.has("image")) return {"image", "time_ms", "bias"};
  return methodKeys(method.getString("integrator", "path"), method.getString("denoiser", "none"));
}

std::string sweepValues(const std::string& key, const std::string& values) {
  const std::string place = fmt::format("--sweep {}", key);
  if (!values.empty() && values.front() == '[') return values;
  std::vector<std::string> texts;
  static const std::regex range(R"((-?\d{1,9})\.\.(-?\d{1,9}))");
  static const std::regex plain(R"(true|false|[-+]?(\d+|\d+\.\d+|\d+(\.\d+)?[eE][-+]?\d+))");
  if (std::smatch match; std::regex_match(values, match, range)) {
    const int64_t first = std::atoll(match[1].str().c_str());
    const int64_t last = std::atoll(match[2].str().c_str());
    if (last < first || last - first >= kMaxCounted) {
      failUsage(fmt::format("{}: {} must count upwards, to at most {} values", place, values,
                            kMaxCounted));
    }
    for (int64_t i = first; i <= last; ++i) texts.push_back(std::to_string(i));
  } else {
    for (size_t at = 0; at <= values.size();) {
      const size_t comma = std::min(values.find(',', at), values.size());
      const std::string item = values.substr(at, comma - at);
      if (item.empty()) failUsage(fmt::format("{}: '{}' has an empty value", place, values));
      const bool isQuoted = item.front() == '"' || item.front() == '\'';
      texts.push_back(isQuoted || std::regex_match(item, plain) ? item
                                                                : fmt::format("\"{}\"", item));
      at = comma + 1;
    }
  }
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

Sweep readSweep(const ConfigTable& root, const std::vector<std::string>& settingsKeys) {
  Sweep sweep;
  const ConfigTable table = root.getTable("sweep");
  for (const std::string& key : table.keys()) {
    SweepAxis axis;
    axis.key = key;
    axis.place = table.place(key);
    axis.texts = table.getTexts(key);
    if (axis.texts.empty()) table.fail(key, fmt::format("'{}' has no values", key));
    const std::set<std::string> once(axis.texts.begin(), axis.texts.end());
    if (once.size() < axis.texts.size())
      table.fail(key, fmt::format("'{}' has a value twice", key));
    if (!splitMethodKey(key, axis.method, axis.leaf)) axis.leaf = key;
    // Treat `backend` as a key of methods: in [settings] it is a list.
    const bool isSetting = axis.leaf == key && contains(settingsKeys, key) && key != "backend";
    if (!isSetting) requireSomeMethod(root, settingsKeys, axis);
    (isSetting ? sweep.settings : sweep.methods).push_back(std::move(axis));
  }
  return sweep;
}

std::vector<std::vector<size_t>> combinations(const std::vector<SweepAxis>& axes) {
  std::vector<std::vector<size_t>> all = {{}};
  for (const SweepAxis& axis : axes) {
    if (axis.texts.size() > size_t(kMaxCounted) / all.size()) {
      failUsage(
          fmt::format("{}: with the {} values of '{}' the sweep has more than {} combinations",
                      axis.place, axis.texts.size(), axis.key, kMaxCounted));
    }
    std::vector<std::vector<size_t>> longer;
    for (const std::vector<size_t>& choice : all) {
      for (size_t value = 0; value < axis.texts.size(); ++value) {
        longer.push_back(choice);
        longer.back().push_back(value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::vector<SweptValue> sweptValues(const std::vector<SweepAxis>& axes,
                                    const std::vector<size_t>& choice) {
  std::vector<SweptValue> values;
  for (size_t i = 0; i < axes.size(); ++i)
    values.push_back({axes[i].leaf, unquoted(axes[i].texts[choice[i]])});
  return values;
}

std::string sweepLabel(const std::vector<SweptValue>& values) {
  std::string label;
  for (const SweptValue& value : values)
    label += fmt::format("{}{}={}", label.empty() ? "" : ", ", value.key, value.text);
  return label;
}

}  // namespace restlab
