#include "tests/lint/folders.h"

#include <algorithm>
#include <regex>

namespace restlab::lint {

namespace {

// Returns the folder of a path below `root`; "" if the path is elsewhere or in `root` itself.
std::string folderOf(const std::string& root, const std::string& path) {
  if (path.rfind(root, 0) != 0) return "";
  const size_t slash = path.find('/', root.size());
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

// Extends `way` to the first folder that it meets again; false if it meets none.
bool findCycle(const FolderIncludes& includes, std::vector<std::string>& way,
               std::set<std::string>& known) {
  const auto found = includes.find(way.back());
  if (found == includes.end() || !known.insert(way.back()).second) return false;
  for (const auto& [next, file] : found->second) {
    const bool isBehind = std::find(way.begin(), way.end(), next) != way.end();
    way.push_back(next);
    if (isBehind || findCycle(includes, way, known)) return true;
    way.pop_back();
  }
  return false;
}

}  // namespace

FolderIncludes folderIncludes(const std::string& root, const std::vector<SourceText>& files) {
  static const std::regex include("(?:^|\n)#include \"([^\"\n]+)\"");
  FolderIncludes includes;
  for (const SourceText& file : files) {
    const std::string from = folderOf(root, file.path);
    if (from.empty()) continue;
    for (std::sregex_iterator it(file.text.begin(), file.text.end(), include), end; it != end;
         ++it) {
      const std::string to = folderOf(root, (*it)[1]);
      if (!to.empty() && to != from) includes[from].emplace(to, file.path);
    }
  }
  return includes;
}

std::string folderCycle(const FolderIncludes& includes) {
  std::set<std::string> known;
  for (const auto& [folder, to] : includes) {
    std::vector<std::string> way = {folder};
    if (!findCycle(includes, way, known)) continue;
    std::string text;
    auto at = std::find(way.begin(), way.end(), way.back());
    for (; at + 1 != way.end(); ++at)
      text += *at + " -> " + *(at + 1) + " by " + includes.at(*at).at(*(at + 1)) + "\n";
    return text;
  }
  return "";
}

}  // namespace restlab::lint
