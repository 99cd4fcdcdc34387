// Reasons why a file cannot be read, in the words of the system.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace restlab {

// Returns "no such file", "cannot be read: Permission denied", and so on; "" if the file opens for
// reading.
std::string unreadableReason(const std::filesystem::path& file);

// Returns whether the status is unavailable: a file may be there, but the system does not tell.
bool isHidden(const std::error_code& status);

}  // namespace restlab
