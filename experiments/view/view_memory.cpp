#include "experiments/view/view_memory.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "experiments/runner/reference/reference.h"

namespace restlab {

namespace {

// Upper bound for any methods.
constexpr uint64_t kMostBytesPerPixel = 32 << 10;
// Two panes, a layer over each, and the reference.
constexpr uint64_t kImagesForPages = 5;

// llvmpipe, Mesa's software device, uses host memory.
bool isOnHost(const Session& session) {
  return session.config().backend == "cpu" || session.device().rfind("llvmpipe", 0) == 0;
}

}  // namespace

size_t hostBytesPerPixel(const Session& session, uint32_t width, uint32_t height) {
  return isOnHost(session) ? session.bytesPerPixelOf(width, height) : 0;
}

size_t hostBytesPerPixelOf(const PreparedScene& prepared, SessionConfig config) {
  const uint32_t width = config.width, height = config.height;
  config.width = config.height = 1;
  return hostBytesPerPixel(Session(prepared.scene, config), width, height);
}

uint64_t viewBytesPerPixel(const std::vector<size_t>& panes, size_t referenceHalf) {
  constexpr uint64_t kImage = sizeof(glm::vec3);
  uint64_t bytes = referenceBytesPerPixel({}) + kImagesForPages * kImage;
  for (const size_t pane : panes) bytes += 2 * pane + kImage;
  return bytes + 2 * (2 * referenceHalf + kImage);
}

void requireViewMemory(uint32_t width, uint32_t height, uint64_t bytesPerPixel, uint64_t held,
                       const std::optional<uint64_t>& available) {
  const uint64_t pixels = uint64_t(width) * height;
  // Compare by division: a product could wrap around.
  if (!available || bytesPerPixel == 0 || pixels <= (*available + held) / bytesPerPixel) return;
  throw Error(ExitCode::deviceUnavailable,
              fmt::format("view: {}x{} pixels of {} bytes (both panes, their copies and the "
                          "reference) need {:.0f} MiB of memory, {} MiB are available; choose a "
                          "smaller resolution",
                          width, height, bytesPerPixel,
                          double(pixels) * double(bytesPerPixel) / double(1 << 20),
                          (*available + held) >> 20));
}

bool fitsSurely(uint32_t width, uint32_t height, const std::optional<uint64_t>& available) {
  return !available || uint64_t(width) * height <= *available / kMostBytesPerPixel;
}

}  // namespace restlab
