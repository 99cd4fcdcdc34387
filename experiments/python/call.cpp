#include "experiments/python/call.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <mutex>

#include "core/backend/stop.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

std::mutex scopesMutex;
size_t scopes = 0;
struct sigaction handlerBefore = {};  // written only while no handler of ours is installed

// Python notes the signal first: whoever sees a stopped frame finds it noted.
void passThenStop(int signal) {
  handlerBefore.sa_handler(signal);
  stopFrames();
}

void install() {
  struct sigaction present = {};
  sigaction(SIGINT, nullptr, &present);
  const bool isFunction = (present.sa_flags & SA_SIGINFO) == 0 && present.sa_handler != SIG_IGN &&
                          present.sa_handler != SIG_DFL;
  if (!isFunction || present.sa_handler == passThenStop) return;
  handlerBefore = present;
  struct sigaction ours = present;
  ours.sa_handler = passThenStop;
  sigaction(SIGINT, &ours, nullptr);
}

void uninstall() {
  struct sigaction present = {};
  sigaction(SIGINT, nullptr, &present);
  // Leave a handler that was set while frames ran.
  const bool isOurs = (present.sa_flags & SA_SIGINFO) == 0 && present.sa_handler == passThenStop;
  if (isOurs) sigaction(SIGINT, &handlerBefore, nullptr);
}

}  // namespace

InterruptScope::InterruptScope() {
  const std::lock_guard lock(scopesMutex);
  if (scopes++ == 0) install();
}

InterruptScope::~InterruptScope() {
  const std::lock_guard lock(scopesMutex);
  if (--scopes > 0) return;
  uninstall();
  resumeFrames();
}

void addError(py::module_& module) {
  static PyObject* type = PyErr_NewExceptionWithDoc(
      "restlab.Error",
      "What is wrong with a setting, a file or a device, in one line.\n\n"
      "exit_code is the one that the program would end with: 2 bad usage, 3 bad input,\n"
      "4 device unavailable, 130 interrupted.",
      PyExc_RuntimeError, nullptr);
  if (type == nullptr) throw py::error_already_set();
  module.add_object("Error", py::reinterpret_borrow<py::object>(type));
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

void requireOwnProcess() {
  static std::atomic<pid_t> owner = 0;
  pid_t none = 0;
  const pid_t self = getpid();
  if (owner.compare_exchange_strong(none, self) || none == self) return;
  failUsage(
      "this process was forked from one that has used restlab, whose threads it lacks; start it "
      "anew: multiprocessing.set_start_method('spawn')");
}

void raiseInterrupt(const Error& error) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  throw Error(error.code(), error.what());
}

}  // namespace restlab::python
