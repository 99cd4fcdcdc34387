// What every integrator has to pass: the tests of this folder run over the registry, so an
// integrator that is added is under all of them at once.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/method.h"
#include "tests/bias/independent_runs.h"

namespace restlab::conformance {

// One integrator in one of its modes with one of the caches, or with paths that end in cells of
// radiance, or `path` with a denoiser.
struct Variant {
  std::string integrator;
  std::string mode;
  BiasClass bias = BiasClass::unbiased;  // in a still view
  std::string denoiser = "none";
  std::string cache;  // "" without reservoirs
  bool endsPaths = false;

  // "restir_gi_unbiased", fit for a test's name; with the cache where it is not the first one, and
  // "_secondary" where paths end.
  std::string name() const;
  // The denoiser averages over neighbours.
  bool blurs() const;
};

// All of them, in the registry's order.
std::vector<Variant> allVariants();
// Those whose expectation is the truth in every frame.
std::vector<Variant> unbiasedVariants();

// gtest prints and names parameters by these.
void PrintTo(const Variant& variant, std::ostream* out);
struct VariantName {
  template <class Info>
  std::string operator()(const Info& info) const {
    return info.param.name();
  }
};

// A small session's configuration, one thread, defaults otherwise.
SessionConfig configOf(const Variant& variant, uint32_t width = 48, uint32_t height = 27);

// The same as a method of the bias tests: histories of `frames` frames, the first `skipped` ones
// not compared.
bias::Method methodOf(const Variant& variant, uint32_t frames, uint32_t skipped);

// Frames of a new history: the camera stands for nine of them, in which a history becomes old, and
// walks from then on.
void runFrames(Session& session, const CompiledScene& scene, uint32_t frames);
// The last of them.
Image render(const std::shared_ptr<const CompiledScene>& scene, const SessionConfig& config,
             uint32_t frames);

// Channel values whose bits differ.
size_t countDifferent(const Image& a, const Image& b);

}  // namespace restlab::conformance
