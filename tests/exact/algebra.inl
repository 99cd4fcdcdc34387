// Proofs of unbiasedness, included once per meaning of `real`, with EXACT_SUITE and kTolerance
// defined before.
#include "tests/exact/world.inl"

namespace rl {
namespace {

#define EXACT_TEST(name) TEST(EXACT_SUITE, name)

constexpr uint kPairwise = RL_REUSE_PAIRWISE;
constexpr uint kDefensive = RL_REUSE_PAIRWISE | RL_REUSE_DEFENSIVE;
constexpr double kBiasSeen = 5e-3;  // relative error that a negative test must exceed

double relativeError(const dvec3& value, const dvec3& truth) {
  // Compare a truth of 0 with the size of single samples.
  const double scale = std::max({truth.x, truth.y, truth.z, 0.1});
  const dvec3 d = abs(value - truth) / scale;
  return std::max({d.x, d.y, d.z});
}

void expectTruth(const dvec3& value, const dvec3& truth, const char* what, uint seed) {
  EXPECT_LE(relativeError(value, truth), kTolerance)
      << what << ", world " << seed << ": (" << value.x << ", " << value.y << ", " << value.z
      << ") instead of (" << truth.x << ", " << truth.y << ", " << truth.z << ")";
}

// Checks all claims on an unbiased merge at shading point 0.
void expectUnbiased(const World& world, const std::vector<Outcome>& outcomes, uint seed) {
  const dvec3 truth = world.truth(0);
  expectTruth(meanOfSample(outcomes), truth, "E[F W]", seed);
  expectTruth(meanOfEstimate(outcomes), truth, "E[estimate]", seed);
  expectTruth(meanOfResidual(outcomes) + truth, truth, "E[residual] + truth", seed);
}

Source initialSource(const World& world, uint shadingPoint, uint count, real confidence) {
  return {shadingPoint, confidence, initialOutcomes(world, shadingPoint, count, confidence)};
}

// Acceptance is decided at u = w / wSum, strictly.
EXACT_TEST(AcceptanceThreshold) {
  Kernel kernel;
  const real h = real(0.5f);
  for (const real u : {real(0.0f), real(0.24f), real(0.26f), real(0.99f)}) {
    real wSum = real(3.0f);
    EXPECT_EQ(kernel.risAcceptShipped(wSum, real(1.0f), u), u < real(0.25f));
    EXPECT_EQ(wSum, real(4.0f));
    wSum = real(0.0f);
    EXPECT_TRUE(kernel.risAcceptShipped(wSum, h, u));  // the first positive weight is always taken
  }
  real wSum = real(3.0f);
  EXPECT_FALSE(kernel.risAcceptShipped(wSum, real(1.0f), real(0.25f)));
  // Zero, negative, NaN, infinite and subnormal weights neither count nor win, not even at u = 0.
  const real bad[] = {real(0.0f),
                      real(-1.0f),
                      std::numeric_limits<real>::quiet_NaN(),
                      std::numeric_limits<real>::infinity(),
                      -std::numeric_limits<real>::infinity(),
                      real(1e-38f)};
  for (const real w : bad) {
    for (const real start : {real(0.0f), real(2.0f)}) {
      real sum = start;
      EXPECT_FALSE(kernel.risAcceptShipped(sum, w, real(0.0f))) << w;
      EXPECT_EQ(sum, start);
    }
  }
  EXPECT_EQ(kernel.risContributionWeight(real(3.0f), real(0.0f)), real(0.0f));
  EXPECT_EQ(kernel.risContributionWeight(real(3.0f), real(2.0f)), real(1.5f));
}

EXACT_TEST(RisOfIndependentCandidates) {
  for (uint seed = 0; seed < 60; ++seed) {
    const World world = randomWorld(seed, seed % 3 != 0);
    for (uint count = 1; count <= 3; ++count) {
      const auto outcomes = initialOutcomes(world, 0, count, real(1.0f));
      expectTruth(meanOfSample(outcomes), world.truth(0), "E[F W]", seed);
    }
  }
}

// Candidates of two techniques with overlapping supports under the balance heuristic: w = pHat /
// sum_t n_t p_t.
EXACT_TEST(RisUnderTheBalanceHeuristic) {
  for (uint seed = 0; seed < 60; ++seed) {
    World world = randomWorld(seed, false);
    // Technique 0 (candidates of shading point 1) misses label 0, technique 1 (of shading point 2)
    // misses label 2; labels 1 and 3 are common.
    world.candidate[1][0] = 0.0;
    world.candidate[2][2] = 0.0;
    const uint draws[2] = {2, 1};
    dvec3 mean(0.0);
    Kernel kernel;
    kernel.world = &world;
    restlab::exact::enumerate([&](Decisions& decisions) {
      kernel.decisions = &decisions;
      real wSum = real(0.0f);
      real3 selected = real3(real(0.0f));
      for (uint t = 0; t < 2; ++t) {
        for (uint n = 0; n < draws[t]; ++n) {
          double left = 1.0;
          for (uint l = 0; l < kLabels; ++l) {
            const double p = world.candidate[1 + t][l];
            const bool drawn = p > 0.0 && decisions.decide(std::min(1.0, p / left));
            left -= p;
            if (!drawn) continue;
            double density = 0.0;
            for (uint s = 0; s < 2; ++s) density += draws[s] * world.candidate[1 + s][l];
            density /= double(world.measure[0][l]);
            const real3 F = world.f[0][l];
            if (kernel.risAccept(wSum, kernel.reuseTarget(F) / real(density), real(0.0f))) {
              selected = F;
            }
            break;
          }
        }
      }
      const real W = kernel.risContributionWeight(wSum, kernel.reuseTarget(selected));
      mean += decisions.probability() * dvec3(selected) * double(W);
    });
    expectTruth(mean, world.truth(0), "E[F W]", seed);
  }
}

// sum m = 1 for any targets, confidences from 1e-6 to 1e3, and donors that cannot produce y.
EXACT_TEST(PairwiseWeightsSumToOne) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  Kernel kernel;
  for (int trial = 0; trial < 20000; ++trial) {
    const uint donors = 1 + random() % 4;
    real c[5], pHat[5], cDonors = real(0.0f);
    for (uint i = 0; i <= donors; ++i) {
      c[i] = real(std::pow(10.0, 9.0 * uniform(random) - 6.0));
      if (i > 0 && random() % 8 == 0) c[i] = real(0.0f);  // a donor without history
      if (i > 0) cDonors += c[i];
      pHat[i] = i > 0 && random() % 3 == 0 ? real(0.0f)
                                           : real(std::pow(10.0, 8.0 * uniform(random) - 4.0));
    }
    for (const bool isDefensive : {false, true}) {
      const uint flags = isDefensive ? kDefensive : kPairwise;
      ReservoirState canonical{};
      canonical.confidence = c[0];
      real sum = kernel.mergeBegin(canonical, cDonors, flags).mCanonical;
      for (uint i = 1; i <= donors; ++i) {
        const real donor =
            kernel.misPairwiseDonor(c[i], c[0], cDonors, pHat[i], pHat[0], isDefensive);
        const real term =
            kernel.misPairwiseCanonicalTerm(c[i], c[0], cDonors, pHat[0], pHat[i], isDefensive);
        EXPECT_GE(donor, real(0.0f));
        EXPECT_GE(term, real(0.0f));
        if (pHat[i] == real(0.0f)) {
          EXPECT_EQ(donor, real(0.0f));
        }
        sum += donor + term;
      }
      ASSERT_NEAR(double(sum), 1.0, kTolerance) << "trial " << trial << ", " << isDefensive;
    }
  }
}

// With donors identical to the canonical input the estimate is the confidence-weighted mean of all
// estimates, whatever is selected. (The defensive form weighs the canonical sample more than its
// carried estimate.)
EXACT_TEST(AlikeInputsAreAveraged) {
  for (uint seed = 0; seed < 50; ++seed) {
    World world = randomWorld(seed, seed % 2 != 0);
    for (uint a = 1; a < 3; ++a) {
      for (uint l = 0; l < kLabels; ++l) {
        world.f[a][l] = world.f[0][l];
        world.visibility[a][l] = world.visibility[0][l];
        world.measure[a][l] = world.measure[0][l];
        world.defined[a][0][l] = world.defined[0][a][l] = true;
      }
      world.ratio[a][0] = real3(real(1.0f));
    }
    const real c[] = {real(4.0f), real(1.0f), real(2.5f)};
    std::vector<MergeInput> inputs;
    dvec3 mean(0.0);
    for (uint a = 0; a < 3; ++a) {
      const Source source = initialSource(world, a, 2, c[a]);
      MergeInput input{a, source.outcomes[(seed + a) % source.outcomes.size()].reservoir, c[a]};
      input.reservoir.state.residual = real3(real(0.3f), real(-0.1f), real(0.2f)) * c[a];
      const ReservoirState& state = input.reservoir.state;
      mean += dvec3(state.F * state.W + state.residual) * double(c[a] / real(7.5f));
      inputs.push_back(input);
    }
    double defensiveError = 0.0;
    for (const uint flags : {kPairwise, kDefensive}) {
      mergeOnce(world, inputs[0], {inputs[1], inputs[2]}, flags | RL_REUSE_CONTROL_VARIATE,
                [&](double, const WorldReservoir&, const dvec3& estimate) {
                  if (flags == kPairwise) expectTruth(estimate, mean, "estimate", seed);
                  defensiveError = std::max(defensiveError, relativeError(estimate, mean));
                });
    }
    const auto isEmpty = [](const MergeInput& i) { return !(i.reservoir.state.W > real(0.0f)); };
    if (std::none_of(inputs.begin(), inputs.end(), isEmpty)) {
      EXPECT_GT(defensiveError, 1e-3);
    }
  }
}

// Shipped merge of up to four donors: partial supports and shifts, occluders, Jacobians, failed
// candidates, empty reservoirs, real-valued confidences down to 1e-4.
EXACT_TEST(PairwiseMerge) {
  for (uint seed = 0; seed < 200; ++seed) {
    const World world = randomWorld(seed, seed % 7 != 0);
    std::mt19937 random(1000 + seed);
    std::uniform_real_distribution<double> uniform;
    const auto confidence = [&] {
      return real(std::pow(10.0, seed % 2 == 0 ? 2.0 * uniform(random) : -4.0 * uniform(random)));
    };
    const uint donorCount = seed % 5;
    const Source canonical = initialSource(world, 0, donorCount < 3 ? 2 : 1, confidence());
    std::vector<Source> donors;
    for (uint k = 0; k < donorCount; ++k) {
      donors.push_back(initialSource(world, 1 + k, donorCount < 4 ? 1 + k % 2 : 1, confidence()));
    }
    double total = double(canonical.confidence);
    for (const Source& donor : donors) total += double(donor.confidence);
    for (const uint flags :
         {kPairwise, kPairwise | RL_REUSE_CONTROL_VARIATE, kPairwise | RL_REUSE_WINNER_ONLY,
          kDefensive, kDefensive | RL_REUSE_CONTROL_VARIATE}) {
      const auto outcomes = mergeOutcomes(world, canonical, donors, flags);
      expectUnbiased(world, outcomes, seed);
      for (const Outcome& o : outcomes) {
        EXPECT_NEAR(double(o.reservoir.state.confidence) / total, 1.0, 1e-6);
        EXPECT_GE(o.reservoir.state.W, real(0.0f));
      }
    }
  }
}

// A donor at the shading point of the canonical sample itself (a still camera) is not shifted.
EXACT_TEST(DonorAtTheSameAnchor) {
  for (uint seed = 0; seed < 100; ++seed) {
    const World world = randomWorld(seed, true);
    const auto outcomes = mergeOutcomes(
        world, initialSource(world, 0, 1, real(1.0f)),
        {initialSource(world, 0, 2, real(7.5f)), initialSource(world, 1, 1, real(20.0f))},
        kPairwise | RL_REUSE_CONTROL_VARIATE);
    expectUnbiased(world, outcomes, seed);
  }
}

// Labels that the donors can have are invisible here, and the other way round.
EXACT_TEST(DisjointSupports) {
  for (uint seed = 0; seed < 20; ++seed) {
    World world = randomWorld(seed, false);
    for (uint l = 0; l < kLabels; ++l) {
      world.visibility[0][l] = l == seed % 4 ? real(1.0f) : real(0.0f);
      world.visibility[1][l] = l == (seed + 1) % 4 ? real(1.0f) : real(0.0f);
      world.visibility[2][l] = l == (seed + 2) % 4 ? real(1.0f) : real(0.0f);
    }
    const auto outcomes = mergeOutcomes(
        world, initialSource(world, 0, 2, real(1.0f)),
        {initialSource(world, 1, 1, real(20.0f)), initialSource(world, 2, 2, real(3.0f))},
        kPairwise);
    expectUnbiased(world, outcomes, seed);
    expectTruth(world.truth(0), meanOfSample(outcomes), "E[F W]", seed);
  }
}

// No light anywhere: all reservoirs stay empty, but the confidence grows.
EXACT_TEST(AllEmpty) {
  World world = randomWorld(5, false);
  for (uint a = 0; a < kAnchors; ++a) {
    for (uint l = 0; l < kLabels; ++l) world.visibility[a][l] = real(0.0f);
  }
  const auto outcomes = mergeOutcomes(world, initialSource(world, 0, 1, real(1.0f)),
                                      {initialSource(world, 1, 1, real(4.0f))}, kPairwise);
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes[0].reservoir.state.W, real(0.0f));
  EXPECT_EQ(outcomes[0].reservoir.state.confidence, real(5.0f));
  EXPECT_EQ(outcomes[0].estimate, dvec3(0.0));
}

