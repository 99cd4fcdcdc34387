// All combinations of MIS weights, shown estimate, confidence cap, empty inputs and supports, each
// in a few random worlds, by enumeration: no sampling, no statistics. Included once per meaning of
// `real`, with EXACT_SUITE and kTolerance defined before.
//
// Expected value, for inputs i with share c_i / c of the confidence and support S_i (the labels
// that the input can hold and that a shift leads here):
//   unbiased weights      sum over l of F_l
//   confidence alone      sum over l of F_l (sum over i with l in S_i of c_i / c)
// The second formula gives the known loss of 1/M weights as an exact number.
#include <algorithm>
#include <cstdio>

#include "tests/exact/mis_values.h"
#include "tests/exact/world.inl"

namespace rl {
namespace {

constexpr uint kInputs = 3;  // shading point 0, the canonical input, and its donors 1 and 2
constexpr uint kWorlds = 20;

struct Named {
  const char* name;
  uint value;
};

constexpr Named kShown[] = {{"winner", RL_REUSE_WINNER_ONLY},
                            {"decoupled", 0u},
                            {"control_variate", RL_REUSE_CONTROL_VARIATE}};

enum Cap : uint { capNone, capBinds };
constexpr Named kCaps[] = {{"none", capNone}, {"binds", capBinds}};

// Choice of the empty inputs. `emptyByChance`: each input now and then, so that all eight
// combinations occur; with all other values an input is always empty or never. (If the canonical
// input is always empty its target is zero, and so is the truth: candidates must cover the target's
// support.)
enum Empty : uint {
  emptyNone,
  emptyOneDonor,
  emptyDonors,
  emptyCanonical,
  emptyAll,
  emptyByChance
};
constexpr Named kEmpty[] = {{"none", emptyNone},         {"one donor", emptyOneDonor},
                            {"all donors", emptyDonors}, {"canonical", emptyCanonical},
                            {"all", emptyAll},           {"each by chance", emptyByChance}};

// How the supports differ: the target of one input is zero where another's is not, because of the
// integrand, an occluder, or no shift between canonical input and donor.
enum Support : uint {
  supportFull,
  supportPartOfIntegrand,
  supportPartOfView,
  supportPartOfShift,
  supportDisjointIntegrand,
  supportDisjointView,
  supportDisjointShift
};
constexpr Named kSupports[] = {{"the same", supportFull},
                               {"overlapping, integrand", supportPartOfIntegrand},
                               {"overlapping, occluder", supportPartOfView},
                               {"overlapping, shift", supportPartOfShift},
                               {"disjoint, integrand", supportDisjointIntegrand},
                               {"disjoint, occluder", supportDisjointView},
                               {"disjoint, shift", supportDisjointShift}};

// Labels of each input. A shift is undefined if the donor's list or the canonical one lacks the
// label.
constexpr bool kOverlapping[kInputs][kLabels] = {
    {true, true, true, false}, {false, true, true, true}, {true, false, false, true}};
constexpr bool kDisjoint[kInputs][kLabels] = {
    {true, true, false, false}, {false, false, true, false}, {false, false, false, true}};

bool isEmptied(uint empty, uint shadingPoint) {
  if (empty == emptyAll) return true;
  if (empty == emptyCanonical) return shadingPoint == 0;
  if (empty == emptyDonors) return shadingPoint > 0;
  return empty == emptyOneDonor && shadingPoint == 1;
}

void restrictSupports(World& w, uint support) {
  if (support == supportFull) return;
  const auto& labels = support < supportDisjointIntegrand ? kOverlapping : kDisjoint;
  for (uint a = 0; a < kInputs; ++a) {
    for (uint l = 0; l < kLabels; ++l) {
      if (labels[a][l]) continue;
      if (support == supportPartOfIntegrand || support == supportDisjointIntegrand)
        w.f[a][l] = real3(real(0.0f));
      if (support == supportPartOfView || support == supportDisjointView)
        w.visibility[a][l] = real(0.0f);
    }
  }
  if (support != supportPartOfShift && support != supportDisjointShift) return;
  for (uint d = 1; d < kInputs; ++d) {
    for (uint l = 0; l < kLabels; ++l)
      w.defined[0][d][l] = w.defined[d][0][l] = labels[0][l] && labels[d][l];
  }
}

bool isLit(const World& w, uint shadingPoint, uint label) {
  return w.f[shadingPoint][label].x > real(0.0f) && w.visibility[shadingPoint][label] > real(0.0f);
}

// Restricts candidates to the support of each input; with emptyByChance they also cover labels
// outside and may fail.
void chooseCandidates(World& w, uint empty) {
  const bool byChance = empty == emptyByChance;
  for (uint a = 0; a < kInputs; ++a) {
    double sum = 0.0;
    for (uint l = 0; l < kLabels; ++l) {
      if (!byChance && !isLit(w, a, l)) w.candidate[a][l] = 0.0;
      sum += w.candidate[a][l];
    }
    for (uint l = 0; l < kLabels; ++l)
      w.candidate[a][l] = sum > 0.0 ? w.candidate[a][l] / sum * (byChance ? 0.7 : 1.0) : 0.0;
  }
}

World combinedWorld(uint seed, uint empty, uint support) {
  World w = randomWorld(100 + seed, false);
  restrictSupports(w, support);
  for (uint a = 0; a < kInputs; ++a) {
    if (!isEmptied(empty, a)) continue;
    for (uint l = 0; l < kLabels; ++l) w.f[a][l] = real3(real(0.0f));
  }
  chooseCandidates(w, empty);
  return w;
}

// Gives an input a residual that depends on its sample and has mean 0, as histories do.
Source withResidual(uint shadingPoint, real confidence, std::vector<Outcome> outcomes, uint seed) {
  std::mt19937 random(300 + 10 * seed + shadingPoint);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  dvec3 mean(0.0);
  std::vector<dvec3> residuals;
  for (const Outcome& o : outcomes) {
    residuals.push_back({uniform(random), uniform(random), uniform(random)});
    mean += o.probability * residuals.back();
  }
  for (size_t i = 0; i < outcomes.size(); ++i)
    outcomes[i].reservoir.state.residual = real3(residuals[i] - mean);
  return {shadingPoint, confidence, std::move(outcomes)};
}

// Returns the sum of F over labels, each weighted by how often the weights count it.
dvec3 expectedOf(const World& w, const MisValue& mis, const real (&c)[kInputs]) {
  const double total = double(c[0] + c[1] + c[2]);
  dvec3 sum(0.0);
  for (uint l = 0; l < kLabels; ++l) {
    double share = double(c[0]) / total;
    for (uint d = 1; d < kInputs; ++d) {
      if (isLit(w, d, l) && w.defined[d][0][l]) share += double(c[d]) / total;
    }
    sum += dvec3(w.f[0][l]) * double(w.visibility[0][l]) * double(w.measure[0][l]) *
           (mis.isUnbiased ? 1.0 : share);
  }
  return sum;
}

double largest(const dvec3& v) { return std::max({v.x, v.y, v.z}); }

double distance(const dvec3& value, const dvec3& truth) {
  // Compare a truth of 0 with the size of single samples.
  return largest(abs(value - truth)) / std::max(largest(truth), 0.1);
}

// Returns which inputs were empty together in any outcome, as a set of patterns: bit a of a pattern
// is set if input a is empty.
uint emptyPatterns(const std::vector<Source>& sources) {
  uint patterns = 1u;  // bit p is set if pattern p occurs
  for (size_t i = 0; i < sources.size(); ++i) {
    bool some = false, none = false;
    for (const Outcome& o : sources[i].outcomes) {
      // Ignore the rounding residue of 1 minus all labels' probabilities.
      if (o.probability > 1e-12) (o.reservoir.state.W > real(0.0f) ? some : none) = true;
    }
    uint next = 0u;
    for (uint p = 0; p < 8u; ++p) {
      if ((patterns >> p & 1u) == 0u) continue;
      if (some) next |= 1u << p;
      if (none) next |= 1u << (p | 1u << i);
    }
    patterns = next;
  }
  return patterns;
}

uint wantedPatterns(uint empty) {
  switch (empty) {
    case emptyNone:
      return 1u << 0u;
    case emptyOneDonor:
      return 1u << 2u;
    case emptyDonors:
      return 1u << 6u;
    case emptyCanonical:
      return 1u << 1u;
    case emptyAll:
      return 1u << 7u;
    default:
      return 0xffu;
  }
}

struct Combination {
  const MisValue& mis;
  const Named &shown, &cap, &empty, &support;
  std::string text() const {
    return std::string(mis.name) + ", " + shown.name + ", cap " + cap.name + ", empty " +
           empty.name + ", supports " + support.name;
  }
};

// Checks one combination in one world. Returns true if the expected value is biased, which weights
// by confidence alone must be if an input lacks something.
bool expectOf(const Combination& c, uint seed) {
  const World world = combinedWorld(seed, c.empty.value, c.support.value);
  const real own[kInputs] = {real(1.0f), real(9.0f), real(0.75f)};
  const real cap = c.cap.value == capBinds ? real(2.5f) : std::numeric_limits<real>::infinity();
  real entering[kInputs];
  std::vector<Source> sources;
  for (uint a = 0; a < kInputs; ++a) {
    entering[a] = a == 0 ? own[a] : std::min(own[a], cap);
    sources.push_back(withResidual(a, own[a], initialOutcomes(world, a, 1, own[a]), seed));
  }
  EXPECT_EQ(emptyPatterns(sources), wantedPatterns(c.empty.value)) << c.text();
  const auto outcomes =
      mergeOutcomes(world, sources[0], {sources[1], sources[2]}, c.mis.flags | c.shown.value, cap);
  const dvec3 expected = expectedOf(world, c.mis, entering);
  const auto expectMean = [&](const dvec3& mean, const char* what) {
    EXPECT_LE(distance(mean, expected), kTolerance)
        << what << ", world " << seed << ": " << c.text() << ": (" << mean.x << ", " << mean.y
        << ", " << mean.z << ") instead of (" << expected.x << ", " << expected.y << ", "
        << expected.z << ")";
  };
  expectMean(meanOfSample(outcomes), "E[F W]");
  expectMean(meanOfEstimate(outcomes), "E[estimate]");
  expectMean(meanOfResidual(outcomes) + expected, "E[residual] + truth");
  const double total = double(entering[0] + entering[1] + entering[2]);
  for (const Outcome& o : outcomes) {
    EXPECT_NEAR(double(o.reservoir.state.confidence) / total, 1.0, 1e-6) << c.text();
    EXPECT_GE(o.reservoir.state.W, real(0.0f)) << c.text();
  }
  return distance(expected, world.truth(0)) > 1e-2;
}

TEST(EXACT_SUITE, EveryCombination) {
  uint combinations = 0, biased = 0, mayBeBiased = 0;
  for (const MisValue& mis : kMisValues) {
    for (const Named& shown : kShown) {
      for (const Named& cap : kCaps) {
        for (const Named& empty : kEmpty) {
          for (const Named& support : kSupports) {
            const Combination c{mis, shown, cap, empty, support};
            bool isBiased = false;
            for (uint seed = 0; seed < kWorlds; ++seed) isBiased = expectOf(c, seed) || isBiased;
            ++combinations;
            // An always empty canonical input has nothing to lose.
            const bool hasLight = !isEmptied(empty.value, 0);
            const bool isLacking = support.value != supportFull || isEmptied(empty.value, 1);
            const bool expected = !mis.isUnbiased && hasLight && isLacking;
            EXPECT_EQ(isBiased, expected) << c.text();
            biased += isBiased ? 1 : 0;
            mayBeBiased += expected ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_EQ(combinations, 3u * 3u * 2u * 6u * 7u);
  std::printf(
      "%u combinations (3 MIS weights x 3 ways of showing x 2 caps x 6 kinds of empty inputs x 7 "
      "kinds of supports), %u worlds each: %u unbiased, %u with the known bias of weights by "
      "confidence\n",
      combinations, kWorlds, combinations - biased, biased);
  EXPECT_EQ(biased, mayBeBiased);
}

}  // namespace
}  // namespace rl
