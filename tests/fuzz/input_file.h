// The bytes as a file, and what may come of reading it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "core/error.h"

namespace restlab::fuzz {

// Writes the bytes to `name` in a temporary folder of this process, over what was there.
std::filesystem::path inputFile(const char* name, const uint8_t* bytes, size_t count);

// Runs `read`. False where it throws an Error of this exit code whose one line of plain text begins
// with the file's name; throws std::logic_error for any other Error.
bool isRead(const std::filesystem::path& file, ExitCode refusal, const std::function<void()>& read);

}  // namespace restlab::fuzz
