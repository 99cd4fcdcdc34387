// Variants of all registered integrators: the tests of this folder run over the registry and cover
// a new integrator at once.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/frame/method.h"
#include "tests/bias/independent_runs.h"

namespace restlab::conformance {

// One integrator in one mode with one cache, or with paths that end in cells of radiance, or `path`
// with a denoiser.
struct Variant {
  std::string integrator;
  std::string mode;
  BiasClass bias = BiasClass::unbiased;  // bias in a still view
  std::string denoiser = "none";
  std::string cache;  // "": no reservoirs
  bool endsPaths = false;

  // Returns a test name such as "restir_gi_unbiased"; with the cache if it is not the first one,
  // and "_secondary" if paths end in cells.
  std::string name() const;
  // True if the denoiser averages over neighbours.
  bool blurs() const;
  // True if the integrator leaves out light: its mean is no truth, and it follows no long paths.
  bool leavesLightOut() const;
};

// Returns all variants in the registry's order.
std::vector<Variant> allVariants();
// Returns the variants whose expectation is the truth in every frame.
std::vector<Variant> unbiasedVariants();

// Splits variants for the dearer tests: by day every kernel runs in one of them, the others wait
// for the night.
std::vector<Variant> byDay(std::vector<Variant> all);
std::vector<Variant> byNight(std::vector<Variant> all);

// Splits variants for tests of the mean over many runs, the dearest of all.
std::vector<Variant> meansByDay(std::vector<Variant> all);
std::vector<Variant> meansByNight(std::vector<Variant> all);

// Used by gtest to print and name parameters.
void PrintTo(const Variant& variant, std::ostream* out);
struct VariantName {
  template <class Info>
  std::string operator()(const Info& info) const {
    return info.param.name();
  }
};

// Returns a small session's configuration: one thread, defaults otherwise.
SessionConfig configOf(const Variant& variant, uint32_t width = 48, uint32_t height = 27);

// Returns the variant as a method of the bias tests: histories of `frames` frames, of which the
// first `skipped` are not compared.
bias::Method methodOf(const Variant& variant, uint32_t frames, uint32_t skipped);

// Renders frames of a new history. The camera stands still for nine frames, in which the history
// becomes old, and moves from then on.
void runFrames(Session& session, const CompiledScene& scene, uint32_t frames);
// Returns the last of these frames.
Image render(const std::shared_ptr<const CompiledScene>& scene, const SessionConfig& config,
             uint32_t frames);

// Channel values whose bits differ.
size_t countDifferent(const Image& a, const Image& b);

}  // namespace restlab::conformance
