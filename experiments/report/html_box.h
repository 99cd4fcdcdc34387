// Parts of tables of report.html.
#pragma once

#include <string>

namespace restlab::html {

// Heading of a column: a button that sorts by it. Texts are escaped here; "": none.
struct Heading {
  std::string title, unit = "", help = "";
  std::string better = "none";  // "lower", "higher" or "none"
  bool isNumber = true;
};
std::string headCell(const Heading& heading);

// A table of that class in a box, which scrolls where the window is too narrow. `head` and `body`:
// markup of the cells of the heading and of the rows; `label`: what the box is called.
std::string tableBox(const std::string& cssClass, const std::string& label, const std::string& head,
                     const std::string& body);

// A paragraph on columns that no table has: "In all rows: a 3, b 4. Zero in all rows: c, d."; each
// text is markup. "" without columns.
class SaidOnce {
 public:
  // `shown`: the number, or "" for 0.
  void add(const std::string& title, const std::string& help, const std::string& shown);
  std::string paragraph() const;

 private:
  std::string values_, zeros_;
};

}  // namespace restlab::html
