// A small file system that only this process and its children see.
#pragma once

#include <filesystem>
#include <string>

namespace restlab::cli_test {

// RAII: mounted at an existing folder during its lifetime.
class SmallDisk {
 public:
  // `options` of tmpfs: "size=160k", "size=1m,ro".
  SmallDisk(const std::filesystem::path& folder, const std::string& options);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  // Returns why mounting failed, e.g. missing rights; "" if mounted.
  const std::string& whyNot() const { return whyNot_; }
  // Changes the options and keeps the files.
  bool remount(const std::string& options, bool isReadOnly = false);

 private:
  std::filesystem::path folder_;
  std::string whyNot_;
};

}  // namespace restlab::cli_test
