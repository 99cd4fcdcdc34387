#include "experiments/python/call.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "core/backend/stop.h"
#include "core/backend/stop_scope.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

// How long a signal may wait for its handler.
constexpr std::chrono::milliseconds kPatience{20};
constexpr const char* kSpawn = "start it anew: multiprocessing.set_start_method('spawn')";

// Calls under way. Whoever locks the mutex with the interpreter's lock lets go of it at once.
std::mutex callsMutex;
std::condition_variable callsEnd;
size_t calls = 0;
pid_t process = getpid();        // that of the calls
bool isForkedFromCalls = false;  // its parent was in calls: locks that they held stay closed
std::optional<std::thread::id> lastThread;  // set once the interpreter ends: only it may call

// Notes a fork since the last call. With callsMutex, which no other thread held at the fork: it is
// held with the interpreter's lock.
void enterProcess() {
  if (process == getpid()) return;
  process = getpid();
  isForkedFromCalls = isForkedFromCalls || calls > 0;
  calls = 0;
}

[[noreturn]] void failForked() {
  failUsage(
      fmt::format("this process was forked while a thread was in a call of restlab; {}", kSpawn));
}

// Whether the interpreter ends, and this is not its last thread.
bool isOver() { return lastThread && *lastThread != std::this_thread::get_id(); }

// Never returns. An exception would be printed while the interpreter takes stderr apart.
[[noreturn]] void waitForTheEnd() {
  const py::gil_scoped_release release;
  while (true) pause();
}

void endCalls() {
  const py::gil_scoped_release release;
  std::unique_lock lock(callsMutex);
  lastThread = std::this_thread::get_id();
  enterProcess();
  if (isForkedFromCalls) return;
  stopFrames();
  callsEnd.wait(lock, [] { return calls == 0; });
  resumeFrames();
}

}  // namespace

CallScope::CallScope() {
  std::unique_lock lock(callsMutex);
  if (isOver()) {
    lock.unlock();
    waitForTheEnd();
  }
  enterProcess();
  if (isForkedFromCalls) failForked();
  ++calls;
}

CallScope::~CallScope() {
  std::unique_lock lock(callsMutex);
  if (process != getpid()) {  // a handler of signals has forked in the call
    enterProcess();
  } else if (--calls == 0) {
    callsEnd.notify_all();
  }
  if (!isOver()) return;
  lock.unlock();
  waitForTheEnd();
}

void waitForCallsAtExit() {
  if (PyInterpreterState_Get() != PyInterpreterState_Main())
    return;  // the process goes on after it
  py::module_::import("atexit").attr("register")(py::cpp_function(endCalls));
}

bool isMainThread() { return gettid() == getpid(); }

namespace {

// Work in a thread of its own. A process forked meanwhile has neither the thread nor an end of the
// locks that it holds: it must leave all of this as it is.
struct ThreadedWork {
  std::mutex mutex;
  std::condition_variable end;
  bool isDone = false;
  std::atomic<bool> isStopped = false;
  std::exception_ptr error;
  std::jthread thread;  // joined before the others go

  bool isDoneSoon() {
    const py::gil_scoped_release release;
    std::unique_lock lock(mutex);
    return end.wait_for(lock, kPatience, [&] { return isDone; });
  }
};

}  // namespace

void runInterruptibly(const std::function<void()>& work) {
  const pid_t parent = getpid();
  auto threaded = std::make_unique<ThreadedWork>();
  threaded->thread = std::jthread([&work, &own = *threaded] {
    const StopScope stops(&own.isStopped);
    try {
      work();
    } catch (...) {
      own.error = std::current_exception();
    }
    const std::lock_guard lock(own.mutex);
    own.isDone = true;
    own.end.notify_one();
  });
  std::optional<py::error_already_set> raised;
  while (!threaded->isDoneSoon()) {
    if (raised || PyErr_CheckSignals() != 0) {
      if (!raised) raised.emplace();
      threaded->isStopped = true;
    }
    if (getpid() == parent) continue;
    static_cast<void>(threaded.release());  // a handler has forked, and this is the child
    if (raised) throw py::error_already_set(*raised);
    failForked();
  }
  threaded->thread.join();
  if (raised) throw py::error_already_set(*raised);
  if (threaded->error) std::rethrow_exception(threaded->error);
}

void addError(py::module_& module) {
  static PyObject* type = PyErr_NewExceptionWithDoc(
      "restlab.Error",
      "What is wrong with a setting, a file or a device, in one line.\n\n"
      "exit_code is the one that the program would end with: 2 bad usage, 3 bad input,\n"
      "4 device unavailable, 130 interrupted. It is 3 for those that a script makes.",
      PyExc_RuntimeError, nullptr);
  if (type == nullptr) throw py::error_already_set();
  const auto added = py::reinterpret_borrow<py::object>(type);
  added.attr("exit_code") = int(ExitCode::badInput);
  module.add_object("Error", added);
  py::register_exception_translator([](std::exception_ptr caught) {
    try {
      if (caught) std::rethrow_exception(caught);
    } catch (const Error& error) {
      const py::object made = py::reinterpret_borrow<py::object>(type)(py::str(error.what()));
      made.attr("exit_code") = int(error.code());
      PyErr_SetObject(type, made.ptr());
    }
  });
}

void useVulkan() {
  static const pid_t user = getpid();
  if (user != getpid()) {
    failUsage(fmt::format(
        "vulkan: this process was forked from one that has used it, whose threads it lacks; {}",
        kSpawn));
  }
}

}  // namespace restlab::python
