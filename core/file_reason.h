// Why a file cannot be read, in the words of the system.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace restlab {

// "no such file", "cannot be read: Permission denied", and so on. "" where it opens for reading.
std::string unreadableReason(const std::filesystem::path& file);

// The status could not be had: something may be there, and the system does not say what.
bool isHidden(const std::error_code& status);

}  // namespace restlab
