// Host side of `accumulate`.
#include "denoise/accumulate/accumulate.h"

#include "core/frame/denoiser.h"
#include "core/temporal_gradients/settings.h"

namespace restlab {

const DenoiserInfo& accumulateDenoiserInfo();

const DenoiserInfo& accumulateDenoiserInfo() {
  static const DenoiserInfo info = [] {
    DenoiserInfo i;
    i.name = "accumulate";
    i.summary = "the exponential average of the frames that show the same surface";
    i.biasOfStillView = BiasClass::unbiased;
    i.biasOfMovingView = BiasClass::biased;
    i.why =
        "still view: the weights depend on the frame's number alone; moving: radiance lags behind "
        "where it changes with the view, and at edges; reading between pixels blurs";
    i.parameters = {
        {"accumulate_cap",
         20.0,
         0.0,
         1.0e6,
         {},
         "frames that a history may weigh; the weight of a new frame is 1 / (this + 1) at least",
         "the confidence cap of reservoirs: Lin et al. 2022"},
        {"accumulate_filter",
         std::string("bilinear"),
         0,
         0,
         {"nearest", "bilinear"},
         "how the history is read where the camera has moved",
         "measured: docs/decisions/bilinear-history.md"},
        {"accumulate_normal_threshold",
         0.9,
         -1.0,
         1.0,
         {},
         "least cosine between the normals of a pixel and its history",
         "as of the pixel cache"},
        {"accumulate_plane_threshold",
         0.05,
         0.0,
         10.0,
         {},
         "largest distance from each other's plane over the distance to the camera",
         "as of the pixel cache"}};
    i.inputs = {"radiance", "visible", "visible_before"};
    i.optionalInputs = {kChanges};
    i.buffers = {{"accumulated", sizeof(glm::vec3), 0, -1},
                 {"accumulate_history", 16, 0, 2},
                 {"accumulate_history_before", 16, 0, 1}};
    i.passes = {{"accumulate", "accumulate", false}};
    i.hasHistory = true;
    // accumulate_cap counts from the first whole average on (accumulate.glsl).
    i.shownFrames = [](const ParameterMap& p, double radianceFrames) {
      return radianceFrames + std::get<double>(p.at("accumulate_cap"));
    };
    i.packParameters = [](const std::string&, const ParameterMap& p) {
      rl::AccumulateParams out{};
      out.cap = static_cast<float>(std::get<double>(p.at("accumulate_cap")));
      out.similarity.minNormalDot =
          static_cast<float>(std::get<double>(p.at("accumulate_normal_threshold")));
      out.similarity.maxPlaneDistance =
          static_cast<float>(std::get<double>(p.at("accumulate_plane_threshold")));
      if (std::get<std::string>(p.at("accumulate_filter")) == "bilinear")
        out.flags |= rl::RL_ACCUMULATE_BILINEAR;
      out.changes = packChanges(p);
      return bytesOf(out);
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
