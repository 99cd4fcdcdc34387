// `include = ["base.toml", ...]` of a TOML file: what several files say as one document.
#pragma once

#include <filesystem>
#include <string>

#include <toml++/toml.h>

namespace restlab {

// Text of a regular file of at most 1 MiB; throws Error (badUsage) naming the file.
std::string readTomlText(const std::filesystem::path& file);

// Parses `text`, whose name in messages is `name`, with the files it includes, relative to
// `folder`, and theirs. Own keys win over included ones, later files over earlier ones; tables are
// merged, arrays of tables ([[method]]) are joined, the included first. Every node keeps the file,
// line and column it comes from. Throws Error (badUsage): what is no TOML, a file that includes
// itself.
toml::table parseTomlWithIncludes(const std::string& text, const std::string& name,
                                  const std::filesystem::path& folder);

// "file:line:column"; `file` where the source does not say.
std::string tomlPlace(const toml::source_region& source, const std::string& file);

}  // namespace restlab
