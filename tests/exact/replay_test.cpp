// Paths that are replayed and reconnected (restir_pt), by enumeration, on the shipped merges in
// double precision: exact to 1e-12.
//
// A small scene of rough and smooth vertices. Each of three scattering events consumes one of two
// random numbers, which chooses the next vertex; paths end at a light that their third or fourth
// vertex is. A sample is what a reservoir of restir_pt holds: the random numbers of a prefix, and
// the vertices from the reconnection on; or random numbers alone where no pair of vertices
// connects. Its integrand leaves out the density of the directions that reconnect, so that J = 1.
#define RL_REAL_DOUBLE
#define EXACT_LABELS 96
#include <algorithm>
#include <optional>
#include <tuple>

#include "tests/exact/world.inl"

namespace rl {
namespace {

constexpr uint kVertices = 6, kPixels = 3, kNumbers = 2, kEvents = 3;
constexpr double kTolerance = 1e-12;
constexpr double kBiasSeen = 5e-3;  // relative error that a wrong rule must exceed

enum class Shift { reconnection, replay, hybrid };
// Rules of the shift; each but `right` is a deliberate mistake.
enum class Rule { right, notInvertible, pairOfSourceAlone };

struct Scene {
  uint first[kPixels];                                     // x1
  uint next[kVertices + kPixels][kVertices][kNumbers];     // by the vertex before, and the vertex
  double bsdf[kVertices + kPixels][kVertices][kVertices];  // 0 where no number leads
  double transmittance[kVertices][kVertices];
  real3 emission[kVertices];
  bool isRough[kVertices];
  bool isWide[kPixels][kVertices][kVertices];  // footprint, as the pixel has it
};

Scene randomScene(uint seed, bool hasFootprint) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  const auto below = [&](uint n) { return uint(random() % n); };
  Scene s{};
  for (uint a = 0; a < kPixels; ++a) s.first[a] = below(kVertices);
  for (uint u = 0; u < kVertices + kPixels; ++u) {
    for (uint v = 0; v < kVertices; ++v) {
      for (uint i = 0; i < kNumbers; ++i) {
        s.next[u][v][i] = below(kVertices);
        s.bsdf[u][v][s.next[u][v][i]] = below(5) == 0 ? 0.0 : uniform(random);
      }
    }
  }
  for (uint v = 0; v < kVertices; ++v) {
    s.isRough[v] = below(3) != 0;
    if (below(3) != 0)
      s.emission[v] = real3(uniform(random), uniform(random), 4.0 * uniform(random));
    for (uint w = 0; w < kVertices; ++w) {
      s.transmittance[v][w] = below(5) == 0 ? 0.0 : 1.0;
      for (uint a = 0; a < kPixels; ++a) s.isWide[a][v][w] = !hasFootprint || below(3) != 0;
    }
  }
  return s;
}

// Sample of a reservoir. `k`: index of the reconnection vertex; 0: none. `end`: of the light.
struct Sample {
  uint k = 0, end = 0;
  std::vector<uint> numbers;   // of the prefix, or of the whole path
  std::vector<uint> vertices;  // x_k .. x_end
  bool operator<(const Sample& o) const {
    return std::tie(k, end, numbers, vertices) < std::tie(o.k, o.end, o.numbers, o.vertices);
  }
};

struct Model {
  Scene scene;
  Shift shift = Shift::hybrid;

  double pdf(uint before, uint v, uint to) const {
    double count = 0.0;
    for (const uint next : scene.next[before][v]) count += next == to ? 1.0 : 0.0;
    return count / kNumbers;
  }
  bool connects(uint pixel, uint u, uint v) const {
    return shift != Shift::replay && scene.isRough[u] && scene.isRough[v] &&
           scene.isWide[pixel][u][v];
  }
  // First reconnection vertex of the vertices x1, x2, ... up to x_end; 0: none.
  uint reconnectionOf(uint pixel, const std::vector<uint>& x, uint end) const {
    for (uint k = 2; k <= end; ++k)
      if (connects(pixel, x[k - 2], x[k - 1])) return k;
    return 0;
  }
  // Vertices that random numbers give from a pixel.
  std::vector<uint> trace(uint pixel, const std::vector<uint>& numbers) const {
    std::vector<uint> x = {scene.first[pixel]};
    uint before = kVertices + pixel;
    for (const uint number : numbers) {
      const uint next = scene.next[before][x.back()][number];
      before = x.back();
      x.push_back(next);
    }
    return x;
  }
  // Whether `reconnection` leaves a path to the other part of the estimate, which is not resampled.
  bool isLeftOut(uint k) const { return shift == Shift::reconnection && k != 2; }

