// Markdown summary of the certificates of a suite: declared classes against verdicts, and a table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "experiments/certificate/outputs.h"
#include "experiments/runner/base/bias_name.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/tables/summary.h"

namespace restlab::certificate {
namespace {

// Six columns with method, denoiser and class: the width of a page.
constexpr size_t kScenesBeside = 3;

constexpr Verdict kVerdicts[] = {Verdict::equivalent, Verdict::notDecided, Verdict::biased};
constexpr BiasClass kClasses[] = {BiasClass::unbiased, BiasClass::consistent, BiasClass::biased};

// Only an unbiased method can contradict its class: a consistent one may be biased after any number
// of frames, and a biased one may happen to be right.
bool isContradiction(const Certified& c) {
  return c.declared == BiasClass::unbiased && c.certificate.verdict == Verdict::biased;
}

std::string cellOf(const Certified& certified) {
  const Certificate& c = certified.certificate;
  const Interval& bias = c.image.front().bias;
  std::string text = fmt::format("{} {:+.2f}", verdictName(c.verdict), 100.0 * bias.value);
  text += c.image.front().isNormal
              ? fmt::format(" [{:+.2f}, {:+.2f}]", 100.0 * bias.lo, 100.0 * bias.hi)
              : std::string(", too skewed for an interval");
  if (c.worst && !c.worst->wholeImage) {
    const double scale = std::abs(c.worst->reference);
    text += scale == 0.0
                ? std::string(", light in a black cell")
                : fmt::format(", in a cell {:+.2g}", 100.0 * c.worst->welch.difference / scale);
  }
  const uint64_t nonfinite = c.cells.nonfinite + c.nonfiniteSamples;
  if (nonfinite > 0) text += fmt::format(", {} values not finite", nonfinite);
  // Untested cells may hide any bias.
  if (c.cells.untestableShare >= 0.005)
    text += fmt::format(", {:.0f} % in untested cells", 100.0 * c.cells.untestableShare);
  if (c.moreRuns) text += fmt::format(", {} more runs", *c.moreRuns);
  return isContradiction(certified) ? fmt::format("**{}**", text) : text;
}

std::string range(uint64_t least, uint64_t most) {
  return least == most ? std::to_string(least) : fmt::format("{} to {}", least, most);
}

// Returns values in their order, each once.
template <class Value>
std::vector<Value> distinct(const std::vector<Certified>& all, Value (*of)(const Certified&)) {
  std::vector<Value> values;
  for (const Certified& c : all) {
    const Value value = of(c);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

using Row = std::pair<std::string, std::string>;  // method and denoiser

std::string countsOf(const std::vector<Certified>& all) {
  std::string text = "| declared | equivalent | not decided | biased |\n|---|---|---|---|\n";
  for (const BiasClass declared : kClasses) {
    size_t counts[std::size(kVerdicts)] = {};
    for (const Certified& c : all) {
      for (size_t i = 0; i < std::size(kVerdicts); ++i)
        counts[i] += c.declared == declared && c.certificate.verdict == kVerdicts[i];
    }
    if (counts[0] + counts[1] + counts[2] == 0) continue;
    text +=
        fmt::format("| {} | {} | {} | {} |\n", biasName(declared), counts[0], counts[1], counts[2]);
  }
  return text;
}

std::string contradictionsOf(const std::vector<Certified>& all) {
  std::string text;
  for (const Certified& c : all) {
    if (isContradiction(c)) text += fmt::format("- **{}**: {}\n", c.name, c.certificate.reason);
  }
  return text.empty() ? "None that is declared unbiased was found biased.\n"
                      : "Declared unbiased and found biased:\n\n" + text;
}

std::string tableOf(const std::vector<Certified>& all, const std::vector<std::string>& scenes) {
  std::string text = "| method | denoiser | declared |", line = "|---|---|---|";
  for (const std::string& scene : scenes) {
    text += fmt::format(" {} |", scene);
    line += "---|";
  }
  text += "\n" + line + "\n";
  const std::vector<Row> rows =
      distinct<Row>(all, [](const Certified& c) { return Row(c.method, c.denoiser); });
  // Methods of equal lines, and the rest of the line, in order of the first method.
  std::vector<std::pair<std::string, std::string>> lines;
  for (const Row& row : rows) {
    std::string cells;
    const char* declared = nullptr;
    for (const std::string& scene : scenes) {
      const auto found = std::find_if(all.begin(), all.end(), [&](const Certified& c) {
        return c.scene == scene && Row(c.method, c.denoiser) == row;
      });
      cells += fmt::format(" {} |", found == all.end() ? "" : cellOf(*found));
      if (found != all.end()) declared = found->declared ? biasName(*found->declared) : "";
    }
    // Skip methods that none of these scenes has.
    if (declared == nullptr) continue;
    const std::string rest = fmt::format(" | {} | {} |{}\n", row.second, declared, cells);
    const auto same = std::find_if(lines.begin(), lines.end(),
                                   [&](const auto& other) { return other.second == rest; });
    if (same == lines.end()) {
      lines.emplace_back(row.first, rest);
    } else {
      same->first += "; " + row.first;
    }
  }
  for (const auto& [methods, rest] : lines) text += "| " + methods + rest;
  return text;
}

}  // namespace

std::string suiteMarkdownOf(const std::vector<Certified>& all, const Rules& rules,
                            const std::string& command) {
  if (all.empty()) return "";
  uint64_t minRuns = UINT64_MAX, maxRuns = 0, leastSpp = UINT64_MAX, mostSpp = 0;
  std::set<std::pair<uint32_t, uint32_t>> sizes;
  for (const Certified& c : all) {
    minRuns = std::min<uint64_t>(minRuns, c.certificate.runs);
    maxRuns = std::max<uint64_t>(maxRuns, c.certificate.runs);
    if (c.reference.spp > 0) {  // 0: closed form
      leastSpp = std::min(leastSpp, c.reference.spp);
      mostSpp = std::max(mostSpp, c.reference.spp);
    }
    sizes.emplace(c.mean.width, c.mean.height);
  }
  std::vector<std::string> pixels;
  for (const auto& [width, height] : sizes) pixels.push_back(fmt::format("{}x{}", width, height));
  std::string text = fmt::format(
      "`{}`, {}. Images of {} pixels, {} runs a certificate, references {}, a margin of "
      "+-{:g} %.\n\n",
      command, utcNow().substr(0, 10), fmt::join(pixels, ", "), range(minRuns, maxRuns),
      mostSpp == 0 ? "in closed form" : fmt::format("of {} spp", range(leastSpp, mostSpp)),
      100.0 * rules.margin);
  text += countsOf(all) + "\n" + contradictionsOf(all) + "\n";
  text +=
      "What stands in the tables: the verdict, and the bias of the image's luminance in percent "
      "with its 95 % interval. Behind biased, the bias of the cell of the image that is farthest "
      "off. Then the share of the image whose cells are too skewed for a test, if there is one. "
      "Behind not decided, how many more runs would decide; nothing where the error of the "
      "reference is too large for that. Methods that agree in all digits share a line.\n";
  const std::vector<std::string> scenes =
      distinct<std::string>(all, [](const Certified& c) { return c.scene; });
  for (size_t i = 0; i < scenes.size(); i += kScenesBeside) {
    const size_t end = std::min(i + kScenesBeside, scenes.size());
    text += "\n" + tableOf(all, {scenes.begin() + ptrdiff_t(i), scenes.begin() + ptrdiff_t(end)});
  }
  return text;
}

}  // namespace restlab::certificate
