// Temporary page that redirects to an address with a secret, for starting a browser: every user of
// the machine can read a program's arguments, but only the owner this file.
#pragma once

#include <filesystem>
#include <string>

namespace restlab {

class RedirectFile {
 public:
  // Writes to the user's runtime folder or the folder for temporary files. Throws Error (badInput)
  // if it cannot be written.
  explicit RedirectFile(const std::string& url);
  // Removes the file.
  ~RedirectFile();
  RedirectFile(const RedirectFile&) = delete;
  RedirectFile& operator=(const RedirectFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace restlab
