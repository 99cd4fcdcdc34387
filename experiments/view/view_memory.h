// Checks the host memory of a whole view at once: its parts are allocated one after another, and
// each would fit alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/frame/session.h"
#include "experiments/runner/suite/prepare.h"

namespace restlab {

// Bytes per pixel of a session's buffers in host memory, for an image of that size. 0 on a graphics
// card.
size_t hostBytesPerPixel(const Session& session, uint32_t width, uint32_t height);

// Bytes per pixel of a session that does not exist yet. Creates a session of one pixel to find out.
size_t hostBytesPerPixelOf(const PreparedScene& prepared, SessionConfig config);

// Bytes per pixel of a whole view: `panes` (bytes per pixel of each) with copies of their buffers,
// both halves of a reference (`referenceHalf` each) with copies and sums, and the images for pages.
uint64_t viewBytesPerPixel(const std::vector<size_t>& panes, size_t referenceHalf);

// Throws Error (deviceUnavailable) if the view needs more than `available` plus the bytes it
// already holds (`held`). No value in `available`: the system does not say.
void requireViewMemory(uint32_t width, uint32_t height, uint64_t bytesPerPixel, uint64_t held,
                       const std::optional<uint64_t>& available);

// True if any view of that size fits: no further check is needed.
bool fitsSurely(uint32_t width, uint32_t height, const std::optional<uint64_t>& available);

}  // namespace restlab