// An absent donor changes nothing, at any position in the list.
EXACT_TEST(AbsentDonorsChangeNothing) {
  const uint flags = kPairwise | RL_REUSE_CONTROL_VARIATE;
  for (uint seed = 0; seed < 20; ++seed) {
    const World world = randomWorld(seed, true);
    const auto input = [&](uint shadingPoint) {
      const Source s = initialSource(world, shadingPoint, 1, real(1.0f));
      return MergeInput{shadingPoint, s.outcomes.back().reservoir,
                        real(float(shadingPoint) + 0.5f)};
    };
    const auto merged = [&](const std::vector<MergeInput>& donors) {
      Outcomes result;
      mergeOnce(world, input(0), donors, flags,
                [&](double p, const WorldReservoir& r, const dvec3& e) { result.add(p, r, e); });
      return result.list();
    };
    MergeInput absent = input(3);
    absent.exists = false;
    const auto wanted = merged({input(1), input(2)});
    for (const auto& donors : {std::vector<MergeInput>{absent, input(1), input(2)},
                               std::vector<MergeInput>{input(1), absent, input(2)},
                               std::vector<MergeInput>{input(1), input(2), absent}}) {
      const auto found = merged(donors);
      ASSERT_EQ(found.size(), wanted.size());
      for (size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].probability, wanted[i].probability);
        EXPECT_EQ(found[i].estimate, wanted[i].estimate);
        EXPECT_EQ(found[i].reservoir.state.W, wanted[i].reservoir.state.W);
        EXPECT_EQ(found[i].reservoir.state.confidence, wanted[i].reservoir.state.confidence);
      }
    }
  }
}

