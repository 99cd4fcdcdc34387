#include "core/base/file_reason.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace restlab {

std::string unreadableReason(const std::filesystem::path& file) {
  // O_NONBLOCK: do not wait for the other end of a pipe.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor >= 0) {
    ::close(descriptor);
    return "";
  }
  if (errno == ENOENT) return "no such file";
  return "cannot be read: " + std::generic_category().message(errno);
}

bool isHidden(const std::error_code& status) {
  return status && status != std::errc::no_such_file_or_directory &&
         status != std::errc::not_a_directory && status != std::errc::filename_too_long;
}

}  // namespace restlab
