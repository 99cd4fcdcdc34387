#include "core/backend/dialect_sources.h"

#include <algorithm>
#include <map>

#include "core/base/error.h"

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

const DialectKernel& dialectKernel(const std::string& name) {
  for (const DialectKernel& known : dialectKernels())
    if (known.name == name) return known;
  failUsage("no kernel '" + name + "' in this build");
}

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

std::vector<std::string> includedPaths(std::string_view text) {
  constexpr std::string_view mark = "#include \"";
  std::vector<std::string> paths;
  for (size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + 1)) {
    const size_t begin = at + mark.size(), end = text.find('"', begin);
    if (end == text.npos) break;
    paths.emplace_back(text.substr(begin, end - begin));
  }
  return paths;
}

std::vector<DialectSource> includedSources(std::vector<std::string> roots) {
  std::map<std::string_view, std::string_view> all;
  for (const DialectSource& source : dialectSources()) all.emplace(source.path, source.text);
  std::map<std::string_view, std::string_view> found;
  while (!roots.empty()) {
    const auto source = all.find(roots.back());
    roots.pop_back();
    if (source == all.end() || !found.insert(*source).second) continue;
    for (std::string& path : includedPaths(source->second)) roots.push_back(std::move(path));
  }
  std::vector<DialectSource> sources;
  for (const auto& [path, text] : found) sources.push_back({path, text});
  return sources;
}

}  // namespace restlab
