// Colours of other primaries and whites as linear Rec. 709.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace restlab {

// CIE 1931 (x, y) of three primaries and of the white that equal amounts of them make.
struct Chromaticities {
  glm::dvec2 red, green, blue, white;
};

// ITU-R BT.709, white D65: what every image of this program is in.
inline constexpr Chromaticities kRec709 = {
    {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

// CIE XYZ itself: R, G, B are X, Y, Z.
inline constexpr Chromaticities kCieXyz = {
    {1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {1.0 / 3.0, 1.0 / 3.0}};

// Tells whether they are those of Rec. 709 to within 1e-4, as files round them.
bool isRec709(const Chromaticities& colours);

// "red (0.64, 0.33), green (0.3, 0.6), blue (0.15, 0.06), white (0.3127, 0.329)"
std::string textOf(const Chromaticities& colours);

// Why they say no colour: "" where they do. Primaries must span a triangle, and each must be part
// of the white, whose y is not 0.
std::string whyNoColours(const Chromaticities& colours);

// From linear R, G, B of `colours`, for which whyNoColours() is "", to linear Rec. 709, by CIE XYZ
// as it is: there is no chromatic adaptation, so that light keeps its colour and its luminance
// whatever white a file is in.
glm::dmat3 toRec709(const Chromaticities& colours);

void convert(const glm::dmat3& matrix, std::vector<glm::vec3>& pixels);

}  // namespace restlab
