#include "core/image/io/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <mutex>
#include <set>
#include <system_error>

#include "core/base/error.h"
#include "core/image/image.h"

namespace restlab {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failFile(const fs::path& file, const std::string& what) {
  failInput(fmt::format("{}: {}", file.string(), what));
}

std::string systemReason(int code) {
  return code == 0 ? "unknown reason" : std::generic_category().message(code);
}

// Returns the file that `file` names after following symbolic links; throws unless it may be
// created.
fs::path resolveTarget(const fs::path& file) {
  if (file.empty()) failInput("output file: the name is empty");
  if (!file.has_filename()) failFile(file, "is a directory; name a file in it");
  std::error_code error;
  fs::path target = file;
  if (fs::is_symlink(fs::symlink_status(target, error))) {
    target = fs::weakly_canonical(target, error);
    if (error) failFile(file, "cannot follow the symbolic link: " + error.message());
  }
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) failFile(file, "is a directory; name a file in it");
  // Refuse devices and pipes: replacing one by a file is never intended.
  if (fs::exists(status) && !fs::is_regular_file(status)) failFile(file, "is not a regular file");
  if (fs::exists(status) && ::access(target.c_str(), W_OK) != 0) {
    failFile(file, "cannot be overwritten: " + systemReason(errno));
  }
  const fs::path directory = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const fs::file_status parent = fs::status(directory, error);
  if (!fs::exists(parent)) {
    failFile(file, "the directory " + directory.string() + " does not exist");
  }
  if (!fs::is_directory(parent)) failFile(file, directory.string() + " is not a directory");
  return target;
}

// Makes a name that is unique among machines by theirs, among processes by pid and within one by a
// counter.
fs::path temporaryNameFor(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  char machine[65] = {};
  if (::gethostname(machine, sizeof(machine) - 1) != 0) machine[0] = '\0';
  fs::path name = target;
  name += fmt::format("{}{}-{}-{}", kTemporary, ::getpid(), counter++, machine);
  return name;
}

struct TemporaryFiles {
  std::mutex mutex;
  std::set<fs::path> names;
};

// Never destroyed: threads may write files until the process ends.
TemporaryFiles& temporaryFiles() {
  static auto* files = new TemporaryFiles;
  return *files;
}

}  // namespace

void addTemporaryFile(const fs::path& file) {
  const std::scoped_lock lock(temporaryFiles().mutex);
  temporaryFiles().names.insert(file);
}

void forgetTemporaryFile(const fs::path& file) {
  const std::scoped_lock lock(temporaryFiles().mutex);
  temporaryFiles().names.erase(file);
}

void removeTemporaryFiles() {
  temporaryFiles().mutex.lock();  // never unlocked
  std::error_code ignored;
  for (const fs::path& name : temporaryFiles().names) fs::remove(name, ignored);
}

AtomicFile::AtomicFile(const fs::path& file)
    : file_(file), target_(resolveTarget(file)), temporary_(temporaryNameFor(target_)) {
  addTemporaryFile(temporary_);
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (stream_) return;
  const int reason = errno;
  forgetTemporaryFile(temporary_);
  failFile(file_, "cannot be created: " + systemReason(reason));
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  stream_.close();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
  forgetTemporaryFile(temporary_);
}

void AtomicFile::close() {
  if (!stream_) failFile(file_, "cannot be written: a write failed (is the disk full?)");
  errno = 0;
  stream_.close();
  if (!stream_) failFile(file_, "cannot be written: " + systemReason(errno));
}

bool AtomicFile::commitNew() {
  close();
  std::error_code error, ignored;
  fs::create_hard_link(temporary_, target_, error);
  // A network file system may repeat a request that was done, and then say that the name exists.
  const bool isLinked = !error || fs::hard_link_count(temporary_, ignored) == 2;
  if (!isLinked && !fs::exists(target_, ignored)) {
    commit();  // there are no links on this file system
    return true;
  }
  return isLinked;  // destruction removes the temporary name
}

void AtomicFile::commit() {
  if (stream_.is_open()) close();
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) failFile(file_, "cannot be written: " + error.message());
  committed_ = true;
  forgetTemporaryFile(temporary_);
}

void writeTextFile(const fs::path& file, std::string_view text) {
  AtomicFile output(file);
  output.stream().write(text.data(), std::streamsize(text.size()));
  output.commit();
}

void checkWritable(const fs::path& file) {
  // Creates and removes the temporary neighbour: writing will need the same permissions.
  AtomicFile probe(file);
}

}  // namespace restlab
