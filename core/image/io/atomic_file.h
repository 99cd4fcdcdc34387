// Files that appear complete or not at all.
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

namespace restlab {

// Follows the name of a file in the names of its temporary neighbours.
constexpr const char* kTemporary = ".tmp-";

// Writes to a temporary neighbour of `file`; commit() gives it the final name, and destruction
// without commit() removes it. A symbolic link is followed, so the file it names is replaced.
// Every failure throws Error (badInput) naming the file and the operating system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Stream to write to. Callers need not check it: commit() throws if any write failed.
  std::ofstream& stream() { return stream_; }
  void commit();
  // Gives the final name only if no file has it. Returns false if one has, which stays: of several
  // writers on several machines the first one wins.
  bool commitNew();

 private:
  void close();
  std::filesystem::path file_, target_, temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

// Register and unregister files to be removed with the process, such as the temporary neighbour of
// an AtomicFile. Thread-safe.
void addTemporaryFile(const std::filesystem::path& file);
void forgetTemporaryFile(const std::filesystem::path& file);
// Removes the registered files, for a process that ends at once. addTemporaryFile() then blocks
// until the process ends.
void removeTemporaryFiles();

// Writes all of `text` to `file`.
void writeTextFile(const std::filesystem::path& file, std::string_view text);

}  // namespace restlab
