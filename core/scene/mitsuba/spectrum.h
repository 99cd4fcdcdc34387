// Spectra as colours of Rec. 709.
#pragma once

#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace restlab::mitsuba {

// Pairs of a wavelength in nanometres and a value, in ascending order; linear between them, 0
// outside.
using Spectrum = std::vector<std::pair<double, double>>;

// Colour matching functions x, y, z of the CIE's observer of 1931 at a wavelength in nanometres:
// the fit by sums of lobes of Wyman, Sloan and Shirley, "Simple analytic approximations to the CIE
// XYZ color matching functions", JCGT 2013.
glm::dvec3 colorMatching(double wavelength);

// Colour of light with that spectral radiance: one of 1 at every wavelength has the luminance 1.
glm::dvec3 radianceOf(const Spectrum& spectrum);

// Colour under the illuminant E over that of white there: a reflectance that is the same at every
// wavelength is grey. Channels may lie outside of 0 to 1.
glm::dvec3 reflectanceOf(const Spectrum& spectrum);

}  // namespace restlab::mitsuba
