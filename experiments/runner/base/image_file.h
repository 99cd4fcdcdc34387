// Reads users' images: colours, data window, and notes about conversions.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "core/image/image.h"
#include "core/image/metrics/window.h"

namespace restlab {

// Reads R, G, B outside named layers (or Y alone) and the named layers in `others`; ignores the
// rest of the file. Prints what sayNotes() prints. Throws Error (badInput) if the file cannot be
// read or has no such colours.
LayeredImage readColours(const std::filesystem::path& file,
                         const std::set<std::string>& others = {});

// Prints a line about converted colours and one about non-square pixels, each once.
void sayNotes(const std::filesystem::path& file, const LayeredImage& image);

// Throws Error (badInput) unless both windows are the same pixels of pixel space: "a.exr: is 8x8
// from pixel (1, 0) on, the reference b.exr is 8x8 from pixel (0, 0) on" for "a.exr:" and "the
// reference b.exr".
void requireSameWindow(const std::string& what, const PixelWindow& window, const std::string& other,
                       const PixelWindow& otherWindow);

}  // namespace restlab
