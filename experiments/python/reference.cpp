#include "experiments/python/reference.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/io/exr_limits.h"
#include "experiments/python/arrays.h"
#include "experiments/python/bindings.h"
#include "experiments/python/call.h"
#include "experiments/python/settings.h"
#include "experiments/python/values.h"
#include "experiments/runner/base/log.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

using Shared = std::shared_ptr<Reference>;

constexpr uint64_t kMostSpp = uint64_t(1) << 32;
constexpr double kLeastRelmse = 1e-12, kMostRelmse = 1e6, kLeastTimeS = 1e-3, kMostTimeS = 1e9;

template <class Number>
void requireInside(const char* name, const std::optional<Number>& value, Number lo, Number hi) {
  if (value && !(*value >= lo && *value <= hi))
    failUsage(fmt::format("{} {}: must be {:g} to {:g}", name, *value, double(lo), double(hi)));
}

ReferenceTarget targetOf(const ReferenceWish& wish) {
  requireInside("spp", wish.spp, uint64_t(2), kMostSpp);
  requireInside("target_relmse", wish.targetRelmse, kLeastRelmse, kMostRelmse);
  requireInside("time_limit", wish.timeLimitS, kLeastTimeS, kMostTimeS);
  if (!wish.spp && !wish.targetRelmse && !wish.timeLimitS)
    failUsage("reference: needs one of spp, target_relmse, time_limit");
  const std::vector<std::string>& known = referenceIntegrators();
  if (std::find(known.begin(), known.end(), wish.integrator) == known.end()) {
    failUsage(fmt::format("integrator '{}': a reference is made by {}, whose error is known",
                          wish.integrator, fmt::join(known, " or ")));
  }
  return {wish.spp.value_or(0), wish.targetRelmse.value_or(0.0), wish.timeLimitS.value_or(0.0)};
}

py::object arrayOrNone(const Shared& reference, const std::optional<Image>& image) {
  if (!image) return py::none();
  return arrayOf(std::shared_ptr<const Image>(reference, &*image));
}

Shared made(const py::object& mean, const py::object& half0, const py::object& half1) {
  auto reference = std::make_shared<Reference>();
  reference->mean = imageOf(mean, "mean");
  if (half0.is_none() != half1.is_none())
    failUsage("Reference: half0 and half1 go together; without them leave both out");
  if (!half0.is_none()) {
    reference->half0 = imageOf(half0, "half0");
    reference->half1 = imageOf(half1, "half1");
    for (const std::optional<Image>* half : {&reference->half0, &reference->half1}) {
      if ((*half)->width != reference->mean.width || (*half)->height != reference->mean.height)
        failUsage("Reference: mean, half0 and half1 must have one size");
    }
  }
  reference->relmse = reference->relmseSinceHalf = std::nan("");
  return reference;
}

constexpr const char* kReferenceHelp =
    "A converged image, in two independent halves where they are known.\n\n"
    "Metrics against halves have no share of the reference's own noise (`restlab compare`).";

void addClass(py::module_& module) {
  using R = Reference;
  py::class_<R, Shared>(module, "Reference", kReferenceHelp)
      .def(py::init(&made), py::arg("mean"), py::arg("half0") = py::none(),
           py::arg("half1") = py::none())
      .def_property_readonly(
          "mean",
          [](const Shared& r) { return arrayOf(std::shared_ptr<const Image>(r, &r->mean)); },
          "The image: float32 (height, width, 3), read-only.")
      .def_property_readonly(
          "half0", [](const Shared& r) { return arrayOrNone(r, r->half0); },
          "The mean of one half of the samples, or None.")
      .def_property_readonly(
          "half1", [](const Shared& r) { return arrayOrNone(r, r->half1); },
          "The mean of the other half, or None.")
      .def_property_readonly(
          "variance", [](const Shared& r) { return arrayOrNone(r, r->variance); },
          "Variance of the mean, pixel by pixel, or None.")
      .def_readonly("spp", &R::spp, "Samples a pixel of both halves together.")
      .def_readonly("relmse", &R::relmse,
                    "Its own relmse_e1e-2, estimated from the halves; nan where unknown.")
      .def_readonly("time_s", &R::timeS, "Seconds of rendering.")
      .def_property_readonly(
          "not_converged", [](const R& r) { return strOf(whyNotConverged(r)); },
          "Why it is not converged, whatever its halves agree on: lights drawn too seldom; or ''.")
      .def_property_readonly(
          "metadata", [](const R& r) { return dictOf(r.metadata); }, "Words of its file.")
      .def(
          "write",
          [](const R& r, const py::object& file) {
            const std::string name = textOf(file, "file");
            requireExrSize(name, r.mean.width, r.mean.height, kReferenceLayers);
            withoutPython([&] { writeReference(name, r); });
          },
          py::arg("file"), "Writes it as an EXR that `restlab compare --ref` takes.")
      .def("__repr__", [](const R& r) {
        return fmt::format("<restlab.Reference {}x{}, {} spp, relmse {:.3g}>", r.mean.width,
                           r.mean.height, r.spp, r.relmse);
      });
}

