#include "core/backend/dialect_sources.h"

#include <algorithm>

namespace restlab {

std::optional<std::string> dialectSource(const std::string& path) {
  const auto& all = dialectSources();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const DialectSource& source) { return source.path == path; });
  if (found == all.end()) return std::nullopt;
  return std::string(found->text);
}

}  // namespace restlab
