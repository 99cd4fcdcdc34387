#include "experiments/runner/tables/row_notes.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"

namespace restlab {

namespace {

constexpr size_t kManyRows = 3;

struct Said {
  std::string kind;  // flag with its numbers masked, and whether its row counts
  std::vector<std::string> names, texts;
};

// Replaces every number, with sign, point and exponent, by one mark.
std::string kindOf(const std::string& flag) {
  std::string kind;
  bool inNumber = false;
  for (size_t i = 0; i < flag.size(); ++i) {
    const auto isDigit = [&](size_t at) {
      return at < flag.size() && flag[at] >= '0' && flag[at] <= '9';
    };
    const bool isSign = (flag[i] == '+' || flag[i] == '-') && isDigit(i + 1);
    const bool isPoint = flag[i] == '.' && isDigit(i + 1);
    const bool isExponent =
        inNumber && flag[i] == 'e' && i + 1 < flag.size() && (isDigit(i + 2) || isDigit(i + 1));
    const bool isPart = isDigit(i) || isSign || isPoint || isExponent;
    if (isPart && !inNumber) kind += '#';
    if (!isPart) kind += flag[i];
    inNumber = isPart;
  }
  return kind;
}

std::string joined(const std::vector<std::string>& names, size_t rows) {
  if (names.size() == rows && rows >= kManyRows) return fmt::format("all {} rows", rows);
  return fmt::format("{}", fmt::join(names, "; "));
}

std::string linesOf(const Said& said, size_t rows) {
  const bool isOneText = std::all_of(said.texts.begin(), said.texts.end(),
                                     [&](const auto& text) { return text == said.texts[0]; });
  if (isOneText) return fmt::format("- {}: {}\n", joined(said.names, rows), said.texts[0]);
  std::string lines;
  if (said.names.size() < kManyRows) {
    for (size_t i = 0; i < said.names.size(); ++i)
      lines += fmt::format("- {}: {}\n", said.names[i], said.texts[i]);
    return lines;
  }
  const std::vector<std::string> others(said.names.begin() + 1, said.names.end());
  return fmt::format("- {}: {}; likewise, by numbers of their own (flags in summary.csv): {}\n",
                     said.names[0], said.texts[0],
                     said.names.size() == rows ? fmt::format("all {} other rows", others.size())
                                               : fmt::format("{}", fmt::join(others, "; ")));
}

}  // namespace

std::string rowNotes(const std::vector<MethodSummary>& rows) {
  std::vector<Said> all;
  for (const MethodSummary& row : rows) {
    for (const std::string& flag : row.flags) {
      const std::string kind = kindOf(flag) + (row.counts ? "" : " (*)");
      auto said = std::find_if(all.begin(), all.end(),
                               [&](const Said& other) { return other.kind == kind; });
      if (said == all.end()) said = all.insert(all.end(), {kind, {}, {}});
      said->names.push_back(oneLine(row.method->name) + (row.counts ? "" : " (*)"));
      said->texts.push_back(flag);
    }
  }
  std::string lines;
  for (const Said& said : all) lines += linesOf(said, rows.size());
  return lines;
}

}  // namespace restlab