  // Integrand of a sample at a pixel; nothing where it is not in the domain.
  std::optional<real3> integrand(uint pixel, const Sample& s, Rule rule,
                                 double& transmittance) const {
    std::vector<uint> x = trace(pixel, s.numbers);
    const uint replayed = uint(x.size());
    const uint most = s.k == 0 ? s.end : s.k - 1;
    transmittance = 1.0;
    if (rule != Rule::notInvertible && reconnectionOf(pixel, x, most) != 0) return std::nullopt;
    x.insert(x.end(), s.vertices.begin(), s.vertices.end());
    if (s.k != 0 && rule != Rule::pairOfSourceAlone && !connects(pixel, x[s.k - 2], x[s.k - 1]))
      return std::nullopt;
    double f = 1.0;
    uint before = kVertices + pixel;
    for (uint j = 1; j < s.end; ++j) {
      const uint from = x[j - 1], to = x[j];
      f *= scene.bsdf[before][from][to];
      if (j + 1 == s.k) {
        transmittance *= scene.transmittance[from][to];
      } else {
        f *= scene.transmittance[from][to];
      }
      // Replayed directions are over their density.
      if (j < replayed) f /= pdf(before, from, to);
      before = from;
    }
    return scene.emission[x[s.end - 1]] * real(f);
  }

