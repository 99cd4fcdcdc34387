// Order of the folders of experiments/: which one includes files of which.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/lint/rules.h"

namespace restlab::lint {

// Names, of each folder below `root`, the others that its files include, with one such file each.
// `root` ends in '/'; the folders below its folders count as part of them.
using FolderIncludes = std::map<std::string, std::map<std::string, std::string>>;
FolderIncludes folderIncludes(const std::string& root, const std::vector<SourceText>& files);

// Returns a cycle as lines "a -> b by a/file.cpp"; "" if there is none.
std::string folderCycle(const FolderIncludes& includes);

}  // namespace restlab::lint
