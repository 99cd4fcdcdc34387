// Folder locks on file systems without locks, like some network ones: flock() is replaced.
#include "experiments/runner/results/folder_lock.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "core/base/error.h"
#include "tests/runner/temporary_folder.h"

namespace {
int reason = 0;  // of the failure; 0: calls the system's flock
}

extern "C" int flock(int file, int operation) {
  if (reason == 0) return int(syscall(SYS_flock, file, operation));
  errno = reason;
  return -1;
}

namespace restlab {

namespace {

class FolderLockTest : public TemporaryFolder {};

TEST_F(FolderLockTest, WhereThereAreNoLocksOneLineSaysSo) {
  reason = ENOLCK;
  testing::internal::CaptureStderr();
  { const FolderLock lock(folder()); }
  const std::string said = testing::internal::GetCapturedStderr();
  reason = 0;
  EXPECT_EQ(said.rfind("warning: " + folder().string() + ": cannot be locked (", 0), 0u) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
  testing::internal::CaptureStderr();
  const FolderLock lock(folder());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THROW(FolderLock{folder()}, Error) << "this one keeps others out";
}

}  // namespace

}  // namespace restlab
