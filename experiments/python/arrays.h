// Images as arrays of numpy, and back.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <string>

#include "core/image/image.h"
#include "core/image/metrics/mask.h"

namespace restlab::python {

// Returns an array (height, width, 3) of float32 that shows the image without a copy, read-only.
// The array holds the image.
pybind11::array arrayOf(std::shared_ptr<const Image> image);
pybind11::array arrayOf(Image image);

// Returns a copy of an array (height, width, 3) of floats; float16 and float64 are rounded to
// float32. `name` begins the error: Error (badUsage) for another type or shape.
Image imageOf(const pybind11::handle& array, const std::string& name);

// Returns the mask of an array (height, width) of bool: the pixels of `image` that count. None: all
// of them. Throws Error (badUsage) for another type, shape or size.
PixelMask maskOf(const pybind11::handle& array, const std::string& name, const Image& image);

}  // namespace restlab::python
