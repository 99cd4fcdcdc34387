// Small discrete world for the shipped resampling code. Included by one translation unit per
// meaning of `real`; everything is in an unnamed namespace, since the types differ between units.
//
// Samples are labels 0..3 (or EXACT_LABELS of them), shared by all shading points like points on
// lights: a shift keeps the label. At a shading point a label has a measure (the size of its part
// of the domain; the integral is sum measure f V), which makes the shift's Jacobian measure_to /
// measure_from. A shift may be undefined for a label, by a predicate symmetric in the two shading
// points.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "core/dialect/dialect.h"
#include "core/dialect/types.h"
#include "core/resampling/reservoir.h"
#include "tests/exact/enumeration.h"

namespace rl {
namespace {

using restlab::exact::Decisions;

#ifndef EXACT_LABELS
#define EXACT_LABELS 4
#endif
constexpr uint kLabels = EXACT_LABELS;
constexpr uint kAnchors = 5;

struct WorldAnchor {
  uint index = 0;
};

struct WorldReservoir {
  uint label = 0;
  ReservoirState state{};
};

struct World {
  real3 f[kAnchors][kLabels];          // integrand without visibility
  real visibility[kAnchors][kLabels];  // transmittance between shading point and sample
  real measure[kAnchors][kLabels];
  bool defined[kAnchors][kAnchors][kLabels];
  double candidate[kAnchors][kLabels];  // probability of drawing the label; the rest fails
  real3 ratio[kAnchors][kAnchors];      // ratio of reflectances: arbitrary
  bool omitsJacobian = false;           // deliberate mistake: donors' weights omit it

  dvec3 truth(uint shadingPoint) const {
    dvec3 sum(0.0);
    for (uint l = 0; l < kLabels; ++l) {
      sum += dvec3(f[shadingPoint][l]) * double(visibility[shadingPoint][l]) *
             double(measure[shadingPoint][l]);
    }
    return sum;
  }
};

// Input of a merge.
struct MergeInput {
  uint shadingPoint = 0;
  WorldReservoir reservoir;
  real confidence = real(1.0f);
  bool exists = true;                                // donors only
  real cap = std::numeric_limits<real>::infinity();  // cap of a donor's confidence
};

// State of the shipped reuse loop.
struct WorldMerge {
  std::vector<MergeInput> donors;
  std::vector<Shifted> canonicalAtNeighbour, neighbourAtCanonical;
  std::vector<real3> ratios;
};

// Shipped code with callbacks into the world. Random numbers are decided instead of drawn: the
// shipped acceptance is called with u on the wanted side of its threshold, and must agree.
struct Kernel {
  const World* world = nullptr;
  Decisions* decisions = nullptr;
  uint droppedWeights = 0;
#define RL_HEALTH(kind) (++droppedWeights)
#include "core/dialect/math.glsl"
#define risAccept risAcceptShipped
#include "core/resampling/ris.glsl"
#undef risAccept
#include "core/resampling/mis.glsl"

  bool risAccept(real& wSum, real w, real) {
    const real clean = risCleanWeight(w);
    real after = wSum + clean;
    const double p = after > real(0.0f) ? double(clean) / double(after) : 0.0;
    const bool wanted = decisions->decide(p);
    const real justBelowOne = real(1.0f) - (sizeof(real) == 8 ? real(0x1p-53) : real(0x1p-24));
    const bool accepted = risAcceptShipped(wSum, w, wanted ? real(0.0f) : justBelowOne);
    EXPECT_EQ(accepted, wanted) << "weight " << w << " of " << wSum;
    EXPECT_EQ(wSum, after);
    return accepted;
  }

