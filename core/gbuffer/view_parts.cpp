#include "core/gbuffer/view_parts.h"

#include <algorithm>

#include "core/dialect/order.h"
#include "core/gbuffer/guide.h"

namespace restlab {

namespace {

const PartInfo& visibleSurfaces() {
  static const PartInfo info = [] {
    PartInfo i;
    i.name = "visible";
    i.summary = "what each pixel shows at its centre";
    i.buffers = {{"visible", 16, 0, 1}, {"visible_before", 16, 0, 0}};
    i.passes = {{"visible", "visible"}};
    i.hasHistory = true;
    i.onlyOnNewViews = true;
    // No parameters: the kernel's struct holds only padding.
    i.packParameters = [](const std::string&, const ParameterMap&) { return bytesOf(uint32_t{0}); };
    return i;
  }();
  return info;
}

const PartInfo& guides() {
  static const PartInfo info = [] {
    PartInfo i;
    i.name = "guide";
    i.summary = "what the film samples show, for denoisers";
    i.inputs = {"visible"};
    const uint32_t bytes = 16 * rl::RL_GUIDE_QUADS;
    i.buffers = {{"guide", bytes, 0, 1}, {"guide_before", bytes, 0, 0}, {"motion", 16, 0, -1}};
    i.passes = {{"guide", "guide"}};
    i.hasHistory = true;
    i.packParameters = [](const std::string&, const ParameterMap& p) {
      rl::GuideParams out{};
      const auto demodulate = p.find("demodulate");
      if (demodulate != p.end()) {
        const std::string& what = std::get<std::string>(demodulate->second);
        out.flags |= what == "none" ? 0u : rl::RL_GUIDE_DIFFUSE;
        out.flags |= what == "all" ? rl::RL_GUIDE_SPECULAR : 0u;
      }
      return bytesOf(out);
    };
    return i;
  }();
  return info;
}

}  // namespace

std::vector<const PartInfo*> withViewParts(std::vector<const PartInfo*> parts) {
  // Later part first: it needs buffers of the earlier one.
  for (const PartInfo* part : {&guides(), &visibleSurfaces()}) {
    const auto asks = [&](const std::string& input) {
      return std::any_of(part->buffers.begin(), part->buffers.end(),
                         [&](const BufferInfo& buffer) { return buffer.name == input; });
    };
    const bool isAsked = std::any_of(parts.begin(), parts.end(), [&](const PartInfo* other) {
      return std::any_of(other->inputs.begin(), other->inputs.end(), asks);
    });
    if (isAsked) parts.insert(parts.begin(), part);
  }
  return parts;
}

}  // namespace restlab
