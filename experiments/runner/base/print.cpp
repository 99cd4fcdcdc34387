#include "experiments/runner/base/print.h"

#include <cstdio>

#include "core/base/control_characters.h"

namespace restlab {

void printText(const std::string& text) { std::fputs(withoutControls(text, true).c_str(), stdout); }

void printJsonText(const std::string& dump) {
  std::fputs((jsonWithoutControls(dump) + "\n").c_str(), stdout);
}

}  // namespace restlab
