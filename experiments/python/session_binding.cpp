#include <fmt/format.h>
#include <pybind11/stl.h>

#include "experiments/python/bindings.h"
#include "experiments/python/session.h"
#include "experiments/python/values.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

py::list passesOf(const FrameStats& stats) {
  py::list all;
  for (const PassTiming& pass : stats.passes) {
    py::dict words;
    words["name"] = strOf(pass.name);
    words["time_ms"] = pass.timeMs;
    words["rays_path"] = pass.raysPath;
    words["rays_shadow"] = pass.raysShadow;
    words["once"] = pass.isOnce;
    all.append(words);
  }
  return all;
}

py::dict healthOf(const Health& health) {
  py::dict counts;
  for (size_t i = 0; i < health.counts.size(); ++i) counts[Health::names()[i]] = health.counts[i];
  return counts;
}

void addStats(py::module_& module) {
  py::class_<FrameStats>(module, "FrameStats", "Times and counts of a frame.")
      .def_readonly("time_ms", &FrameStats::timeMs,
                    "Sum of the passes, without work for the scene; milliseconds.")
      .def_readonly("scene_ms", &FrameStats::sceneMs, "Work for the scene that this frame did.")
      .def_readonly("rays_path", &FrameStats::raysPath, "Rays of paths.")
      .def_readonly("rays_shadow", &FrameStats::raysShadow, "Rays to lights.")
      .def_property_readonly("passes", &passesOf,
                             "One dict a pass: name, time_ms, rays_path, rays_shadow, once.")
      .def_property_readonly(
          "health", [](const FrameStats& stats) { return healthOf(stats.health); },
          "Counts of numerical health, by name.")
      .def("__repr__", [](const FrameStats& stats) {
        return fmt::format("<restlab.FrameStats {:.3f} ms, {} passes>", stats.timeMs,
                           stats.passes.size());
      });
}

constexpr const char* kSessionHelp =
    "A scene and a method that renders its frames.\n\n"
    "Keywords are the options of `restlab render` with underscores: integrator, mode, cache,\n"
    "denoiser, width, height, seed, camera, component, environment, environment_rotation,\n"
    "environment_scale, backend, device, ray_tracing, validate, kernels, threads, max_bounces,\n"
    "russian_roulette, filter, multiscatter, light_choice. Every other keyword is a parameter of\n"
    "the method. One thread may use a session at a time; each may have its own.";

}  // namespace

void addSession(py::module_& module) {
  addStats(module);
  using S = ScriptSession;
  py::class_<S>(module, "Session", kSessionHelp)
      .def(py::init([](const py::object& scene, const py::kwargs& keywords) {
             return std::make_unique<S>(scene, keywords);
           }),
           py::arg("scene"))
      .def("frame", &S::frame, "Renders the next frame of the history.")
      .def("frames", &S::frames, py::arg("count"),
           "Renders several frames without reading their images; a device need not wait between "
           "them.")
      .def("radiance", &S::radiance,
           "The image of the last frame: float32 (height, width, 3), linear Rec. 709, read-only, "
           "not copied.\nIt stays as it is after the next frame.")
      .def("aov", &S::aov, py::arg("name"),
           "A layer of the last frame, one of aov_names; numbers stand in every channel.")
      .def("probe", &S::probe, py::arg("x"), py::arg("y"),
           "What the method keeps of a pixel: values, the path of its sample, its donors.")
      .def("set_parameters", &S::setParameters,
           "Changes parameters of the method from the next frame on. Returns whether the history "
           "starts anew.")
      .def("set_camera", &S::setCamera, py::arg("name") = py::none(),
           "Sets a camera of the scene by name or index, then what the keywords say: position and "
           "target in metres,\ndirection, up, yfov in degrees. What is not said stays as it is.")
      .def("reset", &S::reset, py::arg("seed") = py::none(), py::kw_only(),
           py::arg("first_frame") = 0,
           "Starts a new history, with another seed if one is given.\nfirst_frame is for methods "
           "without a history: the number of their next frame.")
      .def("resize", &S::resize, py::arg("width"), py::arg("height"),
           "Changes the size of the image; the history starts anew.")
      .def(
          "reference",
          [](S& session, const std::optional<uint64_t>& spp, const std::optional<double>& relmse,
             const std::optional<double>& timeLimit, const std::string& integrator,
             const py::object& file, bool isAnew) {
            return std::const_pointer_cast<Reference>(
                session.reference({spp, relmse, timeLimit, integrator,
                                   file.is_none() ? "" : textOf(file, "file"), isAnew}));
          },
          py::kw_only(), py::arg("spp") = py::none(), py::arg("target_relmse") = py::none(),
          py::arg("time_limit") = py::none(), py::arg("integrator") = "path",
          py::arg("file") = py::none(), py::arg("anew") = false,
          "The reference of what this session shows: same scene, camera, size and light transport.")
      .def_property_readonly("aov_names", &S::aovNames, "Names that aov() takes.")
      .def_property_readonly("layers", &S::layers,
                             "Layers of the method among them: name, unit, help.")
      .def_property_readonly("parameters", &S::parameters, "All parameters of the method.")
      .def_property_readonly("settings", &S::settings, "All other settings.")
      .def_property_readonly(
          "metadata", [](S& session) { return dictOf(session.metadata()); },
          "Words that `restlab render` writes into its EXR, of the last frame; for write_exr().")
      .def_property_readonly(
          "cameras", [](S& session) { return listOf(session.cameras()); },
          "Names of the scene's cameras.")
      .def_property_readonly("camera", &S::camera,
                             "The camera: name, position, direction, up, yfov.")
      .def_property_readonly("frame_count", &S::frameCount, "Frames of this history.")
      .def_property_readonly("time_ms", &S::timeMs, "Time of all its frames.")
      .def_property_readonly(
          "health", [](S& session) { return healthOf(session.health().health); },
          "Counts of numerical health of all its frames.")
      .def_property_readonly("device", &S::device, "The device that renders.")
      .def("__repr__", [](S& session) { return strOf(session.words()); });
}

}  // namespace restlab::python
