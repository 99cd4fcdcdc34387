// The module `restlab` of Python.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "core/backend/kernel_choice.h"
#include "core/base/error.h"
#include "experiments/python/bindings.h"
#include "experiments/python/call.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/kernel_progress.h"
#include "experiments/runner/base/log.h"

namespace py = pybind11;
using namespace restlab;

namespace {

constexpr const char* kHelp =
    "restlab: sessions, references, metrics and results of restlab for scripts.\n\n"
    "Images are arrays of numpy: float32 (height, width, 3), linear Rec. 709, row 0 on top.\n"
    "Errors are restlab.Error, with one line. docs/python.md has examples.";

// Words of the command for what is written to files.
void takeArguments() {
  const py::object argv = py::getattr(py::module_::import("sys"), "orig_argv", py::list());
  std::vector<std::string> words;
  for (const py::handle& word : argv)
    words.push_back(py::bytes(py::str(word).attr("encode")("utf-8", "replace")));
  setArguments(words);
}

void addVerbosity(py::module_& module) {
  module.def(
      "set_verbosity",
      [](int level) {
        if (level < -1 || level > 1)
          failUsage(fmt::format("set_verbosity {}: must be -1, 0 or 1", level));
        setVerbosity(level);
      },
      py::arg("level"),
      "What is said on stderr. -1: warnings alone; 0: as the program does, with progress; 1: "
      "details.");
}

}  // namespace

PYBIND11_MODULE(restlab, module) {
  module.doc() = kHelp;
  // Loads numpy now. pybind11 does so once, in a static variable: of two threads, one would wait
  // for the other with the interpreter's lock.
  py::dtype::of<float>();
  python::addError(module);
  python::waitForCallsAtExit();
  checkDefaultKernelChoice();
  logCompiledKernels();
  takeArguments();
  module.attr("__version__") = buildInfo().version;
  addVerbosity(module);
  python::addSession(module);
  python::addReference(module);
  python::addMetrics(module);
  python::addImages(module);
  python::addResults(module);
  python::addBias(module);
  python::addLists(module);
}