  // Light of a pixel that is resampled, from all paths and not from samples.
  dvec3 truth(uint pixel) const {
    dvec3 sum(0.0);
    std::function<void(std::vector<uint>&, uint, double)> go = [&](std::vector<uint>& x,
                                                                   uint before, double f) {
      const uint length = uint(x.size());
      if (length >= 3 && !isLeftOut(reconnectionOf(pixel, x, length)))
        sum += f * dvec3(scene.emission[x.back()]);
      if (length == kEvents + 1) return;
      const uint from = x.back();
      for (uint to = 0; to < kVertices; ++to) {
        x.push_back(to);
        go(x, from, f * scene.bsdf[before][from][to] * scene.transmittance[from][to]);
        x.pop_back();
      }
    };
    std::vector<uint> x = {scene.first[pixel]};
    go(x, kVertices + pixel, 1.0);
    return sum;
  }
};

// A candidate: a sample that a pixel's path gives, and its unbiased contribution weight.
struct Candidate {
  Sample sample;
  double W = 1.0;
};

std::vector<Candidate> candidatesOf(const Model& m, uint pixel, const std::vector<uint>& numbers) {
  std::vector<Candidate> all;
  const std::vector<uint> x = m.trace(pixel, numbers);
  for (const uint end : {3u, 4u}) {
    Candidate c;
    c.sample.end = end;
    c.sample.k = m.reconnectionOf(pixel, x, end);
    if (m.isLeftOut(c.sample.k)) continue;
    const uint prefix = c.sample.k == 0 ? end - 1 : c.sample.k - 2;
    c.sample.numbers.assign(numbers.begin(), numbers.begin() + prefix);
    if (c.sample.k != 0) c.sample.vertices.assign(x.begin() + c.sample.k - 1, x.begin() + end);
    for (uint j = prefix + 1; j < end; ++j)
      c.W /= m.pdf(j == 1 ? kVertices + pixel : x[j - 2], x[j - 1], x[j]);
    all.push_back(c);
  }
  return all;
}

// Calls use(numbers) for every sequence of random numbers; all have the same probability.
template <class F>
void forEachSequence(F use) {
  for (uint code = 0; code < (1u << kEvents); ++code) {
    std::vector<uint> numbers;
    for (uint j = 0; j < kEvents; ++j) numbers.push_back((code >> j) & 1u);
    use(numbers);
  }
}
constexpr double kSequence = 1.0 / double(1u << kEvents);

// The samples of all pixels as labels of a world.
World worldOf(const Model& m, Rule rule, std::map<Sample, uint>& labels) {
  World w{};
  for (uint a = 0; a < kPixels; ++a) {
    forEachSequence([&](const std::vector<uint>& numbers) {
      for (const Candidate& c : candidatesOf(m, a, numbers))
        labels.emplace(c.sample, uint(labels.size()));
    });
  }
  EXPECT_LE(labels.size(), size_t{kLabels});
  for (const auto& [sample, label] : labels) {
    for (uint a = 0; a < kPixels; ++a) {
      double transmittance;
      const auto f = m.integrand(a, sample, rule, transmittance);
      w.f[a][label] = f.value_or(real3(real(0.0f)));
      w.visibility[a][label] = real(transmittance);
      w.measure[a][label] = real(1.0f);
      for (uint b = 0; b < kPixels; ++b) w.defined[b][a][label] = f.has_value();
    }
  }
  for (uint a = 0; a < kPixels; ++a) {
    for (uint b = 0; b < kPixels; ++b) w.ratio[a][b] = real3(real(0.7f), real(1.3f), real(2.0f));
  }
  return w;
}

std::vector<Outcome> replayOutcomes(const Model& m, const World& w,
                                    const std::map<Sample, uint>& labels, uint pixel) {
  Outcomes outcomes;
  Kernel kernel;
  kernel.world = &w;
  forEachSequence([&](const std::vector<uint>& numbers) {
    const std::vector<Candidate> candidates = candidatesOf(m, pixel, numbers);
    restlab::exact::enumerate([&](Decisions& decisions) {
      kernel.decisions = &decisions;
      WorldReservoir selected;
      selected.state.confidence = real(1.0f);
      real wSum = real(0.0f);
      for (const Candidate& c : candidates) {
        const uint label = labels.at(c.sample);
        const real3 F = w.f[pixel][label] * w.visibility[pixel][label];
        if (!kernel.risAccept(wSum, kernel.reuseTarget(F) * real(c.W), real(0.0f))) continue;
        selected.label = label;
        selected.state.F = F;
      }
      selected.state.W = kernel.risContributionWeight(wSum, kernel.reuseTarget(selected.state.F));
      outcomes.add(kSequence * decisions.probability(), selected,
                   dvec3(selected.state.F) * double(selected.state.W));
    });
  });
  return outcomes.list();
}

double relativeError(const dvec3& value, const dvec3& truth) {
  const dvec3 d = abs(value - truth) / std::max({truth.x, truth.y, truth.z, 0.1});
  return std::max({d.x, d.y, d.z});
}

// Largest relative error of a pixel's estimate over some scenes, after a merge with the pixels
// beside it, of confidences `own` and `others`, under a cap.
double errorOf(Shift shift, bool hasFootprint, uint flags, Rule rule, double own = 2.0,
               double others = 5.0, double cap = 3.0) {
  double worst = 0.0;
  for (uint seed = 0; seed < 40; ++seed) {
    const Model m{randomScene(seed, hasFootprint), shift};
    std::map<Sample, uint> labels;
    // Pixels find what the right rule says; a mistake is one of shifts.
    const World right = worldOf(m, Rule::right, labels);
    World w = right;
    if (rule != Rule::right) {
      std::map<Sample, uint> same = labels;
      const World wrong = worldOf(m, rule, same);
      for (uint l = 0; l < kLabels; ++l) {
        for (uint a = 0; a < kPixels; ++a) {
          // The own samples of a pixel stay right.
          const bool isOwn = right.defined[a][a][l];
          if (!isOwn) w.f[a][l] = wrong.f[a][l];
          if (!isOwn) w.visibility[a][l] = wrong.visibility[a][l];
          for (uint b = 0; b < kPixels; ++b) w.defined[b][a][l] = wrong.defined[b][a][l];
        }
      }
    }
    Source sources[kPixels];
    for (uint a = 0; a < kPixels; ++a)
      sources[a] = {a, real(a == 0 ? own : others), replayOutcomes(m, w, labels, a)};
    const dvec3 truth = m.truth(0);
    if (rule == Rule::right) {
      // The samples' domain is all of the light, and each pixel's own estimate is right.
      EXPECT_LE(relativeError(meanOfSample(sources[0].outcomes), truth), kTolerance) << seed;
    }
    const auto merged = mergeOutcomes(w, sources[0], {sources[1], sources[2]}, flags, real(cap));
    worst = std::max({worst, relativeError(meanOfSample(merged), truth),
                      relativeError(meanOfEstimate(merged), truth)});
  }
  return worst;
}

constexpr uint kPairwise = RL_REUSE_PAIRWISE, kDefensive = kPairwise | RL_REUSE_DEFENSIVE;

TEST(ExactReplay, EveryShiftCriterionAndWeightIsUnbiased) {
  for (const Shift shift : {Shift::reconnection, Shift::replay, Shift::hybrid}) {
    for (const bool hasFootprint : {false, true}) {
      for (const uint flags : {kPairwise, kDefensive, kPairwise | RL_REUSE_CONTROL_VARIATE}) {
        EXPECT_LE(errorOf(shift, hasFootprint, flags, Rule::right), kTolerance)
            << int(shift) << hasFootprint << flags;
      }
    }
  }
}

TEST(ExactReplay, EmptyInputsAreUnbiased) {
  for (const uint flags : {kPairwise, kDefensive}) {
    EXPECT_LE(errorOf(Shift::hybrid, true, flags, Rule::right, 1.0, 0.0), kTolerance);
    EXPECT_LE(errorOf(Shift::hybrid, true, flags, Rule::right, 1.0, 1.0, 1e9), kTolerance);
  }
}

// Each mistake is seen, so that the tests above can fail.
TEST(ExactReplay, WrongRulesAreBiased) {
  for (const Rule rule : {Rule::notInvertible, Rule::pairOfSourceAlone})
    EXPECT_GT(errorOf(Shift::hybrid, true, kPairwise, rule), kBiasSeen) << int(rule);
  EXPECT_GT(errorOf(Shift::hybrid, true, 0u, Rule::right), kBiasSeen) << "confidence alone";
}

}  // namespace
}  // namespace rl