// Frames of temporal reuse with a capped confidence and a moving camera: new samples at shading
// points 2, 1, 0, each merged with the result of the frame before. Residuals are carried along.
EXACT_TEST(ChainedMerges) {
  for (uint seed = 0; seed < 100; ++seed) {
    const World world = randomWorld(seed, seed % 4 != 0);
    const real cap = real(1.7f);
    for (const uint flags : {kPairwise, kPairwise | RL_REUSE_CONTROL_VARIATE}) {
      Source history = initialSource(world, 3, 1, real(1.0f));
      for (const uint shadingPoint : {2u, 1u, 0u}) {
        Source merged{shadingPoint, real(0.0f),
                      mergeOutcomes(world, initialSource(world, shadingPoint, 1, real(1.0f)),
                                    {history}, flags)};
        const real confidence = merged.outcomes.front().reservoir.state.confidence;
        merged.confidence = Kernel{}.reuseCapped(confidence, cap);
        expectTruth(meanOfSample(merged.outcomes), world.truth(shadingPoint), "E[F W] of a frame",
                    seed);
        history = merged;
      }
      expectUnbiased(world, history.outcomes, seed);
    }
  }
}

// A pixel's domain is its film times paths: labels are two film positions times two light points.
// At some film positions a pixel shows a surface that cannot be reused (a mirror, a lamp): its
// candidates fail there, and no shift that keeps the film sample leads there or back.
constexpr uint filmOf(uint label) { return label / 2; }

