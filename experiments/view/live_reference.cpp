#include "experiments/view/live_reference.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace restlab {

LiveReference::~LiveReference() { keep(); }

void LiveReference::begin(const PreparedScene& prepared, const ReferenceConfig& config) {
  keep();
  halves_.reset();
  prepared_ = &prepared;
  config_ = config;
  state_ = {};
  pictures_ = {};
  sampleMs_ = 0.0;
  progress_.reset();
  if (cameraInsteadOf(prepared, config) != nullptr) return;
  state_.id = {referenceKey(prepared, config), config.seed, config.backend};
  progress_.emplace(store_, state_.id);
  if (std::optional<ReferenceState> kept = progress_->load()) state_ = std::move(*kept);
}

bool LiveReference::addSample(const std::function<bool()>& isStopped) {
  if (!halves_) {
    state_.id.seed = config_.seed;
    halves_.emplace(*prepared_, config_, state_);
  }
  const auto start = std::chrono::steady_clock::now();
  if (!halves_->addSample(isStopped)) return false;
  sampleMs_ =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (progress_) progress_->update(state_);
  return true;
}

bool LiveReference::takeKept() {
  if (!progress_) return false;
  std::optional<ReferenceState> kept = progress_->load();
  if (!kept || kept->spp() <= state_.spp()) return false;
  state_ = std::move(*kept);
  halves_.reset();  // the next sample begins behind them
  pictures_ = {};
  return true;
}

void LiveReference::show(const Reference& reference) {
  pictures_ = {std::max<uint64_t>(1, reference.spp), reference.mean,
               reference.half0.value_or(reference.mean), reference.half1.value_or(reference.mean),
               reference.relmse};
  isGiven_ = true;
}

const LiveReference::Pictures& LiveReference::pictures() const {
  if (pictures_.spp == spp()) return pictures_;
  pictures_ = {spp(), BlockSum::meanOfBoth(state_.half0, state_.half1), state_.half0.mean(),
               state_.half1.mean(), estimateRelmse(state_.half0, state_.half1)};
  return pictures_;
}

void LiveReference::keep() {
  if (progress_ && halves_ && hasImage()) progress_->save(state_);
}

}  // namespace restlab
