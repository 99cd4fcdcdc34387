// One program at a time in a folder.
#pragma once

#include <filesystem>

namespace restlab {

// Held until destruction, also by a process that is killed. Throws Error (badInput) with the other
// process's number where one holds it, and where the folder cannot be written to.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace restlab
