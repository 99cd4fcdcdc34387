// Rules for what people read: comments, documents, and the paths that both name.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tests/lint/rules.h"

namespace restlab::lint {

// Returns comments of C++ or the dialect that begin with a word which leaves the subject to another
// line: Of, Those, Who, Whose, What is, As it, That which.
std::vector<Finding> findRiddles(const std::string& path, const std::string& text);

// Returns sentences of a Markdown text with more than `most` words, by the line of their paragraph.
// Code blocks, tables and headings are left out.
std::vector<Finding> findLongSentences(const std::string& path, const std::string& text,
                                       size_t most = 40);

// Returns paths below the top-level folders that the text names and that are not in `paths`:
// files, files without their extension, and folders of the repository.
std::vector<Finding> findMissingPaths(const std::string& path, const std::string& text,
                                      const std::set<std::string>& paths);

}  // namespace restlab::lint