  real reuseTarget(const real3& f) { return rlLuminance(f); }
  // Returns the sample of a reservoir at `from` as seen by `to`, without visibility.
  Shifted shift(const WorldReservoir& r, const WorldAnchor& from, const WorldAnchor& to) const {
    Shifted s{real3(real(0.0f)), real(1.0f)};
    if (!(r.state.W > real(0.0f)) || !world->defined[from.index][to.index][r.label]) return s;
    s.jacobian = world->measure[to.index][r.label] / world->measure[from.index][r.label];
    s.F = world->f[to.index][r.label];
    return s;
  }
  real visibilityOf(const WorldReservoir& r, const WorldAnchor& at) {
    return world->visibility[at.index][r.label];
  }
#define RL_REUSE_STATE WorldMerge
  bool reuseDonor(const WorldMerge& m, uint k, ReservoirState& donor) {
    donor = m.donors[k].reservoir.state;
    donor.confidence = reuseCapped(m.donors[k].confidence, m.donors[k].cap);
    if (world->omitsJacobian) donor.W /= m.neighbourAtCanonical[k].jacobian;
    return m.donors[k].exists;
  }
  Shifted reuseCanonicalAtNeighbour(const WorldMerge& m, uint k) const {
    return m.canonicalAtNeighbour[k];
  }
  Shifted reuseNeighbourAtCanonical(const WorldMerge& m, uint k) const {
    return m.neighbourAtCanonical[k];
  }
  real3 reuseRatio(const WorldMerge& m, uint k) const { return m.ratios[k]; }
  real reuseUniform(const WorldMerge&, uint) const { return real(0.5f); }
#include "core/resampling/donors.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/merge_loop.glsl"
};

// Reservoir that a random process may produce, with its probability; equal reservoirs are joined.
struct Outcome {
  double probability = 0.0;
  WorldReservoir reservoir;
  dvec3 estimate{0.0};
};

class Outcomes {
 public:
  void add(double probability, const WorldReservoir& r, const dvec3& estimate) {
    const std::array<double, 11> key = {double(r.label),
                                        double(r.state.W),
                                        double(r.state.F.x),
                                        double(r.state.F.y),
                                        double(r.state.F.z),
                                        double(r.state.residual.x),
                                        double(r.state.residual.y),
                                        double(r.state.residual.z),
                                        estimate.x,
                                        estimate.y,
                                        estimate.z};
    Outcome& outcome = byValue_[key];
    outcome.probability += probability;
    outcome.reservoir = r;
    outcome.estimate = estimate;
  }

  std::vector<Outcome> list() const {
    std::vector<Outcome> result;
    for (const auto& [key, outcome] : byValue_) result.push_back(outcome);
    return result;
  }

