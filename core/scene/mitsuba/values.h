// Values of elements: numbers, colours, transforms.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/mitsuba/document.h"
#include "core/scene/mitsuba/report.h"

namespace restlab::mitsuba {

// Numbers apart by blanks or commas, all finite. Fails at `place`.
std::vector<double> parseNumbers(const std::string& text, const std::string& place,
                                 const Report& report);
// One number.
double parseNumber(const std::string& text, const std::string& place, const Report& report);

// The attribute `value`, which must be there.
const std::string& valueOf(const Element& element, const Report& report);

// <point>, <vector>: x, y, z or value.
glm::dvec3 vectorOf(const Element& element, const Report& report);

enum class Quantity { reflectance, radiance, index };

// Returns whether the element is a colour: <rgb>, <srgb>, <spectrum>, <float>, <integer>.
bool isColor(const Element& element);
// Colour in Rec. 709. Spectra by wavelengths are integrated, and a note says so.
glm::dvec3 colorOf(const Element& element, Quantity quantity, Files& files, Report& report);

// <transform>: its steps one after the other. `isPlanar`: of texture coordinates, whose 3x3
// matrices are of points with a third coordinate of 1. Fails on singular ones.
glm::dmat4 transformOf(const Element& element, bool isPlanar, const Report& report);

// The map that moves the origin to `origin` and +Z to `target`, with `up` in the plane of Y and Z.
glm::dmat4 lookAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up,
                  const std::string& place, const Report& report);

}  // namespace restlab::mitsuba
