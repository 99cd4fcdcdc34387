#include "experiments/cli/render_pixel.h"

#include <fmt/format.h>

#include <charconv>

#include "core/base/error.h"
#include "experiments/view/probe_values.h"

namespace restlab {

PixelPlace parsePixel(const std::string& text) {
  PixelPlace pixel;
  const char* end = text.data() + text.size();
  const auto x = std::from_chars(text.data(), end, pixel.x);
  const bool hasComma = x.ec == std::errc() && x.ptr != end && *x.ptr == ',';
  const auto y = hasComma ? std::from_chars(x.ptr + 1, end, pixel.y) : x;
  if (!hasComma || y.ec != std::errc() || y.ptr != end) {
    failUsage(fmt::format(
        "--pixel {}: must be X,Y in whole pixels from the top left, for example 40,30", text));
  }
  return pixel;
}

void requireInside(const PixelPlace& pixel, const SessionConfig& config) {
  if (pixel.x < config.width && pixel.y < config.height) return;
  failUsage(fmt::format("--pixel {},{}: the image is {}x{}, so the last pixel is {},{}", pixel.x,
                        pixel.y, config.width, config.height, config.width - 1, config.height - 1));
}

std::string pixelText(const Session& session, const PixelPlace& pixel) {
  std::string text;
  for (const ProbeValue& value : probedValues(session, pixel.x, pixel.y))
    text += fmt::format("{} {}\n", value.name, value.value);
  return text + probedPathText(session, pixel.x, pixel.y) +
         probedDonorsText(session, pixel.x, pixel.y);
}

std::string pixelJson(const Session& session, const PixelPlace& pixel, uint64_t frame) {
  const nlohmann::ordered_json json = {{"x", pixel.x},
                                       {"y", pixel.y},
                                       {"frame", frame},
                                       {"seed", session.config().seed},
                                       {"values", probedValuesJson(session, pixel.x, pixel.y)},
                                       {"path", probedPathJson(session, pixel.x, pixel.y)},
                                       {"donors", probedDonorsJson(session, pixel.x, pixel.y)}};
  return json.dump(2) + "\n";
}

}  // namespace restlab
