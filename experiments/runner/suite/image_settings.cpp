#include "experiments/runner/suite/image_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "core/base/error.h"
#include "core/dialect/types.h"

namespace restlab {

namespace {

// Returns a whole number of pixels in 1..kMaxSide, or 0 if `text` is none.
uint32_t parseSide(std::string_view text) {
  uint32_t side = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), side);
  const bool whole = status == std::errc() && end == text.data() + text.size();
  return whole && side <= kMaxSide ? side : 0;
}

}  // namespace

void parseResolution(const std::string& text, const std::string& place, uint32_t& width,
                     uint32_t& height) {
  const size_t x = std::min(text.find_first_of("xX"), text.size());
  width = parseSide(std::string_view(text).substr(0, x));
  height = x < text.size() ? parseSide(std::string_view(text).substr(x + 1)) : 0;
  if (width && height) return;
  failUsage(fmt::format("{} {}: must be WxH with both sides in 1..{}, for example 640x360", place,
                        text, kMaxSide));
}

std::string componentName(uint32_t components) {
  if (components == rl::RL_COMPONENT_DIRECT) return "direct";
  if (components == rl::RL_COMPONENT_INDIRECT) return "indirect";
  return "all";
}

uint32_t parseComponent(const std::string& name, const std::string& place) {
  if (name == "all") return rl::RL_COMPONENT_ALL;
  if (name == "direct") return rl::RL_COMPONENT_DIRECT;
  if (name == "indirect") return rl::RL_COMPONENT_INDIRECT;
  failUsage(fmt::format("{}: unknown component '{}' (known: all, direct, indirect){}", place, name,
                        didYouMean(name, {"all", "direct", "indirect"})));
}

}  // namespace restlab
