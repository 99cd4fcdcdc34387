// Parts of the module, each in a file of its own.
#pragma once

#include <pybind11/pybind11.h>

namespace restlab::python {

void addSession(pybind11::module_& module);    // Session, FrameStats
void addReference(pybind11::module_& module);  // Reference, reference, read_reference
void addMetrics(pybind11::module_& module);    // metric, metrics, bias_rms
void addImages(pybind11::module_& module);     // read_exr, write_exr, write_png
void addResults(pybind11::module_& module);    // load_results
void addBias(pybind11::module_& module);       // bias
void addLists(pybind11::module_& module);      // scenes, integrators, ...

}  // namespace restlab::python
