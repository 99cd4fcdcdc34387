#include "experiments/runner/results/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/base/error.h"
#include "experiments/runner/base/log.h"

namespace restlab {

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::filesystem::path name = folder / ".lock";
  file_ = open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0)
    failInput(fmt::format("{}: cannot be written: {}", name.string(), std::strerror(errno)));
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    const int reason = errno;
    char holder[32] = {};
    const ssize_t length = read(file_, holder, sizeof(holder) - 1);
    close(file_);
    file_ = -1;
    // File systems without locks: only warn.
    if (reason != EWOULDBLOCK) {
      logWarning(
          fmt::format("{}: cannot be locked ({}): see to it that no second restlab works "
                      "there",
                      folder.string(), std::strerror(reason)));
      return;
    }
    failInput(
        fmt::format("{}: another restlab (process {}) is at work there; wait for it or choose "
                    "another folder",
                    folder.string(), length > 0 ? holder : "?"));
  }
  const std::string own = std::to_string(getpid());
  // The process number is only used in messages: ignore errors.
  if (ftruncate(file_, 0) != 0 || write(file_, own.data(), own.size()) < 0) return;
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace restlab
