// A table in markdown, without the columns in which nothing stands.
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
  // Columns whose cells are all "" or "unknown" are left out, but never the first one. A bar inside
  // a cell is escaped.
  std::string text() const;

 private:
  std::vector<std::string> heads_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace restlab
