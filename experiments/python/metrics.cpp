// Metrics of arrays, under the names of `restlab list metrics`.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/image/metrics/metrics.h"
#include "experiments/python/arrays.h"
#include "experiments/python/bindings.h"
#include "experiments/python/call.h"
#include "experiments/python/reference.h"
#include "experiments/python/values.h"
#include "experiments/runner/reference/reference_error.h"
#include "experiments/statistics/bias_runs.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

// The ones that `restlab compare` prints unless told otherwise.
const std::vector<std::string> kUsual = {"mse", "relmse_e1e-2", "mape_e1e-2", "energy_ratio"};

void requireSizeOf(const Image& image, const Image& reference) {
  if (image.width == reference.width && image.height == reference.height) return;
  failUsage(fmt::format("image: is {}x{}, the reference {}x{}; both must have one size",
                        image.width, image.height, reference.width, reference.height));
}

// Several runs: a list of arrays, or one array (runs, height, width, 3).
std::vector<Image> runsOf(const py::object& images, const std::string& metric) {
  std::vector<Image> runs;
  const bool isOne = py::isinstance<py::array>(images) && images.attr("ndim").cast<int>() != 4;
  if (!isOne && py::isinstance<py::sequence>(images) && !py::isinstance<py::str>(images)) {
    for (const py::handle& image : images)
      runs.push_back(imageOf(image, fmt::format("image {}", runs.size())));
  }
  if (runs.size() < 2) {
    failUsage(fmt::format("{}: needs a list of two images or more, independent runs of one method",
                          metric));
  }
  return runs;
}

double biasRms(const std::vector<Image>& runs, const Reference& reference, const PixelMask& mask) {
  BiasRuns all;
  for (const Image& run : runs) {
    for (const Image* other = runs.data(); other != &run; ++other) {
      if (other->pixels == run.pixels)
        failUsage("bias_rms: two of the images are equal; it needs independent runs");
    }
    requireSizeOf(run, reference.mean);
    all.add(run);
  }
  const bool hasHalves = reference.half0.has_value();
  return all
      .biasRms(hasHalves ? *reference.half0 : reference.mean,
               hasHalves ? *reference.half1 : reference.mean, mask)
      .value;
}

MetricOptions optionsOf(const Reference& reference, const py::object& mask, double perDegree) {
  MetricOptions options;
  options.mask = maskOf(mask, "mask", reference.mean);
  options.flip.pixelsPerDegree = perDegree;
  requireFlipOptions(options.flip);
  return options;
}

double metricOf(const std::string& name, const py::object& image, const py::object& reference,
                const py::object& mask, double perDegree) {
  const MetricInfo& info = findMetric(name);
  const std::shared_ptr<const Reference> truth = referenceOf(reference, "reference");
  const MetricOptions options = optionsOf(*truth, mask, perDegree);
  if (info.needsRuns) {
    const std::vector<Image> runs = runsOf(image, name);
    return withoutPython([&] { return biasRms(runs, *truth, options.mask); });
  }
  const Image one = imageOf(image, "image");
  requireSizeOf(one, truth->mean);
  return withoutPython([&] { return errorAgainst(name, one, *truth, options).value; });
}

// Names of metrics of single images: a list, 'all', or None for the usual ones.
std::vector<std::string> namesOf(const py::object& names) {
  if (names.is_none()) return kUsual;
  std::vector<std::string> all;
  if (py::isinstance<py::str>(names) && names.cast<std::string>() == "all") {
    for (const MetricInfo& metric : metricRegistry())
      if (!metric.needsRuns) all.push_back(metric.name);
    return all;
  }
  if (py::isinstance<py::str>(names) || !py::isinstance<py::sequence>(names))
    failUsage("names: must be a list of names, or 'all'");
  for (const py::handle& name : names) {
    const MetricInfo& info = findMetric(textOf(name, "names"));
    if (info.needsRuns)
      failUsage(fmt::format("{}: needs several images; metric() takes a list of them", info.name));
    all.push_back(info.name);
  }
  return all;
}

py::dict metricsOf(const py::object& image, const py::object& reference, const py::object& names,
                   const py::object& mask, double perDegree) {
  const std::vector<std::string> wanted = namesOf(names);
  const std::shared_ptr<const Reference> truth = referenceOf(reference, "reference");
  const MetricOptions options = optionsOf(*truth, mask, perDegree);
  const Image one = imageOf(image, "image");
  requireSizeOf(one, truth->mean);
  std::vector<double> values;
  withoutPython([&] {
    for (const std::string& name : wanted)
      values.push_back(errorAgainst(name, one, *truth, options).value);
  });
  py::dict all;
  for (size_t i = 0; i < wanted.size(); ++i) all[strOf(wanted[i])] = values[i];
  return all;
}

}  // namespace

void addMetrics(py::module_& module) {
  module.def("metric", &metricOf, py::arg("name"), py::arg("image"), py::arg("reference"),
             py::kw_only(), py::arg("mask") = py::none(),
             py::arg("pixels_per_degree") = kFlipPixelsPerDegree,
             "Error of an image, one of metric_names(). reference: an array or a Reference, whose "
             "halves are used.\nmask: bool (height, width), True where a pixel counts. bias_rms "
             "takes a list of independent runs.");
  module.def("metrics", &metricsOf, py::arg("image"), py::arg("reference"),
             py::arg("names") = py::none(), py::kw_only(), py::arg("mask") = py::none(),
             py::arg("pixels_per_degree") = kFlipPixelsPerDegree,
             "Several errors of an image by name: those that `restlab compare` prints, a list of "
             "names, or 'all'.");
  module.def(
      "metric_names", [] { return listOf(metricNames()); }, "Names of all metrics.");
}

}  // namespace restlab::python
