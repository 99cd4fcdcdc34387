#include "core/scene/mitsuba/report.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace restlab::mitsuba {

void Report::fail(const std::string& place, const std::string& text) const {
  failInput(place + ": " + text);
}

void Report::warn(const std::string& kind, const std::string& place, const std::string& text) {
  warnings_.add(kind, oneLine(place + ": " + text));
}

void Report::note(const std::string& kind, const std::string& place, const std::string& text) {
  notes_.add(kind, oneLine(place + ": " + text));
}

void Report::Lines::add(const std::string& kind, const std::string& line) {
  const auto [entry, isNew] = indexOfKind_.emplace(kind, kinds_.size());
  if (isNew) kinds_.emplace_back();
  Kind& lines = kinds_[entry->second];
  if (++lines.count <= shown_) lines.lines.push_back(line);
}

std::vector<std::string> Report::Lines::all() const {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds_) {
    lines.insert(lines.end(), kind.lines.begin(), kind.lines.end());
    if (kind.count > shown_)
      lines.push_back(fmt::format("... and {} more like the line before", kind.count - shown_));
  }
  return lines;
}

}  // namespace restlab::mitsuba
