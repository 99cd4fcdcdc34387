// What plots and bars share: colours, marks, and the few shapes of SVG that they use.
//
// Colours stand in the file as attributes, so that it is complete by itself, and as classes, by
// which the report's style sheet can choose others (a dark scheme).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace restlab::svg {

// Colour `index` of a palette whose members differ for colour-blind eyes too (Okabe and Ito), as
// "#rrggbb"; it repeats after kColours.
constexpr size_t kColours = 7;
const char* colour(size_t index);

// Dashes of line `index`, which change where colours repeat; "" for a solid line.
const char* dashes(size_t index);

// A marker centred at x, y: circle, square, triangle, diamond, ..., in the colour of `index`, with
// `tooltip` as its title where that is not empty; hollow: its outline alone, about the ground.
std::string marker(size_t index, double x, double y, std::string_view tooltip = {},
                   bool isHollow = false);

// Coordinates with two digits after the point and no trailing zeros.
std::string coordinate(double value);

std::string line(double x0, double y0, double x1, double y1, std::string_view cssClass);

// Text with its baseline at y. `anchor` is start, middle or end; `attributes` stand in the tag.
std::string text(double x, double y, std::string_view anchor, std::string_view content,
                 std::string_view attributes = {});

// Estimated width of a text in a sans-serif font of `size`, the same on every machine.
double textWidth(std::string_view content, double size);

// `content` or, where it is wider than `width`, its start and an ellipsis. Whole characters.
std::string fitText(std::string_view content, double width, double size);

// The head of an image with a white ground, its title (also its accessible name) and styles; the
// caller ends it with "</svg>\n".
std::string open(double width, double height, std::string_view title, std::string_view cssClass);

}  // namespace restlab::svg
