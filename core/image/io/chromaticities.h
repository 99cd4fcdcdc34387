// Conversion from other primaries and whites to linear Rec. 709.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace restlab {

// CIE 1931 (x, y) of three primaries and of the white that equal amounts of them make.
struct Chromaticities {
  glm::dvec2 red, green, blue, white;
};

// ITU-R BT.709, white D65: the colours of every image of this program.
inline constexpr Chromaticities kRec709 = {
    {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

// CIE XYZ itself: R, G, B are X, Y, Z.
inline constexpr Chromaticities kCieXyz = {
    {1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {1.0 / 3.0, 1.0 / 3.0}};

// Returns whether the colours are those of Rec. 709 to within 1e-4, the rounding in files.
bool isRec709(const Chromaticities& colours);

// Formats colours: "red (0.64, 0.33), green (0.3, 0.6), blue (0.15, 0.06), white (0.3127, 0.329)"
std::string textOf(const Chromaticities& colours);

// Returns why the chromaticities define no colours; "" if they do. Primaries must span a triangle,
// and each must contribute to the white, whose y must not be 0.
std::string whyNoColours(const Chromaticities& colours);

// Returns the matrix from linear R, G, B of `colours` to linear Rec. 709, through CIE XYZ;
// whyNoColours() must be "". No chromatic adaptation: light keeps its colour and luminance whatever
// white a file has.
glm::dmat3 toRec709(const Chromaticities& colours);

void convert(const glm::dmat3& matrix, std::vector<glm::vec3>& pixels);

}  // namespace restlab
