#include "integrators/local/local_settings.h"

#include <algorithm>
#include <set>

#include "core/frame/schema.h"

namespace restlab {

namespace {

// The fragment shader of a lecture: 0.05 + max(n.l, 0) of the colour, and 0.4 max(r.e, 0)^20.
constexpr const char* kLecture = "lecture";
constexpr double kLectureAmbient = 0.05, kLectureHighlight = 0.4, kLecturePower = 20.0;

// Steps of real-time lighting, each one on top of those before it.
enum LightingStep : int { kNoStep = -1, kAmbientLight, kDirectLight, kShadows, kOcclusion, kAll };
const Choices& lightingSteps() {
  static const Choices steps = {"ambient", "direct", "shadows", "occlusion", "reflections"};
  return steps;
}

LightingStep stepOf(const std::string& preset) {
  const auto found = std::find(lightingSteps().begin(), lightingSteps().end(), preset);
  return found == lightingSteps().end() ? kNoStep : LightingStep(found - lightingSteps().begin());
}

const Schema<LocalSettings>& localSchema() {
  using S = LocalSettings;
  using P = Parameter<S>;
  const Range rays{1.0, double(rl::RL_LOCAL_MOST_RAYS)};
  static const Schema<S> all = {
      P(&S::preset, "preset",
        Choices{"none", kLecture, "ambient", "direct", "shadows", "occlusion", "reflections"},
        "lecture: Phong's model in each pixel, ambient 0.05, highlight 0.4, power 20, no shadows, "
        "occlusion or reflections, whatever they are set to; ambient to reflections: steps, each "
        "on top of those before it",
        "lecture: the shader that lectures begin with; steps: the manual"),
      P(&S::model, "model", Choices{"closure", "lambert", "phong", "blinn_phong"},
        "closure: the scene's own materials; the others see their albedo alone",
        "Phong 1975; Blinn 1977"),
      P(&S::shading, "shading", Choices{"phong", "gouraud", "flat"},
        "light is computed in each pixel, at the corners of a triangle, or once a triangle",
        "Phong 1975; Gouraud 1971"),
      P(&S::divisions, "divisions", Range{0.0, 6.0},
        "of gouraud and flat: triangles are lit as if each were divided into 4^n",
        "the scene's own triangles"),
      P(&S::directLight, "direct_light", "false: lamps and the sky give ambient light alone",
        "light samples of the first surface"),
      P(&S::shadows, "shadows", Choices{"none", "rays", "map"},
        "of light samples; map: of lamps, by shadow maps", "a shadow ray each; Williams 1978"),
      P(&S::occlusion, "occlusion", Choices{"none", "rays", "screen"},
        "the share of ambient light that arrives, by rays about the normal, or by what the screen "
        "shows",
        "Zhukov et al. 1998, cosine-weighted rays; Mittring 2007"),
      P(&S::reflections, "reflections", Choices{"none", "mirror", "glossy"},
        "mirror: also through smooth glass; glossy: in rough reflections and glass, too",
        "Whitted 1980; Cook et al. 1984"),
      P(&S::combine, "texture_combine", Choices{"modulate", "replace", "decal", "add"},
        "colour of a texture with the colour of its material, before it is lit",
        "OpenGL 1.1; modulate: glTF"),
      P(&S::lightSamples, "light_samples", Range{0.0, double(rl::RL_LOCAL_MOST_RAYS)},
        "of each point of the first surface; reflections have one; 0: one of each light, where "
        "there are at most 64",
        "path has one")
          .sameMean(),
      P(&S::occlusionRays, "occlusion_rays", rays,
        "of each point of the first surface; reflections have one; in screen space: points",
        "one, as all else")
          .sameMean(),
      P(&S::occlusionRadius, "occlusion_radius", Range{0.0, 1e9},
        "metres up to which a surface takes ambient light away; 0: any distance; in screen space "
        "and in presets a tenth of the diagonal of the scene's box",
        "no radius"),
      P(&S::ambient, "ambient", Range{0.0, 1e9},
        "radiance that arrives from everywhere, beside a scene's own",
        "none: it depends on the scene"),
      P(&S::ambientShare, "ambient_share", Range{0.0, 1.0},
        "ambient light over the brightness (irradiance over pi) of all lights at the point, "
        "without shadows and cosines",
        "none; lectures: 0.05"),
      P(&S::highlight, "highlight", Range{0.0, 1e3},
        "factor of the lobe of phong and blinn_phong; 1: as bright as white Lambert",
        "lectures: 0.4"),
      P(&S::highlightPower, "highlight_power", Range{0.0, 1e6},
        "exponent of the lobe of phong and blinn_phong", "lectures: 20"),
      P(&S::mapSquares, "shadow_maps", Range{1.0, double(rl::RL_LOCAL_MOST_SQUARES)},
        "squares of all maps: one for a directional light or a spot, six for any other lamp; lamps "
        "that find none have shadow rays",
        "four points or areas"),
      P(&S::mapSize, "shadow_map_size", Range{1.0, 2048.0}, "texels along an edge of a square",
        "24 squares take 25 MB"),
      P(&S::mapBias, "shadow_map_bias", Range{0.0, 100.0},
        "in texels: distance that surfaces are moved towards the lamp, times the tangent of the "
        "angle of incidence plus 0.25 and the width of the filter",
        "sqrt(2) times the least for which no plane shadows itself"),
      P(&S::mapFilter, "shadow_map_filter", Range{0.0, double(rl::RL_LOCAL_MOST_FILTER)},
        "radius in texels of percentage-closer filtering; 0: the nearest texel",
        "Reeves et al. 1987; nine texels")};
  return all;
}

}  // namespace

std::vector<ParameterInfo> localParameters() { return localSchema().infos(); }

LocalSettings localSettings(const ParameterMap& parameters) {
  LocalSettings s = localSchema().read(parameters);
  s.hasOwnRadius = s.occlusion == rl::RL_LOCAL_OCCLUSION_SCREEN;
  if (s.preset == kLecture) {
    s.model = rl::RL_LOCAL_PHONG;
    s.shading = rl::RL_LOCAL_PER_PIXEL;
    s.divisions = 0;
    s.shadows = s.occlusion = s.reflections = 0;
    s.directLight = true;
    s.ambient = kLectureAmbient;
    s.ambientShare = 0.0;
    s.highlight = kLectureHighlight;
    s.highlightPower = kLecturePower;
  }
  const LightingStep step = stepOf(s.preset);
  if (step == kNoStep) return s;
  // Rays stand in where a step has something that the parameters leave out.
  const auto had = [&](LightingStep from, uint32_t value, uint32_t otherwise) {
    if (step < from) return 0u;
    return value != 0 ? value : otherwise;
  };
  s.directLight = step >= kDirectLight;
  s.shadows = had(kShadows, s.shadows, rl::RL_LOCAL_SHADOW_RAYS);
  s.occlusion = had(kOcclusion, s.occlusion, rl::RL_LOCAL_OCCLUSION_RAYS);
  s.reflections = had(kAll, s.reflections, rl::RL_LOCAL_GLOSSY);
  if (s.ambient == 0.0 && s.ambientShare == 0.0) s.ambientShare = kLectureAmbient;
  s.hasOwnRadius = true;
  return s;
}

std::string whyLocalUnused(const std::string& name, const ParameterMap& parameters) {
  const LocalSettings s = localSettings(parameters);
  const LightingStep step = stepOf(s.preset);
  const std::set<std::string> ofLecture = {
      "model",   "shading",       "divisions", "direct_light",    "shadows",    "occlusion",
      "ambient", "ambient_share", "highlight", "highlight_power", "reflections"};
  const std::string sets = "preset = " + s.preset + " sets it";
  if (s.preset == kLecture && ofLecture.contains(name)) return sets;
  if (step != kNoStep && name == "direct_light") return sets;
  if (step != kNoStep && step < kShadows && name == "shadows") return sets;
  if (step != kNoStep && step < kOcclusion && name == "occlusion") return sets;
  if (step != kNoStep && step < kAll && name == "reflections") return sets;
  if (name == "russian_roulette") return "reflections do not end at random";
  if (name == "divisions" && s.shading == rl::RL_LOCAL_PER_PIXEL)
    return "light is computed in each pixel";
  const bool hasLobe = s.model == rl::RL_LOCAL_PHONG || s.model == rl::RL_LOCAL_BLINN_PHONG;
  if (name == "highlight" || name == "highlight_power") {
    if (!hasLobe) return "model has no lobe of a power";
    if (!s.directLight) return "there is no direct light";
  }
  if (name == "shadows" && !s.directLight) return "there is no direct light";
  if (name == "light_samples" && !s.hasLamps()) return "lamps give no light";
  if ((name == "occlusion_rays" || name == "occlusion_radius") && s.occlusion == 0)
    return "occlusion is none";
  if (name.starts_with("shadow_map") && (s.shadows != rl::RL_LOCAL_SHADOW_MAP || !s.directLight))
    return "there are no shadow maps";
  return "";
}

}  // namespace restlab
