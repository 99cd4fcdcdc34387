// Lock that lets only one program work in a folder.
#pragma once

#include <filesystem>

namespace restlab {

// RAII: holds the lock until destruction; the system frees that of a killed process. Throws Error
// (badInput) with the other process's number if the folder is locked, and if it cannot be written
// to.
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
