// Shared parts of plots and bars: colours, marks and a few SVG shapes.
//
// Colours are attributes, to make the file complete by itself, and also classes, for which the
// report's style sheet can choose other colours (a dark scheme).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace restlab::svg {

// Colour `index` of a palette that is also safe for colour-blind readers (Okabe and Ito), as
// "#rrggbb"; repeats after kColours.
constexpr size_t kColours = 7;
const char* colour(size_t index);

// Colour `index` of the passes of a frame, none of which looks like one of a method: muted, safe
// for colour-blind readers by their lightness. Repeats after kPassColours.
constexpr size_t kPassColours = 7;
const char* passColour(size_t index);

// Height of a line of a legend.
constexpr double kLegendRow = 19.0;

// Dash pattern of line `index`, which changes when the colours repeat; "" for a solid line.
const char* dashes(size_t index);

// Marker centred at x, y: circle, square, triangle, diamond, ..., in the colour of `index`, with
// `tooltip` as its title if not empty; hollow: only the outline, filled with white.
std::string marker(size_t index, double x, double y, std::string_view tooltip = {},
                   bool isHollow = false);

// Formats with at most two digits after the point, without trailing zeros.
std::string coordinate(double value);

std::string line(double x0, double y0, double x1, double y1, std::string_view cssClass);

// Text with its baseline at y. `anchor` is start, middle or end; `attributes` are added to the tag.
std::string text(double x, double y, std::string_view anchor, std::string_view content,
                 std::string_view attributes = {});

// Estimates the width of a text in a sans-serif font of `size`; the same on every machine.
double textWidth(std::string_view content, double size);

// Returns `content`, or its start and an ellipsis if it is wider than `width`. Keeps whole
// characters.
std::string fitText(std::string_view content, double width, double size);

// Opens an image with a white background, its title (also its accessible name) and styles; the
// caller ends it with "</svg>\n".
std::string open(double width, double height, std::string_view title, std::string_view cssClass);

}  // namespace restlab::svg
