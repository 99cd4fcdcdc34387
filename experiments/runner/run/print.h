// Prints to stdout, all of it: names that a suite or a scene gave command no terminal.
// A write that fails is seen at the program's end (stdout's error mark).
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

namespace restlab {

// Control characters but line breaks and tabs become blanks.
void printText(const std::string& text);

template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  printText(fmt::format(format, std::forward<Values>(values)...));
}

// A dump of JSON and a line break. Its control characters become escapes.
void printJsonText(const std::string& dump);

}  // namespace restlab