Shared render(const py::object& scene, const ReferenceWish& wish, const py::kwargs& keywords) {
  for (const char* name : {"mode", "cache", "denoiser"}) {
    if (keywords.contains(name))
      failUsage(fmt::format("{}: is of a method; a reference has none", name));
  }
  Settings settings = settingsOf(scene, keywords);
  if (!settings.config.parameters.empty()) {
    failUsage(fmt::format("'{}': is a parameter of a method; a reference has none",
                          settings.config.parameters.begin()->first));
  }
  targetOf(wish);
  const PreparedScene prepared = rendering([&] { return prepare(settings); });
  return std::const_pointer_cast<Reference>(
      obtain(prepared, referenceConfigOf(settings.config), wish));
}

}  // namespace

std::shared_ptr<const Reference> obtain(const PreparedScene& prepared, ReferenceConfig config,
                                        const ReferenceWish& wish) {
  const ReferenceTarget target = targetOf(wish);
  config.integrator = wish.integrator;
  if (!wish.file.empty()) {
    checkWritable(wish.file);
    requireExrSize(wish.file, config.width, config.height, kReferenceLayers);
  }
  ReferenceStore store;
  if (!wish.isAnew) store.folder = referenceCacheFolder();
  return rendering([&] {
    auto reference =
        std::make_shared<const Reference>(renderReference(prepared, config, target, store));
    if (!wish.file.empty()) writeReference(wish.file, *reference);
    if (const std::string why = whyNotConverged(*reference); !why.empty())
      logWarning(fmt::format("reference: is not converged: {}", why));
    return reference;
  });
}

std::shared_ptr<const Reference> referenceOf(const py::handle& object, const std::string& name) {
  if (py::isinstance<Reference>(object)) return object.cast<Shared>();
  auto reference = std::make_shared<Reference>();
  reference->mean = imageOf(object, name);
  return reference;
}

void addReference(py::module_& module) {
  addClass(module);
  module.def(
      "reference",
      [](const py::object& scene, const std::optional<uint64_t>& spp,
         const std::optional<double>& relmse, const std::optional<double>& timeLimit,
         const std::string& integrator, const py::object& file, bool isAnew,
         const py::kwargs& keywords) {
        return render(scene,
                      {spp, relmse, timeLimit, integrator,
                       file.is_none() ? "" : textOf(file, "file"), isAnew},
                      keywords);
      },
      py::arg("scene"), py::kw_only(), py::arg("spp") = py::none(),
      py::arg("target_relmse") = py::none(), py::arg("time_limit") = py::none(),
      py::arg("integrator") = "path", py::arg("file") = py::none(), py::arg("anew") = false,
      "Renders a converged image in two halves, as `restlab reference` does, until spp, an "
      "estimated error or\nseconds of rendering are reached. Goes on from the progress in the "
      "user's cache unless anew.\nFurther keywords: those of Session but for its method.");
  module.def(
      "read_reference",
      [](const py::object& file) {
        const std::string name = textOf(file, "file");
        return withoutPython([&] { return std::make_shared<Reference>(readReference(name)); });
      },
      py::arg("file"), "Reads an EXR: a reference with its halves, or any image as one.");
}

}  // namespace restlab::python
