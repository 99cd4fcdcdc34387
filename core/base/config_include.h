// `include = ["base.toml", ...]` in a TOML file: merges several files into one document.
#pragma once

#include <filesystem>
#include <string>

#include <toml++/toml.h>

namespace restlab {

// Text of a regular file of at most 1 MiB; throws Error (badUsage) naming the file.
std::string readTomlText(const std::filesystem::path& file);

// Parses `text`, called `name` in messages, with the files it includes (relative to `folder`) and
// their includes. Own keys win over included ones, later files over earlier ones; tables are
// merged, arrays of tables ([[method]]) are joined, the included first. Every node keeps the file,
// line and column it comes from. Throws Error (badUsage) on invalid TOML and on a file that
// includes itself.
toml::table parseTomlWithIncludes(const std::string& text, const std::string& name,
                                  const std::filesystem::path& folder);

// Formats "file:line:column"; only `file` if the source has no position.
std::string tomlPlace(const toml::source_region& source, const std::string& file);

}  // namespace restlab
