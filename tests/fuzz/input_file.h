// Writes fuzzed bytes to a file, and checks how reading it may fail.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "core/base/error.h"

namespace restlab::fuzz {

// Writes the bytes to `name` in a temporary folder of this process, replacing the file.
std::filesystem::path inputFile(const char* name, const uint8_t* bytes, size_t count);

// Runs `read`. Returns false if it throws an Error with this exit code and one line of plain text
// that begins with the file's name; throws std::logic_error for any other Error.
bool isRead(const std::filesystem::path& file, ExitCode refusal, const std::function<void()>& read);

}  // namespace restlab::fuzz