 private:
  std::map<std::array<double, 11>, Outcome> byValue_;
};

dvec3 meanOfSample(const std::vector<Outcome>& outcomes) {
  dvec3 sum(0.0);
  for (const Outcome& o : outcomes) {
    sum += o.probability * dvec3(o.reservoir.state.F) * double(o.reservoir.state.W);
  }
  return sum;
}

dvec3 meanOfEstimate(const std::vector<Outcome>& outcomes) {
  dvec3 sum(0.0);
  for (const Outcome& o : outcomes) sum += o.probability * o.estimate;
  return sum;
}

[[maybe_unused]] dvec3 meanOfResidual(const std::vector<Outcome>& outcomes) {
  dvec3 sum(0.0);
  for (const Outcome& o : outcomes) sum += o.probability * dvec3(o.reservoir.state.residual);
  return sum;
}

// Returns all outcomes of initial resampling of `count` independent candidates at a shading point.
[[maybe_unused]] std::vector<Outcome> initialOutcomes(const World& world, uint shadingPoint,
                                                      uint count, real confidence) {
  Outcomes outcomes;
  Kernel kernel;
  kernel.world = &world;
  restlab::exact::enumerate([&](Decisions& decisions) {
    kernel.decisions = &decisions;
    WorldReservoir selected;
    selected.state.confidence = confidence;
    real wSum = real(0.0f);
    for (uint c = 0; c < count; ++c) {
      double left = 1.0;
      for (uint l = 0; l < kLabels; ++l) {
        const double p = world.candidate[shadingPoint][l];
        const bool drawn = p > 0.0 && decisions.decide(std::min(1.0, p / left));
        left -= p;
        if (!drawn) continue;
        const real3 F = world.f[shadingPoint][l] * world.visibility[shadingPoint][l];
        const real W = real(double(world.measure[shadingPoint][l]) / p);
        if (kernel.risAccept(wSum, kernel.reuseTarget(F) * W / real(float(count)), real(0.0f))) {
          selected.label = l;
          selected.state.F = F;
        }
        break;
      }
    }
    selected.state.W = kernel.risContributionWeight(wSum, kernel.reuseTarget(selected.state.F));
    outcomes.add(decisions.probability(), selected,
                 dvec3(selected.state.F) * double(selected.state.W));
  });
  return outcomes.list();
}

// Runs one shipped merge of given reservoirs, over all its decisions.
template <class F>
void mergeOnce(const World& world, const MergeInput& canonical,
               const std::vector<MergeInput>& donors, uint flags, F use) {
  Kernel kernel;
  kernel.world = &world;
  WorldReservoir own = canonical.reservoir;
  own.state.confidence = canonical.confidence;
  WorldMerge merge;
  merge.donors = donors;
  const auto shift = [&](const WorldReservoir& r, uint from, uint to, uint assumed) {
    if (from == to) return kernel.mergeUnshifted(r.state);
    Shifted s = kernel.shift(r, WorldAnchor{from}, WorldAnchor{to});
    if ((flags & assumed) == 0u) s.F *= kernel.visibilityOf(r, WorldAnchor{to});
    return s;
  };
  for (const MergeInput& donor : donors) {
    merge.canonicalAtNeighbour.push_back(
        shift(own, canonical.shadingPoint, donor.shadingPoint, RL_REUSE_ASSUME_VISIBLE));
    merge.neighbourAtCanonical.push_back(shift(
        donor.reservoir, donor.shadingPoint, canonical.shadingPoint, RL_REUSE_ASSUME_VISIBLE_HERE));
    merge.ratios.push_back(world.ratio[donor.shadingPoint][canonical.shadingPoint]);
  }
  restlab::exact::enumerate([&](Decisions& decisions) {
    kernel.decisions = &decisions;
    WorldReservoir r = own;
    uint winner = 0;
    real jacobian = real(0.0f);
    const real3 estimate =
        kernel.reuseMerge(merge, uint(donors.size()), flags, r.state, winner, jacobian);
    if (winner != RL_INVALID) {
      r.label = donors[winner].reservoir.label;
      EXPECT_EQ(jacobian, merge.neighbourAtCanonical[winner].jacobian);
    }
    use(decisions.probability(), r, dvec3(estimate));
  });
}

// Independent input of a merge, with all its outcomes.
struct Source {
  uint shadingPoint = 0;
  real confidence = real(1.0f);
  std::vector<Outcome> outcomes;
};

std::vector<Outcome> mergeOutcomes(const World& world, const Source& canonical,
                                   const std::vector<Source>& donors, uint flags,
                                   real cap = std::numeric_limits<real>::infinity()) {
  Outcomes result;
  std::vector<MergeInput> inputs(donors.size());
  std::function<void(size_t, double)> choose = [&](size_t k, double probability) {
    if (k < donors.size()) {
      for (const Outcome& o : donors[k].outcomes) {
        inputs[k] = {donors[k].shadingPoint, o.reservoir, donors[k].confidence, true, cap};
        choose(k + 1, probability * o.probability);
      }
      return;
    }
    for (const Outcome& o : canonical.outcomes) {
      mergeOnce(world, {canonical.shadingPoint, o.reservoir, canonical.confidence}, inputs, flags,
                [&](double p, const WorldReservoir& r, const dvec3& estimate) {
                  result.add(probability * o.probability * p, r, estimate);
                });
    }
  };
  choose(0, 1.0);
  return result.list();
}

// Makes a random world. `partial` sets some visibilities and integrands to zero and leaves some
// shifts undefined; the candidates of every shading point cover its integrand's support and may
// draw zeros, too.
[[maybe_unused]] World randomWorld(uint seed, bool partial) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  const auto chance = [&](double p) { return partial && uniform(random) < 0.1 + 0.9 * p; };
  World w{};
  for (uint a = 0; a < kAnchors; ++a) {
    double sum = 0.0;
    for (uint l = 0; l < kLabels; ++l) {
      w.f[a][l] = chance(0.2) ? real3(real(0.0f))
                              : real3(real(uniform(random)), real(uniform(random)),
                                      real(4.0 * uniform(random)));
      w.visibility[a][l] = chance(0.3) ? real(0.0f) : chance(0.3) ? real(0.4f) : real(1.0f);
      w.measure[a][l] = real(std::pow(uniform(random), -1.5));
      const bool zero = !(w.f[a][l].x > real(0.0f)) || !(w.visibility[a][l] > real(0.0f));
      w.candidate[a][l] = zero && chance(0.5) ? 0.0 : uniform(random);
      sum += w.candidate[a][l];
    }
    const double fail = partial ? 0.3 * uniform(random) : 0.0;
    for (uint l = 0; l < kLabels; ++l) {
      w.candidate[a][l] = sum > 0.0 ? w.candidate[a][l] / sum * (1.0 - fail) : 0.0;
    }
    for (uint b = 0; b < kAnchors; ++b) {
      w.ratio[a][b] = real3(real(uniform(random)), real(3.0 * uniform(random)), real(0.0f));
      for (uint l = 0; l < kLabels; ++l) {
        w.defined[a][b][l] = b < a ? w.defined[b][a][l] : a == b || !chance(0.25);
      }
    }
  }
  return w;
}

}  // namespace
}  // namespace rl