struct FilmWorld {
  World world;
  bool usable[kAnchors][2];
};

FilmWorld filmWorld(uint seed) {
  FilmWorld w{randomWorld(seed, false), {}};
  std::mt19937 random(7000 + seed);
  for (uint a = 0; a < kAnchors; ++a) {
    w.usable[a][random() % 2] = true;
    w.usable[a][0] |= random() % 2 == 0;
    for (uint l = 0; l < kLabels; l += 2) {
      // Draws the film sample first, uniformly, then the light.
      const double pair = w.world.candidate[a][l] + w.world.candidate[a][l + 1];
      const double first = w.world.candidate[a][l] / pair;
      const bool usable = w.usable[a][filmOf(l)];
      w.world.candidate[a][l] = usable ? 0.5 * first : 0.0;
      w.world.candidate[a][l + 1] = usable ? 0.5 * (1.0 - first) : 0.0;
      if (!usable) w.world.f[a][l] = w.world.f[a][l + 1] = real3(real(0.0f));
    }
  }
  for (uint a = 0; a < kAnchors; ++a) {
    for (uint b = 0; b < kAnchors; ++b) {
      for (uint l = 0; l < kLabels; ++l)
        w.world.defined[a][b][l] = w.usable[a][filmOf(l)] && w.usable[b][filmOf(l)];
    }
  }
  return w;
}

