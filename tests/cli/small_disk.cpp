#include "tests/cli/small_disk.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace restlab::cli_test {

namespace {

// Makes mounts of this process invisible to others. Without root rights this needs a user
// namespace, if the system has them.
bool separateMounts() {
  static const bool done = [] {
    const uid_t user = geteuid();
    const gid_t group = getegid();
    if (unshare(CLONE_NEWNS) != 0) {
      if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
      std::ofstream("/proc/self/setgroups") << "deny";
      std::ofstream("/proc/self/uid_map") << fmt::format("0 {} 1", user);
      std::ofstream("/proc/self/gid_map") << fmt::format("0 {} 1", group);
    }
    return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
  }();
  return done;
}

}  // namespace

SmallDisk::SmallDisk(const std::filesystem::path& folder, const std::string& options)
    : folder_(folder) {
  if (separateMounts() && mount("tmpfs", folder.c_str(), "tmpfs", 0, options.c_str()) == 0) return;
  whyNot_ = fmt::format("SKIPPED: no file system can be mounted here: {}", std::strerror(errno));
}

SmallDisk::~SmallDisk() {
  if (whyNot_.empty()) umount2(folder_.c_str(), MNT_DETACH);
}

bool SmallDisk::remount(const std::string& options, bool isReadOnly) {
  const unsigned long flags = MS_REMOUNT | (isReadOnly ? MS_RDONLY : 0);
  return mount("tmpfs", folder_.c_str(), "tmpfs", flags, options.c_str()) == 0;
}

}  // namespace restlab::cli_test
