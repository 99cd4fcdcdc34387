#include "core/visible_surfaces.h"

#include <algorithm>

#include "core/dialect/order.h"
#include "core/kernels/visible.h"

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
    i.packParameters = [](const std::string&, const ParameterMap&) {
      return bytesOf(rl::VisibleParams{});
    };
    return i;
  }();
  return info;
}

}  // namespace

std::vector<const PartInfo*> withVisibleSurfaces(std::vector<const PartInfo*> parts) {
  const PartInfo& part = visibleSurfaces();
  const auto asks = [&](const std::string& input) {
    return std::any_of(part.buffers.begin(), part.buffers.end(),
                       [&](const BufferInfo& buffer) { return buffer.name == input; });
  };
  const bool isAsked = std::any_of(parts.begin(), parts.end(), [&](const PartInfo* other) {
    return std::any_of(other->inputs.begin(), other->inputs.end(), asks);
  });
  if (isAsked) parts.insert(parts.begin(), &part);
  return parts;
}

}  // namespace restlab