// Reuses over time at the pixel itself, then a neighbour that shows another surface at its edge.
EXACT_TEST(FilmTimesPaths) {
  for (uint seed = 0; seed < 100; ++seed) {
    const World world = filmWorld(seed).world;
    for (const uint flags : {kPairwise, kPairwise | RL_REUSE_CONTROL_VARIATE}) {
      Source still{
          0, real(3.0f),
          mergeOutcomes(world, initialSource(world, 0, 1, real(1.0f)),
                        {initialSource(world, 0, 1, real(2.0f))}, flags & ~RL_REUSE_PAIRWISE)};
      expectUnbiased(world, still.outcomes, seed);
      const Source neighbour = initialSource(world, 1, 2, real(2.0f));
      expectUnbiased(world, mergeOutcomes(world, still, {neighbour}, flags), seed);
    }
  }
}

// Two neighbours exchange samples twice: in the second round the donor partly holds ancestors of
// the canonical sample. Correlated inputs leave the mean unchanged.
EXACT_TEST(SharedAncestors) {
  for (uint seed = 0; seed < 100; ++seed) {
    const World world = randomWorld(seed, true);
    const Source a = initialSource(world, 0, 1, real(1.0f));
    const Source b = initialSource(world, 1, 1, real(2.5f));
    const uint flags = kPairwise | RL_REUSE_CONTROL_VARIATE;
    Outcomes result;
    for (const Outcome& oa : a.outcomes) {
      for (const Outcome& ob : b.outcomes) {
        const MergeInput ia{0, oa.reservoir, a.confidence}, ib{1, ob.reservoir, b.confidence};
        const double p = oa.probability * ob.probability;
        mergeOnce(world, ia, {ib}, flags, [&](double pa, const WorldReservoir& ra, const dvec3&) {
          mergeOnce(world, ib, {ia}, flags, [&](double pb, const WorldReservoir& rb, const dvec3&) {
            mergeOnce(world, {0, ra, ra.state.confidence}, {{1, rb, rb.state.confidence}}, flags,
                      [&](double pc, const WorldReservoir& r, const dvec3& estimate) {
                        result.add(p * pa * pb * pc, r, estimate);
                      });
          });
        });
      }
    }
    expectUnbiased(world, result.list(), seed);
  }
}

