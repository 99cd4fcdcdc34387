// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

namespace restlab {

// Writes to a temporary neighbour of `file`; commit() gives it the final name, and destruction
// without commit() removes it. A symbolic link is followed, so the file it names is replaced.
// Every failure throws Error (badInput) naming the file and the operating system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Its failures need no checks: commit() throws if any write failed.
  std::ofstream& stream() { return stream_; }
  void commit();

 private:
  std::filesystem::path file_, target_, temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

// Keeps the names of files that are to be gone with the process, as an AtomicFile's temporary
// neighbour is. From any thread.
void addTemporaryFile(const std::filesystem::path& file);
void forgetTemporaryFile(const std::filesystem::path& file);
// Removes them, for a process that ends at once: whoever adds another one waits for the end.
void removeTemporaryFiles();

// The whole of `text` into `file`.
void writeTextFile(const std::filesystem::path& file, std::string_view text);

}  // namespace restlab
