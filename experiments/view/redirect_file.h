// A page on the disk that leads to an address with a secret, for programs that open a browser: what
// they are called with every user of the machine can read, and this file its owner alone.
#pragma once

#include <filesystem>
#include <string>

namespace restlab {

class RedirectFile {
 public:
  // In the user's runtime folder, or that of temporary files. Throws Error (badInput) where it
  // cannot be written.
  explicit RedirectFile(const std::string& url);
  // Removes it.
  ~RedirectFile();
  RedirectFile(const RedirectFile&) = delete;
  RedirectFile& operator=(const RedirectFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace restlab
