// A markdown table without its empty columns.
#pragma once

#include <string>
#include <vector>

namespace restlab {

class MarkdownTable {
 public:
  explicit MarkdownTable(std::vector<std::string> heads);
  // Adds a row. Throws std::invalid_argument unless it has a cell for each head.
  void add(std::vector<std::string> cells);
  bool isEmpty() const { return rows_.empty(); }
  // Leaves out columns whose cells are all "" or "unknown", but never the first. Escapes bars in
  // cells.
  std::string text() const;

 private:
  std::vector<std::string> heads_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace restlab
