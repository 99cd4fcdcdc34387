// Marks of tasks at work: who does what, and how it ended without a result.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/runner/cluster/asked.h"

namespace restlab {

struct Mark {
  std::string node, job, started;  // job: of the scheduler, "ID_INDEX"; "" without one
  int process = 0;
  Asked asked;        // of the scheduler; zeros where nothing was asked for
  std::string error;  // the line that ended it; "" while it works, and if it was killed
};

// Names of the variables by which a script tells what it asked for, in MiB and seconds.
constexpr const char* kAskedMemory = "RESTLAB_ASKED_MIB";
constexpr const char* kAskedTime = "RESTLAB_ASKED_S";

// Marks a task as being at work here. The mark goes when the result is there; it stays, with the
// line, after an error; and it stays as it is if the process is killed.
class TaskMark {
 public:
  TaskMark(const std::filesystem::path& folder, uint64_t index);
  void done();
  // Never throws: the error itself matters more.
  void failed(const std::string& line);

 private:
  void write(const std::string& error) const;
  std::filesystem::path file_;
  std::string started_;
};

// Returns the mark of a task, if there is a whole one.
std::optional<Mark> readMark(const std::filesystem::path& folder, uint64_t index);

// Returns whether the process of the mark runs, if it is of this machine; nothing if it is of
// another one.
std::optional<bool> isAlive(const Mark& mark);

}  // namespace restlab