// With full supports and unit Jacobians weights by confidence alone are right: the negative tests
// below therefore detect the supports and the Jacobian, not the harness.
EXACT_TEST(ConfidenceWeightsAreExactOnFullSupports) {
  for (uint seed = 0; seed < 20; ++seed) {
    const World world = randomWorld(seed, false);
    for (const uint flags : {0u, 0u | RL_REUSE_CONTROL_VARIATE}) {
      const auto outcomes = mergeOutcomes(
          world, initialSource(world, 0, 1, real(1.0f)),
          {initialSource(world, 1, 1, real(3.0f)), initialSource(world, 2, 1, real(2.0f))}, flags);
      expectUnbiased(world, outcomes, seed);
    }
  }
}

// Counts how often a deliberate mistake is detected: it must move the mean in most worlds.
struct Mistake {
  int seen = 0, worlds = 0;
  double signedSum = 0.0;  // sum of relative errors in luminance

  void add(const World& world, const std::vector<Outcome>& outcomes) {
    const dvec3 truth = world.truth(0);
    const dvec3 value = meanOfEstimate(outcomes);
    if (truth.y <= 0.0) return;
    ++worlds;
    seen += relativeError(value, truth) > kBiasSeen ? 1 : 0;
    signedSum += (value.y - truth.y) / truth.y;
  }
};

Mistake mistakeOf(uint flags, const std::function<void(World&)>& change, bool partial) {
  Mistake mistake;
  for (uint seed = 0; seed < 30; ++seed) {
    World world = randomWorld(seed, partial);
    change(world);
    mistake.add(world, mergeOutcomes(world, initialSource(world, 0, 1, real(1.0f)),
                                     {initialSource(world, 1, 1, real(5.0f)),
                                      initialSource(world, 2, 1, real(5.0f))},
                                     flags));
  }
  return mistake;
}

// Hides label 0 from the donors; everything else stays visible.
void hideFromDonors(World& world) { world.visibility[1][0] = world.visibility[2][0] = real(0.0f); }

EXACT_TEST(NegativeConfidenceWeightsWithOccluders) {
  const Mistake mistake = mistakeOf(0u, hideFromDonors, false);
  EXPECT_EQ(mistake.seen, mistake.worlds);
  EXPECT_LT(mistake.signedSum / mistake.worlds, -0.1);  // edges darken
  EXPECT_EQ(mistakeOf(kPairwise, hideFromDonors, false).seen, 0);
}

EXACT_TEST(NegativeConfidenceWeightsWithPartialShifts) {
  const auto change = [](World& world) {
    for (uint d = 1; d < 3; ++d) world.defined[0][d][1] = world.defined[d][0][1] = false;
  };
  const Mistake mistake = mistakeOf(0u, change, false);
  EXPECT_EQ(mistake.seen, mistake.worlds);
  EXPECT_EQ(mistakeOf(kPairwise, change, false).seen, 0);
}

EXACT_TEST(NegativeOmittedJacobian) {
  const auto omit = [](World& world) { world.omitsJacobian = true; };
  const Mistake pairwise = mistakeOf(kPairwise, omit, false);
  EXPECT_EQ(pairwise.seen, pairwise.worlds);
  const Mistake confidence = mistakeOf(0u, omit, false);
  EXPECT_EQ(confidence.seen, confidence.worlds);
  const auto none = [](World&) {};
  EXPECT_EQ(mistakeOf(kPairwise, none, false).seen, 0);
  // With equal measures the Jacobian is 1: omitting it changes nothing.
  const auto equal = [](World& world) {
    world.omitsJacobian = true;
    for (uint a = 0; a < kAnchors; ++a) {
      for (uint l = 0; l < kLabels; ++l) world.measure[a][l] = world.measure[0][l];
    }
  };
  EXPECT_EQ(mistakeOf(kPairwise, equal, false).seen, 0);
}

