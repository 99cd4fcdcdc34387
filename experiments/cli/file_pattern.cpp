#include "experiments/cli/file_pattern.h"

#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace restlab {

namespace fs = std::filesystem;

namespace {

bool isPresent(const fs::path& file) {
  std::error_code status;
  return fs::exists(fs::symlink_status(file, status));
}

// Returns the entries of `folder` that match one component of a pattern.
std::vector<fs::path> matches(const fs::path& folder, const fs::path& part) {
  if (part.empty()) return {folder / ""};
  if (isPresent(folder / part)) return {folder / part};
  std::vector<fs::path> found;
  std::error_code error;
  fs::directory_iterator it(folder.empty() ? fs::path(".") : folder, error), end;
  for (; !error && it != end; it.increment(error)) {
    const fs::path name = it->path().filename();
    if (fnmatch(part.c_str(), name.c_str(), FNM_PERIOD) == 0) found.push_back(folder / name);
  }
  return found;
}

}  // namespace

std::vector<std::string> filesLike(const std::string& pattern) {
  const fs::path whole(pattern);
  std::vector<fs::path> found = {whole.root_path()};
  for (const fs::path& part : whole.relative_path()) {
    std::vector<fs::path> longer;
    for (const fs::path& folder : found)
      for (fs::path& one : matches(folder, part)) longer.push_back(std::move(one));
    found = std::move(longer);
  }
  std::vector<std::string> names;
  for (const fs::path& file : found)
    if (isPresent(file)) names.push_back(file.string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace restlab
