#include "experiments/view/live_reference.h"

#include <utility>

namespace restlab {

LiveReference::~LiveReference() { keep(); }

void LiveReference::begin(const PreparedScene& prepared, const ReferenceConfig& config) {
  keep();
  halves_.reset();
  prepared_ = &prepared;
  config_ = config;
  state_ = {};
  progress_.reset();
  if (cameraInsteadOf(prepared, config) != nullptr) return;
  state_.id = {referenceKey(prepared, config), config.seed, config.backend};
  progress_.emplace(store_, state_.id);
  if (std::optional<ReferenceState> kept = progress_->load()) state_ = std::move(*kept);
}

void LiveReference::addSample() {
  if (!halves_) {
    state_.id.seed = config_.seed;
    halves_.emplace(*prepared_, config_, state_);
  }
  halves_->addSample();
  if (progress_) progress_->update(state_);
}

void LiveReference::keep() {
  if (progress_ && halves_ && isThere()) progress_->save(state_);
}

}  // namespace restlab
