// Calls of the library from Python: errors become exceptions, long work leaves the interpreter to
// other threads, and signals and the interpreter's exit end it.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <type_traits>

#include "core/base/error.h"

namespace restlab::python {

// Adds restlab.Error, with its exit code, and translates Error to it.
void addError(pybind11::module_& module);

// Has the interpreter's exit stop frames, and wait until no other thread is in a call.
void waitForCallsAtExit();

// RAII: a call that the interpreter's exit waits for. Made and destroyed with the interpreter's
// lock. Once the interpreter ends, other threads than the last one stay here. Throws Error
// (badUsage) in a process that was forked while a thread was in a call.
class CallScope {
 public:
  CallScope();
  ~CallScope();
  CallScope(const CallScope&) = delete;
  CallScope& operator=(const CallScope&) = delete;
};

// Whether handlers of signals run in this thread.
bool isMainThread();

// Runs `work` in a thread of its own, while this one runs Python's handlers of signals. Where one
// raises, `work` is stopped (core/backend/stop_scope.h), and what was raised is thrown.
void runInterruptibly(const std::function<void()>& work);

// Notes that this process uses Vulkan. Throws Error (badUsage) where it was forked from one that
// did: threads of the driver are not there, and a frame would wait for them.
void useVulkan();

// Runs `work` without the interpreter's lock. `work` must touch no Python object.
template <class Work>
auto withoutPython(const Work& work) {
  const CallScope call;
  const pybind11::gil_scoped_release release;
  return work();
}

// As withoutPython(), for work that renders: signals end it in the main thread, the interpreter's
// exit in all others.
template <class Work>
auto rendering(const Work& work) {
  if (!isMainThread()) return withoutPython(work);
  const CallScope call;
  using Result = std::invoke_result_t<const Work&>;
  if constexpr (std::is_void_v<Result>) {
    runInterruptibly(work);
  } else {
    std::optional<Result> result;
    runInterruptibly([&] { result.emplace(work()); });
    return std::move(*result);
  }
}

}  // namespace restlab::python
