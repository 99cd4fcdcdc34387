// Registers `local`: lighting models, shading, shadows, occlusion and reflections, each a value of
// a parameter.
#include "integrators/local/local.h"

#include <set>
#include <string>

#include "core/frame/frame_graph.h"
#include "core/frame/integrator.h"
#include "core/frame/schema.h"

namespace restlab {

namespace {

// The fragment shader of a lecture: 0.05 + max(n.l, 0) of the colour, and 0.4 max(r.e, 0)^20.
constexpr const char* kLecture = "lecture";
constexpr double kLectureAmbient = 0.05, kLectureHighlight = 0.4, kLecturePower = 20.0;

struct LocalSettings {
  std::string preset = "none";
  uint32_t model = rl::RL_LOCAL_CLOSURE;
  uint32_t shading = rl::RL_LOCAL_PER_PIXEL;
  uint32_t shadows = 1;
  uint32_t occlusion = 0;
  uint32_t reflections = 0;
  uint32_t lightSamples = 1;
  uint32_t occlusionRays = 1;
  double occlusionRadius = 0.0;
  double ambient = 0.0;
  double highlight = kLectureHighlight;
  double highlightPower = kLecturePower;
};

const Schema<LocalSettings>& schema() {
  using S = LocalSettings;
  using P = Parameter<S>;
  const Range rays{1.0, double(rl::RL_LOCAL_MOST_RAYS)};
  static const Schema<S> all = {
      P(&S::preset, "preset", Choices{"none", kLecture},
        "lecture: Phong's model in each pixel, ambient 0.05, highlight 0.4, power 20, no shadows, "
        "occlusion or reflections, whatever they are set to",
        "the shader that lectures begin with"),
      P(&S::model, "model", Choices{"closure", "lambert", "phong", "blinn_phong"},
        "closure: the scene's own materials; the others see their albedo alone",
        "Phong 1975; Blinn 1977"),
      P(&S::shading, "shading", Choices{"phong", "gouraud", "flat"},
        "light is computed in each pixel, at the corners of a triangle, or once a triangle",
        "Phong 1975; Gouraud 1971"),
      P(&S::shadows, "shadows", Choices{"none", "rays"}, "of light samples", "a shadow ray each"),
      P(&S::occlusion, "occlusion", Choices{"none", "rays"},
        "the share of ambient light that arrives, by rays about the normal",
        "Zhukov et al. 1998; cosine-weighted rays"),
      P(&S::reflections, "reflections", Choices{"none", "mirror", "glossy"},
        "mirror: also through smooth glass; glossy: in rough reflections and glass, too",
        "Whitted 1980; Cook et al. 1984"),
      P(&S::lightSamples, "light_samples", rays,
        "of each point of the first surface; reflections have one", "path has one")
          .sameMean(),
      P(&S::occlusionRays, "occlusion_rays", rays,
        "of each point of the first surface; reflections have one", "one, as all else")
          .sameMean(),
      P(&S::occlusionRadius, "occlusion_radius", Range{0.0, 1e9},
        "metres up to which a surface takes ambient light away; 0: any distance", "no radius"),
      P(&S::ambient, "ambient", Range{0.0, 1e9},
        "radiance that arrives from everywhere, beside a scene's own",
        "none: it depends on the scene"),
      P(&S::highlight, "highlight", Range{0.0, 1e3},
        "factor of the lobe of phong and blinn_phong; 1: as bright as white Lambert",
        "lectures: 0.4"),
      P(&S::highlightPower, "highlight_power", Range{0.0, 1e6},
        "exponent of the lobe of phong and blinn_phong", "lectures: 20")};
  return all;
}

LocalSettings settingsOf(const ParameterMap& parameters) {
  LocalSettings s = schema().read(parameters);
  if (s.preset != kLecture) return s;
  s.model = rl::RL_LOCAL_PHONG;
  s.shading = rl::RL_LOCAL_PER_PIXEL;
  s.shadows = s.occlusion = s.reflections = 0;
  s.ambient = kLectureAmbient;
  s.highlight = kLectureHighlight;
  s.highlightPower = kLecturePower;
  return s;
}

void recordLocal(FrameGraph& g, const FrameInfo& f) {
  const LocalSettings s = settingsOf(f.parameters);
  const rl::LocalParams params = {.model = s.model,
                                  .shading = s.shading,
                                  .shadows = s.shadows,
                                  .occlusion = s.occlusion,
                                  .reflections = s.reflections,
                                  .lightSamples = s.lightSamples,
                                  .occlusionRays = s.occlusionRays,
                                  .occlusionRadius = float(s.occlusionRadius),
                                  .ambient = float(s.ambient),
                                  .highlight = float(s.highlight),
                                  .highlightPower = float(s.highlightPower)};
  const Buffer radiance = g.buffer("radiance", f.pixels, sizeof(glm::vec3));
  g.kernels<rl::LocalBuffers>(params, {radiance}).pass("local", "local").writes({radiance});
  g.shared.radiance = radiance;
}

std::string whyUnused(const std::string& name, const ParameterMap& parameters) {
  const LocalSettings s = schema().read(parameters);
  const bool isLecture = s.preset == kLecture;
  const std::set<std::string> ofPreset = {"model",   "shading",   "shadows",         "occlusion",
                                          "ambient", "highlight", "highlight_power", "reflections"};
  if (isLecture && ofPreset.contains(name)) return "preset = lecture sets it";
  const bool hasLobe = s.model == rl::RL_LOCAL_PHONG || s.model == rl::RL_LOCAL_BLINN_PHONG;
  if ((name == "highlight" || name == "highlight_power") && !hasLobe)
    return "model has no lobe of a power";
  if ((name == "occlusion_rays" || name == "occlusion_radius") && (isLecture || s.occlusion == 0))
    return "occlusion is none";
  return "";
}

}  // namespace

const IntegratorInfo& localIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i;
    i.name = "local";
    i.summary =
        "local lighting: lamps, ambient light, shadows, occlusion and reflections, each optional";
    i.modes = {
        {"biased", BiasClass::biased,
         "most light of more than one rough surface is left out, and mirrors and glass unless "
         "asked for; models and ambient light of its own stand for others"}};
    i.leavesOut = "light of more than one rough surface";
    i.parameters = schema().infos();
    i.reasonUnused = whyUnused;
    i.record = recordLocal;
    return i;
  }();
  return info;
}

}  // namespace restlab
