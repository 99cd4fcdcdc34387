// Host side of `restir_gi`: parameters, buffers, passes and the declaration of its bias.
//
// One reservoir a pixel over film samples and paths: light samples at x1 (Bitterli et al. 2020) and
// paths that reconnect at x2 (Ouyang et al. 2021), merged by generalised RIS with pairwise
// MIS (Lin et al. 2022). The film sample is part of the path, as in
// Area ReSTIR (Zhang et al. 2024): a shift traces x1 anew. Unlike the GI paper, x2 is re-evaluated
// for the new direction, BSDF and MIS weight, so that glossy x2 are unbiased too.
#include "integrators/restir_gi/restir_gi.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "core/base/packing.h"
#include "core/caches/entries/layers.h"
#include "core/caches/entries/settings.h"
#include "core/frame/frame_graph.h"
#include "core/frame/integrator.h"
#include "core/radiance_cache/settings.h"
#include "core/resampling/pair_settings.h"
#include "core/temporal_gradients/settings.h"
#include "integrators/restir_gi/donor_layers.h"
#include "integrators/restir_gi/pixel_donors.h"

namespace restlab {

namespace {

std::vector<ParameterInfo> parameterInfos() {
  std::vector<ParameterInfo> infos = {
      {"confidence_cap",
       20.0,
       1.0,
       1000.0,
       {},
       "confidence that a donor from the last frame may carry in a still view, in frames",
       "Lin et al. 2022 and its implementations: 20"},
      {"moving_confidence_cap",
       8.0,
       1.0,
       1000.0,
       {},
       "the same in frames of a new view, where it is at most confidence_cap: a sample that is "
       "rarely found from where the donor was gets up to that many times its weight",
       "measured: docs/decisions/moving-confidence-cap.md"},
      {"light_candidates",
       int64_t{1},
       1,
       64,
       {},
       "light samples a pixel and frame, of which one is kept",
       "1: the same rays as the path tracer"},
      {"spatial_neighbours",
       int64_t{3},
       0,
       rl::RL_MAX_DONORS,
       {},
       "donors of the spatial pass while the view is new: it moves, or was still for young_frames",
       "each costs a shift, two rays a pixel; measured: docs/decisions/donors-by-age.md"},
      {"aged_neighbours",
       int64_t{1},
       0,
       rl::RL_MAX_DONORS,
       {},
       "donors of the spatial pass afterwards, where spatial_neighbours is not less",
       "measured: docs/decisions/donors-by-age.md"},
      {"young_frames",
       8.0,
       0.0,
       1000.0,
       {},
       "frames of a still view up to which histories are young",
       "about the age from which young histories gain no more (docs/performance.md); not swept"},
      {"donor_noise",
       0.5,
       0.0,
       1000.0,
       {},
       "how fast a donor's share falls with the age of the history: 1 / (1 + this x (age - 1))",
       "core/resampling/donors.glsl; measured: docs/decisions/donors-by-age.md"},
      {"light_edge_samples",
       int64_t{8},
       0,
       64,
       {},
       "camera rays through pixels where a lamp in view ends, in frames of a new view; 0: none "
       "but "
       "the path's",
       "core/transport/lights_in_view.glsl; measured: docs/decisions/light-edge-samples.md"},
      {"temporal", true, 0, 0, {}, "temporal reuse", "Ouyang et al. 2021"},
      {"reproject",
       true,
       0,
       0,
       {},
       "in frames of a new view, the pixel of the last frame that showed the surface is a donor",
       "Ouyang et al. 2021; false leaves what a cache in world space does alone"},
      {"roughness_limit",
       0.2,
       0.0,
       1.0,
       {},
       "perceptual roughness below which x1 is not reused: own light alone (counted)",
       "Lin et al. 2022, section 6.5: 0.2",
       true},
      {"max_jacobian",
       10.0,
       1.0,
       1.0e6,
       {},
       "shifts whose Jacobian lies outside [1/x, x] are undefined, both ways",
       "symmetric rejection keeps the estimator unbiased; Falcor and RTXDI: 10; measured: "
       "docs/decisions/moving-confidence-cap.md"},
      {"max_reflectance_ratio",
       4.0,
       0.0,
       1.0e6,
       {},
       "bound per channel on the ratio of reflectances by which a donor's per-channel estimate is "
       "scaled; any bound is unbiased, a large one carries noise, 0 carries nothing",
       "control variate: core/resampling/merge.glsl; docs/decisions/control-variates.md"},
      {"shading",
       std::string("control_variate"),
       0,
       0,
       {"winner", "decoupled", "control_variate"},
       "what is shown: the selected sample, the weighted sum of all inputs, or that sum with the "
       "inputs' "
       "per-channel estimates carried along",
       "decoupled: Wyman and Panteleev 2021; control variate: core/resampling/merge.glsl"},
      {"mis",
       std::string("pairwise"),
       0,
       0,
       {"pairwise", "defensive", "confidence"},
       "resampling MIS weights; `defensive` favours the pixel's own sample, `confidence` is 1/M, "
       "biased and darker",
       "Lin et al. 2022, section 5.4; Wyman et al. 2023, algorithm 7; Bitterli et al. 2020"},
  };
  for (ParameterInfo& info : pairParameters()) infos.push_back(std::move(info));
  return infos;
}

template <typename T>
T get(const ParameterMap& parameters, const char* name) {
  return std::get<T>(parameters.at(name));
}

rl::RestirGiParams packed(const std::string& mode, const ParameterMap& p) {
  uint32_t flags = 0;
  const std::string& mis = get<std::string>(p, "mis");
  if (mis != "confidence") flags |= rl::RL_REUSE_PAIRWISE;
  if (mis == "defensive") flags |= rl::RL_REUSE_DEFENSIVE;
  const std::string& shading = get<std::string>(p, "shading");
  if (shading == "control_variate") flags |= rl::RL_REUSE_CONTROL_VARIATE;
  if (shading == "winner") flags |= rl::RL_REUSE_WINNER_ONLY;
  rl::RestirGiParams out{};
  out.temporalFlags = flags;
  out.spatialFlags = flags;
  if (mode == "biased") {
    out.temporalFlags |= rl::RL_REUSE_ASSUME_VISIBLE | rl::RL_REUSE_ASSUME_VISIBLE_HERE;
  }
  out.path.lightCandidates = static_cast<uint32_t>(get<int64_t>(p, "light_candidates"));
  out.spatialNeighbours = static_cast<uint32_t>(get<int64_t>(p, "spatial_neighbours"));
  out.neighboursLongHistory =
      std::min(static_cast<uint32_t>(get<int64_t>(p, "aged_neighbours")), out.spatialNeighbours);
  // A history of n still frames before this one has the age min(n, cap) + 1.
  const double young = get<double>(p, "young_frames");
  const double oldest = get<bool>(p, "temporal") ? get<double>(p, "confidence_cap") + 1.0 : 1.0;
  out.longHistoryFrames = oldest <= young ? rl::RL_INVALID : static_cast<uint32_t>(young);
  out.lightEdgeSamples = static_cast<uint32_t>(get<int64_t>(p, "light_edge_samples"));
  out.donorNoise = static_cast<float>(get<double>(p, "donor_noise"));
  out.temporalReuse = get<bool>(p, "temporal") ? 1u : 0u;
  out.reproject = get<bool>(p, "reproject") ? 1u : 0u;
  out.confidenceCap = static_cast<float>(get<double>(p, "confidence_cap"));
  out.movingConfidenceCap =
      std::min(out.confidenceCap, static_cast<float>(get<double>(p, "moving_confidence_cap")));
  const auto roughness = static_cast<float>(get<double>(p, "roughness_limit"));
  out.path.minAlpha = roughness * roughness;
  out.path.maxJacobian = static_cast<float>(get<double>(p, "max_jacobian"));
  out.maxReflectanceRatio = static_cast<float>(get<double>(p, "max_reflectance_ratio"));
  out.pairs = packPairs(p);
  out.changes = packChanges(p);
  out.entries = packEntries(p);
  out.cells = packRadiance(p);
  return out;
}

void recordRestirGi(FrameGraph& g, const FrameInfo& f) {
  const FrameBuffers& s = g.shared;
  const rl::RestirGiParams params = packed(f.mode, f.parameters);
  const bool isTemporal = params.temporalReuse != 0, hasEntries = params.entries.count != 0;
  constexpr uint32_t kQuad = 16, kGlossy = rl::RL_FEATURE_GLOSSY;
  constexpr uint32_t kReservoir = kQuad * rl::RL_PATH_RESERVOIR_QUADS;
  constexpr uint32_t kSuffix = kQuad * rl::RL_PATH_SUFFIX_QUADS;
  const Buffer radiance = g.buffer("radiance", f.pixels, sizeof(glm::vec3));
  const History unresampled = g.advance(g.history("unresampled_radiance", f.pixels, kQuad));
  const Buffer reservoirs = g.buffer("reservoirs", f.pixels, kReservoir);
  const Buffer history = g.buffer("reservoir_history", f.pixels, kReservoir);
  const Buffer suffixes = g.buffer("path_suffixes", f.pixels, kSuffix, kGlossy);
  const Buffer suffixHistory = g.buffer("path_suffix_history", f.pixels, kSuffix, kGlossy);
  const Buffer pairedShifts = g.buffer("spatial_shift", f.pixels * params.spatialNeighbours, kQuad);
  const Buffer outlines = g.buffer("outlines", f.pixels, sizeof(uint32_t));
  const Buffer entryReservoirs = g.buffer("entry_reservoirs", params.entries.count, kReservoir);
  const Buffer entrySuffixes = g.buffer("entry_suffixes", params.entries.count, kSuffix, kGlossy);
  const Kernels kernels = g.kernels<rl::RestirGiBuffers>(
      params,
      {s.surfaces.now, s.surfaces.before, s.proposals,        s.shadingPoints, s.insertions,
       s.cellKeys,     s.cellPlaces,      s.cellLight,        s.cellRays,      s.changes,
       radiance,       unresampled.now,   unresampled.before, reservoirs,      history,
       suffixes,       suffixHistory,     pairedShifts,       outlines,        entryReservoirs,
       entrySuffixes});

  if (f.isNewView) {
    kernels.pass("lights_in_view", "restir_gi_lights_in_view")
        .reads({s.surfaces.now})
        .writes({unresampled.now});
  }
  // In a still view this pass merges the history, too, and leaves candidates for entries in it.
  GraphPass& initial = kernels.pass("initial", "restir_gi_initial")
                           .reads({unresampled.before, history, suffixHistory, s.changes,
                                   s.cellKeys, s.cellPlaces, s.cellLight})
                           .writes({reservoirs, suffixes})
                           .updates({unresampled.now, s.cellRays});
  if (hasEntries) {
    initial.updates({history, suffixHistory});
    kernels.pass("cache_update", "restir_gi_cache_update")
        .over(params.entries.count)
        .reads(
            {s.surfaces.now, s.insertions, s.changes, reservoirs, suffixes, history, suffixHistory})
        .updates({s.shadingPoints, entryReservoirs, entrySuffixes});
  }
  if (f.isNewView && isTemporal) {
    kernels.pass("temporal", "restir_gi_temporal")
        .reads({s.surfaces.now, s.surfaces.before, s.changes, history, suffixHistory})
        .updates({reservoirs, suffixes});
    if (hasEntries) {
      kernels.pass("cache_reuse", "restir_gi_cache_reuse")
          .reads({s.surfaces.now, s.proposals, s.shadingPoints, s.changes, entryReservoirs,
                  entrySuffixes})
          .updates({reservoirs, suffixes});
    }
  }
  if (params.spatialNeighbours != 0) {
    if (f.isNewView) {
      kernels.pass("outlines", "restir_gi_outlines").reads({s.surfaces.now}).writes({outlines});
    }
    kernels.pass("spatial_shift", "restir_gi_spatial_shift")
        .reads({s.surfaces.now, reservoirs, suffixes, outlines})
        .writes({pairedShifts});
  }
  // Shades, too, and so runs without neighbours.
  kernels.pass("spatial", "restir_gi_spatial")
      .reads({s.surfaces.now, reservoirs, suffixes, pairedShifts, unresampled.now})
      .writes({history, suffixHistory, radiance});
  g.shared.radiance = radiance;
  g.shared.reservoirs = history;
}

bool isOneOf(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string reasonUnused(const std::string& name, const ParameterMap& p) {
  const bool isOverTime = get<bool>(p, "temporal");
  const int64_t neighbours = get<int64_t>(p, "spatial_neighbours");
  const double young = get<double>(p, "young_frames");
  const double oldest = isOverTime ? get<double>(p, "confidence_cap") + 1.0 : 1.0;
  if (isOneOf(name, {"confidence_cap", "moving_confidence_cap", "donor_noise", "mode", "reproject",
                     kValidateEvery, "validate_response"}) &&
      !isOverTime)
    return "temporal is false";
  if (name == "mode" && !get<bool>(p, "reproject")) return "reproject is false";
  if (name == "moving_confidence_cap" &&
      get<double>(p, name.c_str()) > get<double>(p, "confidence_cap"))
    return "confidence_cap is smaller";
  if (neighbours == 0 &&
      isOneOf(name, {"aged_neighbours", "young_frames", "donor_noise", "spatial_radius"}))
    return "spatial_neighbours is 0";
  if (!isOverTime && neighbours == 0 &&
      isOneOf(name, {"mis", "max_jacobian", "max_reflectance_ratio", "shading", "normal_threshold",
                     "plane_threshold"}))
    return "temporal is false and spatial_neighbours is 0";
  if (name == "aged_neighbours" && get<int64_t>(p, "aged_neighbours") > neighbours)
    return "there are no more donors than spatial_neighbours says";
  if (name == "aged_neighbours" && young >= oldest)
    return fmt::format("young_frames is {:g}, and no history is older than {:g}", young, oldest);
  if (name == "max_reflectance_ratio" && get<std::string>(p, "shading") != "control_variate")
    return "shading is not control_variate";
  return "";
}

std::string three(const glm::vec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }

// Word offsets of a reservoir, as in pathReservoirWrite() and, from kState on,
// reservoirStateWrite().
constexpr size_t kReservoir = 4 * rl::RL_PATH_RESERVOIR_QUADS;
constexpr size_t kState = 4 * rl::RL_PATH_SAMPLE_QUADS;
constexpr size_t kConfidence = kState + 3;

float number(std::span<const uint32_t> words, size_t at) { return std::bit_cast<float>(words[at]); }

std::vector<ProbeValue> probe(const FrameSnapshot& kept, size_t pixel) {
  const auto words = kept.words("reservoir_history").subspan(kReservoir * pixel, kReservoir);
  const auto own = kept.words("unresampled_radiance").subspan(4 * pixel, 4);
  const auto vector = [](std::span<const uint32_t> from) {
    return glm::vec3(number(from, 0), number(from, 1), number(from, 2));
  };
  rl::Packing packing;
  static const std::array<const char*, 4> kinds = {
      "light at x1", "Lambert x2", "glossy x2, light sample", "glossy x2, continued"};
  const uint32_t kind = words[7] & rl::RL_PATH_KIND_MASK, film = words[3];
  const float weight = number(words, kState + 2);
  std::vector<ProbeValue> values = {
      {"own light", three(vector(own))},
      {"W", fmt::format("{:.6g}", weight)},
      {"F", three(packing.unpackPositive3(words[kState], words[kState + 1]))},
      {"residual", three(packing.unpackSigned3(words[kState + 4], words[kState + 5]))}};
  if (!(weight > 0.0f)) {
    values.push_back({"kind", "none: the reservoir is empty"});
    return values;
  }
  values.push_back({"kind", kinds.at(kind)});
  values.push_back({"film", fmt::format("{:.4f} {:.4f}", double(film & 0xffffu) / 65536.0,
                                        double(film >> 16) / 65536.0)});
  values.push_back({"position or direction", three(vector(words))});
  values.push_back(
      {"radiance", three(packing.unpackPositive3(words[kState + 6], words[kState + 7]))});
  return values;
}

static_assert(sizeof(rl::GiCacheMerge::id) / sizeof(uint32_t) >= rl::RL_MAX_DONORS &&
              sizeof(rl::GiCacheMerge::id) / sizeof(uint32_t) >= rl::RL_ENTRY_INSERTIONS);

std::vector<LayerInfo> layers() {
  LayerInfo confidence, age, ofEntry;
  confidence.name = "confidence";
  confidence.summary = "confidence of the pixel's reservoir";
  confidence.unit = "samples";
  confidence.values = [](const FrameSnapshot& kept) {
    return [words = kept.words("reservoir_history")](size_t pixel) {
      return number(words, kReservoir * pixel + kConfidence);
    };
  };
  age.name = "age";
  age.summary = "frames since the view was new or the light around the pixel was found changed";
  age.unit = "frames";
  age.values = [](const FrameSnapshot& kept) {
    // Layout as in giViewLightWord().
    return [words = kept.words("unresampled_radiance")](size_t pixel) {
      return float(words[4 * pixel + 3] >> 8u);
    };
  };
  ofEntry.name = "entry_confidence";
  ofEntry.summary = "confidence of the reservoir of the pixel's entry";
  ofEntry.unit = "samples";
  ofEntry.enabledIf.parameter = kEntryCount;
  ofEntry.values = [](const FrameSnapshot& kept) {
    // A hash slot that a new entry has taken may still hold the reservoir of the previous one.
    const auto words = kept.words("entry_reservoirs"), shadingPoints = kept.words("shading_points");
    return ofPixelsEntry(kept, [words, shadingPoints](uint32_t entry) {
      const bool hasShadingPoint =
          shadingPoints[4 * rl::RL_SHADING_POINT_QUADS * size_t{entry} + 6] >> 30u != 0;
      return hasShadingPoint ? number(words, kReservoir * entry + kConfidence) : 0.0f;
    });
  };
  std::vector<LayerInfo> all = {confidence, age, ofEntry};
  for (LayerInfo& layer : giDonorLayers()) all.push_back(std::move(layer));
  return all;
}

}  // namespace

const IntegratorInfo& restir_giIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i;
    i.name = "restir_gi";
    i.summary =
        "ReSTIR GI: one reservoir a pixel, of light samples and of paths that reconnect at x2";
    i.modes = {
        {"unbiased", BiasClass::unbiased,
         "targets include visibility at every shading point, MIS weights sum to one over those who "
         "can produce a sample, confidences depend on shading points alone (near light that "
         "changed, with validate_every, on the change), BSDF and MIS weight at x2 are "
         "re-evaluated"},
        {"biased", BiasClass::biased,
         "the last frame's sample is taken as visible here, and the pixel's own as visible from "
         "there: fewer rays, a little energy moved at shadow edges"},
    };
    i.parameters = parameterInfos();
    i.usesCache = true;
    i.hasHistory = true;
    i.needsSurfaces = true;
    i.followsChanges = true;
    i.endsPaths = true;
    i.record = recordRestirGi;
    i.reasonUnused = reasonUnused;
    i.radianceFrames = [](const ParameterMap& p) {
      return get<bool>(p, "temporal") ? get<double>(p, "confidence_cap") + 1.0 : 1.0;
    };
    i.layers = layers();
    i.probe = probe;
    i.donors = giDonorsOf;
    i.biasOfParameters = [](const std::string& mode, const ParameterMap& p) {
      const bool isWrong = get<std::string>(p, "mis") == "confidence";
      return mode == "biased" || isWrong ? BiasClass::biased : BiasClass::unbiased;
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
