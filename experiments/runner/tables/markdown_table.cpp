#include "experiments/runner/tables/markdown_table.h"

#include <algorithm>
#include <stdexcept>

#include "core/base/error.h"

namespace restlab {

namespace {

std::string escaped(const std::string& cell) {
  std::string text;
  for (const char c : oneLine(cell)) {
    if (c == '|') text += '\\';
    text += c;
  }
  return text;
}

}  // namespace

MarkdownTable::MarkdownTable(std::vector<std::string> heads) : heads_(std::move(heads)) {}

void MarkdownTable::add(std::vector<std::string> cells) {
  if (cells.size() != heads_.size())
    throw std::invalid_argument("a row of a table needs a cell for each head");
  rows_.push_back(std::move(cells));
}

std::string MarkdownTable::text() const {
  std::vector<bool> isShown(heads_.size());
  for (size_t column = 0; column < heads_.size(); ++column) {
    isShown[column] = column == 0 || std::any_of(rows_.begin(), rows_.end(), [&](const auto& row) {
                        return !row[column].empty() && row[column] != "unknown";
                      });
  }
  const auto lineOf = [&](const std::vector<std::string>& cells) {
    std::string line = "|";
    for (size_t column = 0; column < cells.size(); ++column)
      if (isShown[column]) line += " " + escaped(cells[column]) + " |";
    return line + "\n";
  };
  std::string text = lineOf(heads_) + "|";
  for (const bool shown : isShown) text += shown ? "---|" : "";
  text += "\n";
  for (const std::vector<std::string>& row : rows_) text += lineOf(row);
  return text;
}

}  // namespace restlab
