#include "core/scene/gltf/report.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace restlab::gltf {

std::string byteCount(uint64_t bytes) {
  return fmt::format("{} byte{}", bytes, bytes == 1 ? "" : "s");
}

std::string Report::line(std::string_view place, std::string_view text) const {
  return oneLine(place.empty() ? fmt::format("{}: {}", file_, text)
                               : fmt::format("{}: {}: {}", file_, place, text));
}

void Report::fail(std::string_view place, std::string_view text) const {
  failInput(line(place, text));
}

void Report::takeMemory(std::string_view place, std::string_view what, uint64_t bytes) {
  memory_.take(line(place, what), bytes);
}

void Report::warn(const std::string& kind, std::string_view place, std::string_view text) {
  const auto [it, isNew] = indexOfKind_.emplace(kind, kinds_.size());
  if (isNew) kinds_.emplace_back();
  Kind& entry = kinds_[it->second];
  if (++entry.count <= kShown) entry.lines.push_back(line(place, text));
}

std::vector<std::string> Report::lines() const {
  std::vector<std::string> all;
  for (const Kind& kind : kinds_) {
    all.insert(all.end(), kind.lines.begin(), kind.lines.end());
    if (kind.count > kShown) {
      all.push_back(oneLine(
          fmt::format("{}: ... and {} more like the line before", file_, kind.count - kShown)));
    }
  }
  return all;
}

}  // namespace restlab::gltf
