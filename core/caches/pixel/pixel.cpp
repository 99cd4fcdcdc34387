// Host side of the pixel cache.
#include "core/caches/pixel/pixel.h"

#include <cmath>

#include "core/cache.h"

namespace restlab {

namespace {

std::vector<ParameterInfo> parameterInfos() {
  return {
      {"spatial_radius",
       3.0,
       1.5,
       256.0,
       {},
       "pixels; donors come from a square tile that spreads them as a disk of this radius would",
       "near donors differ least where histories are old; Bitterli et al. 2020 use 30"},
      {"normal_threshold",
       0.9,
       -1.0,
       1.0,
       {},
       "least cosine between the normals of two pixels' surfaces",
       "Bitterli et al. 2020: 25 degrees = 0.906"},
      {"plane_threshold",
       0.05,
       0.0,
       10.0,
       {},
       "largest distance from each other's plane over the camera distance",
       "Bitterli et al. 2020 compare depths at 10 %"},
  };
}

// Where the integrator says that it takes no donors over space, or none at all.
std::string whyWithoutEffect(const std::string& name, const ParameterMap& p) {
  const auto neighbours = p.find("spatial_neighbours"), temporal = p.find("temporal");
  if (neighbours == p.end() || neighbours->second != ParameterValue(int64_t{0})) return "";
  if (name == "spatial_radius") return "spatial_neighbours is 0";
  const bool isThreshold = name == "normal_threshold" || name == "plane_threshold";
  const bool isOff = temporal != p.end() && temporal->second == ParameterValue(false);
  return isThreshold && isOff ? "temporal is false and spatial_neighbours is 0" : "";
}

std::vector<std::byte> pack(const std::string&, const ParameterMap& p) {
  const auto number = [&](const char* name) { return std::get<double>(p.at(name)); };
  rl::PixelCacheParams out{};
  // The root mean square distance of two points of a square of side s is s / sqrt(3), that of a
  // point of a disk to its centre r / sqrt(2).
  const double side = std::sqrt(1.5) * number("spatial_radius");
  out.tile = static_cast<uint32_t>(std::lround(side));
  out.minNormalDot = static_cast<float>(number("normal_threshold"));
  out.maxPlaneDistance = static_cast<float>(number("plane_threshold"));
  return bytesOf(out);
}

}  // namespace

const CacheInfo& pixelCacheInfo() {
  static const CacheInfo info = [] {
    CacheInfo i;
    i.name = "pixel";
    i.summary =
        "one slot a pixel; donors by reprojection over time and from a mirror partner over space";
    i.parameters = parameterInfos();
    i.inputs = {"visible", "visible_before"};
    i.buffers = {{"outlines", sizeof(uint32_t), 0, -1}};
    i.passes = {{"outlines", "pixel_outlines", false}};
    i.onlyOnNewViews = true;
    i.whyWithoutEffect = whyWithoutEffect;
    i.packParameters = pack;
    return i;
  }();
  return info;
}

}  // namespace restlab
