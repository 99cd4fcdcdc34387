#include "core/base/config_include.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "core/base/error.h"
#include "core/base/file_reason.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// Far above any file of settings.
constexpr size_t kMaxFileBytes = size_t(1) << 20;
// Limit on includes: files that each include another one twice are read 2^n times.
constexpr size_t kMaxIncludes = 100;

bool isArrayOfTables(const toml::node& node) {
  return node.is_array() && !node.as_array()->empty() &&
         node.as_array()->is_homogeneous(toml::node_type::table);
}

// Moves the content of `own` into `all`, replacing existing values.
void mergeInto(toml::table& all, toml::table&& own) {
  for (auto&& [key, value] : own) {
    toml::node* there = all.get(key);
    if (there != nullptr && there->is_table() && value.is_table()) {
      mergeInto(*there->as_table(), std::move(*value.as_table()));
    } else if (there != nullptr && isArrayOfTables(*there) && isArrayOfTables(value)) {
      for (toml::node& element : *value.as_array())
        there->as_array()->push_back(std::move(*element.as_table()));
    } else {
      value.visit([&](auto& typed) { all.insert_or_assign(key, std::move(typed)); });
    }
  }
}

toml::table parse(const std::string& text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    failUsage(fmt::format("{}: {}", tomlPlace(error.source(), name), error.description()));
  }
}

// Parses a text and its includes. `open`: the files whose includes are being read, to detect a file
// that includes itself. `included`: number of files included so far.
toml::table parseOpen(const std::string& text, const std::string& name, const fs::path& folder,
                      std::vector<fs::path>& open, size_t& included) {
  toml::table own = parse(text, name);
  toml::table all;
  const toml::node* include = own.get("include");
  std::vector<std::pair<std::string, std::string>> files;  // file, and the place that names it
  if (include != nullptr) {
    const std::string place = tomlPlace(include->source(), name);
    const auto add = [&](const toml::node& node) {
      const auto file = node.value_exact<std::string>();
      if (!file) failUsage(fmt::format("{}: 'include' must hold names of files", place));
      files.emplace_back(*file, tomlPlace(node.source(), name));
    };
    if (const toml::array* array = include->as_array()) {
      for (const toml::node& element : *array) add(element);
    } else {
      add(*include);
    }
    own.erase("include");
  }
  for (const auto& [file, place] : files) {
    const fs::path path = folder / file;
    std::error_code status;
    const fs::path whole = fs::weakly_canonical(path, status);
    if (std::find(open.begin(), open.end(), whole) != open.end())
      failUsage(fmt::format("{}: '{}' includes itself", place, file));
    if (++included > kMaxIncludes)
      failUsage(fmt::format("{}: more than {} files are included", place, kMaxIncludes));
    open.push_back(whole);
    std::string content;
    try {
      content = readTomlText(path);
    } catch (const Error& error) {
      failUsage(fmt::format("{}: {}", place, error.what()));
    }
    mergeInto(all, parseOpen(content, path.string(), path.parent_path(), open, included));
    open.pop_back();
  }
  if (files.empty()) return own;
  mergeInto(all, std::move(own));
  return all;
}

}  // namespace

std::string tomlPlace(const toml::source_region& source, const std::string& file) {
  const std::string name = source.path ? *source.path : file;
  if (source.begin.line == 0) return name;
  return fmt::format("{}:{}:{}", name, source.begin.line, source.begin.column);
}

std::string readTomlText(const fs::path& file) {
  std::error_code status;
  if (fs::is_directory(file, status))
    failUsage(fmt::format("{}: is a directory, not a TOML file", file.string()));
  if (fs::exists(file, status) && !fs::is_regular_file(file, status))
    failUsage(fmt::format("{}: is not a regular file", file.string()));  // a device may never end
  std::ifstream in(file, std::ios::binary);
  if (!in) failUsage(fmt::format("{}: {}", file.string(), unreadableReason(file)));
  std::string text(kMaxFileBytes + 1, '\0');
  in.read(text.data(), std::streamsize(text.size()));
  text.resize(size_t(in.gcount()));
  if (text.size() > kMaxFileBytes) {
    failUsage(fmt::format("{}: is larger than {} bytes, no TOML file of settings", file.string(),
                          kMaxFileBytes));
  }
  return text;
}

toml::table parseTomlWithIncludes(const std::string& text, const std::string& name,
                                  const fs::path& folder) {
  std::error_code status;
  std::vector<fs::path> open = {fs::weakly_canonical(fs::path(name), status)};
  size_t included = 0;
  return parseOpen(text, name, folder, open, included);
}

}  // namespace restlab
