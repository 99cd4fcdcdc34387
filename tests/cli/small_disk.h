// A file system of a size of its own, which only this process and its children see.
#pragma once

#include <filesystem>
#include <string>

namespace restlab::cli_test {

// At a folder that exists, until this ends.
class SmallDisk {
 public:
  // `options` of tmpfs: "size=160k", "size=1m,ro".
  SmallDisk(const std::filesystem::path& folder, const std::string& options);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  // Why there is none: nobody may mount file systems here, say; "" where there is one.
  const std::string& whyNot() const { return whyNot_; }
  // With other options; what it holds stays.
  bool remount(const std::string& options, bool isReadOnly = false);

 private:
  std::filesystem::path folder_;
  std::string whyNot_;
};

}  // namespace restlab::cli_test
