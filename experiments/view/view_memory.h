// Memory that a view takes of the host, all of it together: each part is allocated at another
// time, and would find that there is room for itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/session.h"
#include "experiments/runner/run/prepare.h"

namespace restlab {

// Bytes a pixel of buffers that lie in the host's memory, of a session with an image of that size.
// 0 of one on a graphics card.
size_t hostBytesPerPixel(const Session& session, uint32_t width, uint32_t height);

// The same of a session that is not there. A session of one pixel is made to find out.
size_t hostBytesPerPixelOf(const PreparedScene& prepared, SessionConfig config);

// Panes of so many bytes a pixel with the copies of their buffers, both halves of a reference of so
// many with theirs and its sums, and the images for pages.
uint64_t viewBytesPerPixel(const std::vector<size_t>& panes, size_t referenceHalf);

// Throws Error (deviceUnavailable) where it is more than what is `available` and `held` by the view
// already. Nothing available: the system does not say.
void requireViewMemory(uint32_t width, uint32_t height, uint64_t bytesPerPixel, uint64_t held,
                       const std::optional<uint64_t>& available);

// Whether no view of that size can be too large: then nobody needs to ask further.
bool fitsSurely(uint32_t width, uint32_t height, const std::optional<uint64_t>& available);

}  // namespace restlab
