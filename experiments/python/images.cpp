// Image files.
#include <pybind11/stl.h>

#include <map>

#include "core/base/error.h"
#include "core/image/io/exr_limits.h"
#include "experiments/python/arrays.h"
#include "experiments/python/bindings.h"
#include "experiments/python/call.h"
#include "experiments/python/values.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

using Words = std::map<std::string, std::string>;

py::dict readLayers(const py::object& file) {
  const std::string name = textOf(file, "file");
  LayeredImage image = withoutPython([&] { return readExr(name, {ExrLayers::all}); });
  py::dict layers;
  for (auto& [layer, pixels] : image.layers) layers[strOf(layer)] = arrayOf(std::move(pixels));
  return layers;
}

py::dict readWords(const py::object& file) {
  const std::string name = textOf(file, "file");
  return dictOf(withoutPython([&] { return readExr(name).metadata; }));
}

void write(const py::object& file, const py::object& image, const py::dict& layers,
           const Words& metadata) {
  const std::string name = textOf(file, "file");
  LayeredImage all;
  all.layers[""] = imageOf(image, "image");
  const Image& main = all.layers.at("");
  for (const auto& [key, array] : layers) {
    const std::string layer = textOf(key, "layers");
    Image pixels = imageOf(array, "layer '" + layer + "'");
    if (layer.empty() || pixels.width != main.width || pixels.height != main.height)
      failUsage("layer '" + layer + "': must have a name, and the size of the image");
    all.layers[layer] = std::move(pixels);
  }
  all.metadata = metadata;
  requireExrSize(name, main.width, main.height, uint32_t(all.layers.size()));
  withoutPython([&] { writeExr(name, all); });
}

}  // namespace

void addImages(py::module_& module) {
  module.def("read_exr", &readLayers, py::arg("file"),
             "Layers of an EXR by name; '' is the image itself.");
  module.def("read_metadata", &readWords, py::arg("file"), "Words that restlab wrote into an EXR.");
  module.def(
      "write_exr", &write, py::arg("file"), py::arg("image"), py::kw_only(),
      py::arg("layers") = py::dict(), py::arg("metadata") = Words(),
      "Writes an EXR of 32-bit floats. With Session.metadata `restlab compare` knows what it "
      "shows.");
  module.def(
      "write_png",
      [](const py::object& file, const py::object& image, float exposure) {
        const std::string name = textOf(file, "file");
        const Image pixels = imageOf(image, "image");
        withoutPython([&] { writePng(name, pixels, exposure); });
      },
      py::arg("file"), py::arg("image"), py::kw_only(), py::arg("exposure") = 1.0f,
      "Writes an sRGB preview: radiance times exposure, clipped.");
}

}  // namespace restlab::python
