#include "core/backend/dialect_sources.h"

#include <algorithm>

namespace restlab {

namespace {

struct Tables {
  std::vector<DialectSource> sources;
  std::vector<DialectKernel> kernels;
};

Tables& tables() {
  static Tables all;
  return all;
}

}  // namespace

const std::vector<DialectSource>& dialectSources() { return tables().sources; }
const std::vector<DialectKernel>& dialectKernels() { return tables().kernels; }

bool registerDialect(std::vector<DialectSource> sources, std::vector<DialectKernel> kernels) {
  tables() = {std::move(sources), std::move(kernels)};
  return true;
}

std::optional<std::string> dialectSource(const std::string& path) {
  const auto& all = dialectSources();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const DialectSource& source) { return source.path == path; });
  if (found == all.end()) return std::nullopt;
  return std::string(found->text);
}

}  // namespace restlab