EXACT_TEST(NegativeAssumedVisibility) {
  // Donors are assumed to see samples that are hidden from them: their share is missing.
  const Mistake darker = mistakeOf(kPairwise | RL_REUSE_ASSUME_VISIBLE, hideFromDonors, false);
  EXPECT_EQ(darker.seen, darker.worlds);
  EXPECT_LT(darker.signedSum, 0.0);
  // Light leaks through an occluder at the canonical shading point.
  const auto hideHere = [](World& world) { world.visibility[0][2] = real(0.0f); };
  const Mistake leak = mistakeOf(kPairwise | RL_REUSE_ASSUME_VISIBLE_HERE, hideHere, false);
  EXPECT_EQ(leak.seen, leak.worlds);
  EXPECT_GT(leak.signedSum, 0.0);
  EXPECT_EQ(mistakeOf(kPairwise, hideHere, false).seen, 0);
}

// The canonical candidates must cover the support of the canonical target.
EXACT_TEST(NegativeCanonicalMissesItsSupport) {
  const auto change = [](World& world) {
    hideFromDonors(world);
    world.candidate[0][0] = 0.0;
  };
  const Mistake mistake = mistakeOf(kPairwise, change, false);
  EXPECT_EQ(mistake.seen, mistake.worlds);
  EXPECT_LT(mistake.signedSum / mistake.worlds, -0.1);
}

// Confidence that depends on the sample (here: empty donors do not count) is biased.
EXACT_TEST(NegativeEmptyDonorsDropped) {
  int seen = 0, worlds = 0;
  for (uint seed = 0; seed < 30; ++seed) {
    World world = randomWorld(seed, false);
    hideFromDonors(world);
    const Source canonical = initialSource(world, 0, 1, real(1.0f));
    const Source donor = initialSource(world, 1, 1, real(5.0f));
    Outcomes result;
    for (const Outcome& oc : canonical.outcomes) {
      for (const Outcome& od : donor.outcomes) {
        const real confidence = od.reservoir.state.W > real(0.0f) ? donor.confidence : real(0.0f);
        mergeOnce(world, {0, oc.reservoir, canonical.confidence}, {{1, od.reservoir, confidence}},
                  kPairwise, [&](double p, const WorldReservoir& r, const dvec3& estimate) {
                    result.add(oc.probability * od.probability * p, r, estimate);
                  });
      }
    }
    ++worlds;
    seen += relativeError(meanOfEstimate(result.list()), world.truth(0)) > kBiasSeen ? 1 : 0;
  }
  EXPECT_GE(seen, worlds * 8 / 10);
}

// A donor that counts only if its own film sample shows a similar surface here is selected by its
// sample: biased.
EXACT_TEST(NegativeDonorsTestedByTheirFilmSample) {
  int seen = 0, worlds = 0;
  for (uint seed = 0; seed < 60; ++seed) {
    const FilmWorld film = filmWorld(seed);
    // Only worlds in which the donor's sample sometimes counts here and sometimes does not.
    if (!film.usable[1][0] || !film.usable[1][1] || (film.usable[0][0] && film.usable[0][1]))
      continue;
    const Source canonical = initialSource(film.world, 0, 1, real(1.0f));
    const Source donor = initialSource(film.world, 1, 1, real(5.0f));
    Outcomes result;
    for (const Outcome& oc : canonical.outcomes) {
      for (const Outcome& od : donor.outcomes) {
        const bool counts =
            od.reservoir.state.W > real(0.0f) && film.usable[0][filmOf(od.reservoir.label)];
        mergeOnce(film.world, {0, oc.reservoir, canonical.confidence},
                  {{1, od.reservoir, counts ? donor.confidence : real(0.0f)}}, kPairwise,
                  [&](double p, const WorldReservoir& r, const dvec3& estimate) {
                    result.add(oc.probability * od.probability * p, r, estimate);
                  });
      }
    }
    ++worlds;
    seen += relativeError(meanOfEstimate(result.list()), film.world.truth(0)) > kBiasSeen ? 1 : 0;
  }
  EXPECT_GE(worlds, 8);
  EXPECT_EQ(seen, worlds);
}

}  // namespace
}  // namespace rl
