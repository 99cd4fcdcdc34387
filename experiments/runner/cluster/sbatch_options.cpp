#include "experiments/runner/cluster/sbatch_options.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

namespace restlab {

namespace {

// Returns MiB of "4G", "500M", "500"; nothing for another text, and for 0, all of a node.
std::optional<double> mebibytesOf(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  double factor = 1.0;
  if (unit == "K" || unit == "k") factor = 1.0 / 1024.0;
  if (unit == "G" || unit == "g") factor = 1024.0;
  if (unit == "T" || unit == "t") factor = 1024.0 * 1024.0;
  const bool isKnown = unit.empty() || unit == "M" || unit == "m" || factor != 1.0;
  if (end == text.c_str() || !isKnown || !(number > 0.0)) return std::nullopt;
  return number * factor;
}

// Returns seconds of "M", "M:S", "H:M:S", "D-H", "D-H:M" and "D-H:M:S"; nothing for another text.
std::optional<double> secondsOf(const std::string& text) {
  const size_t dash = text.find('-');
  std::istringstream in(dash == std::string::npos ? text : text.substr(dash + 1));
  std::vector<double> parts;
  for (std::string part; std::getline(in, part, ':');) {
    char* end = nullptr;
    parts.push_back(std::strtod(part.c_str(), &end));
    if (part.empty() || *end != '\0') return std::nullopt;
  }
  if (parts.empty() || parts.size() > 3) return std::nullopt;
  double seconds = 0.0;
  // The first part is of hours behind days, and where there are three; else of minutes.
  double unit = dash != std::string::npos || parts.size() == 3 ? 3600.0 : 60.0;
  for (const double part : parts) {
    seconds += part * unit;
    unit /= 60.0;
  }
  if (dash != std::string::npos) seconds += 86400.0 * std::strtod(text.c_str(), nullptr);
  return seconds > 0.0 ? std::optional<double>(seconds) : std::nullopt;
}

}  // namespace

SbatchAsked askedIn(const std::string& options) {
  SbatchAsked asked;
  std::istringstream words(options);
  for (std::string word; words >> word;) {
    std::string name = word.substr(0, word.find('=')), value;
    if (word.rfind("-t", 0) == 0) name = "-t";
    const bool isTime = name == "--time" || name == "-t";
    if (!isTime && name.rfind("--mem", 0) != 0) continue;
    if (name == "--mem-bind") continue;
    if (const size_t at = word.find('='); at != std::string::npos)
      value = word.substr(at + 1);
    else if (word.size() > name.size())
      value = word.substr(name.size());  // -t30
    else
      words >> value;
    std::erase_if(value, [](char c) { return c == '"' || c == '\''; });
    if (isTime) {
      asked.hasTime = true;
      asked.seconds = secondsOf(value);
    } else {
      asked.hasMemory = true;
      asked.memoryMiB = name == "--mem" ? mebibytesOf(value) : std::nullopt;
    }
  }
  return asked;
}

Asked withOptions(const Asked& planned, const std::string& options, double times) {
  const SbatchAsked own = askedIn(options);
  Asked asked = planned;
  if (own.hasMemory) asked.memoryMiB = times * own.memoryMiB.value_or(0.0);
  if (own.hasTime) asked.seconds = times * own.seconds.value_or(0.0);
  return asked;
}

}  // namespace restlab
