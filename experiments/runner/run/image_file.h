// Images of users: their colours, where these lie, and what must be said of them.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "core/image/image.h"
#include "core/image/window.h"

namespace restlab {

// Opens R, G, B outside named layers (or Y alone), and of the named ones those of `others`: nothing
// else of the file matters. Says on stderr what sayNotes() does. Throws Error (badInput) where the
// file cannot be read or has no such colours.
LayeredImage readColours(const std::filesystem::path& file,
                         const std::set<std::string>& others = {});

// Conversions of colours, and pixels that are no squares; each line once.
void sayNotes(const std::filesystem::path& file, const LayeredImage& image);

// Throws Error (badInput) unless both are the same pixels of pixel space: "a.exr: is 8x8 from pixel
// (1, 0) on, the reference b.exr is 8x8 from pixel (0, 0) on", of "a.exr:" and "the reference
// b.exr".
void requireSameWindow(const std::string& what, const PixelWindow& window, const std::string& other,
                       const PixelWindow& otherWindow);

}  // namespace restlab
