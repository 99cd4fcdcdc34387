// Calls of the library from Python: errors become exceptions, long work leaves the interpreter to
// other threads, and Ctrl+C ends it.
#pragma once

#include <pybind11/pybind11.h>

#include <type_traits>

#include "core/base/error.h"

namespace restlab::python {

// Lets SIGINT stop frames (core/backend/stop.h) while it lives, besides what Python does. A handler
// that Python does not have (SIG_IGN, SIG_DFL) is left alone. Several threads may have one at once.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;
};

// Adds restlab.Error, with its exit code, and translates Error to it.
void addError(pybind11::module_& module);

// Throws Error (badUsage) in a process that was forked from one that has rendered: the threads of
// the parent are not there, and a frame would wait for them.
void requireOwnProcess();

// Raises what Python's handlers of signals raise, KeyboardInterrupt as a rule; else throws `error`
// on.
[[noreturn]] void raiseInterrupt(const Error& error);

// Runs `work` without the interpreter's lock. `work` must touch no Python object.
template <class Work>
auto withoutPython(const Work& work) {
  requireOwnProcess();
  try {
    const InterruptScope interrupts;
    const pybind11::gil_scoped_release release;
    return work();
  } catch (const Error& error) {
    if (error.code() == ExitCode::interrupted) raiseInterrupt(error);
    throw;
  }
}

}  // namespace restlab::python
