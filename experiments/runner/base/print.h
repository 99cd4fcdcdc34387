// Prints to stdout, without control sequences that names from a suite or scene could send to a
// terminal. Write errors are detected at the program's end (stdout's error flag).
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

namespace restlab {

// Replaces control characters by blanks, except line breaks and tabs.
void printText(const std::string& text);

template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  printText(fmt::format(format, std::forward<Values>(values)...));
}

// Prints a JSON dump and a line break. Control characters become escapes.
void printJsonText(const std::string& dump);

}  // namespace restlab
