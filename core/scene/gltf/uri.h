// URIs of buffers and images: data URIs, percent escapes, and the files that may be opened.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/gltf/report.h"

namespace restlab::gltf {

struct DataUri {
  std::string mediaType;  // spelling of the URI, without parameters; may be empty
  std::vector<uint8_t> bytes;
};

bool isDataUri(std::string_view uri);

// Decodes a data URI, base64 or percent-escaped. Fails at `place` when it is malformed; warns if it
// breaks a rule but is readable.
DataUri decodeDataUri(std::string_view uri, const std::string& place, Report& report);

// Returns the regular file that a relative URI names, below `directory`. Fails at `place` on
// schemes, absolute paths, paths leaving the directory and missing files; warns if a percent sign
// of the name is not escaped.
std::filesystem::path resolveUri(const std::string& uri, const std::filesystem::path& directory,
                                 const std::string& place, Report& report);

// Converts a UTF-8 file name to a path, whatever the locale.
std::filesystem::path pathFromUtf8(const std::string& name);

}  // namespace restlab::gltf
