// Exhaustive enumeration: runs a program with random yes/no decisions once for every sequence of
// outcomes, with the probability of each run.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace restlab::exact {

class Decisions {
 public:
  // Decides an event of probability p: "yes" first, "no" in a later run. Impossible outcomes are
  // never taken.
  bool decide(double p) {
    if (!(p >= 0.0 && p <= 1.0)) throw std::logic_error("a probability outside [0, 1]");
    if (next_ == choices_.size()) choices_.push_back(Choice{p > 0.0, p < 1.0 && p > 0.0});
    const Choice choice = choices_[next_++];
    probability_ *= choice.yes ? p : 1.0 - p;
    return choice.yes;
  }

  double probability() const { return probability_; }  // probability of this run

  // Advances to the next sequence; returns false after the last one.
  bool advance() {
    while (!choices_.empty() && !choices_.back().noIsLeft) choices_.pop_back();
    if (choices_.empty()) return false;
    choices_.back() = Choice{false, false};
    next_ = 0;
    probability_ = 1.0;
    return true;
  }

 private:
  struct Choice {
    bool yes;
    bool noIsLeft;
  };
  std::vector<Choice> choices_;
  size_t next_ = 0;
  double probability_ = 1.0;
};

// Calls run(decisions) for every sequence of outcomes. The probabilities must sum to 1.
template <class F>
void enumerate(F run) {
  Decisions decisions;
  double total = 0.0;
  do {
    run(decisions);
    total += decisions.probability();
  } while (decisions.advance());
  if (!(total > 1.0 - 1e-9 && total < 1.0 + 1e-9)) {
    throw std::logic_error("probabilities do not sum to 1");
  }
}

}  // namespace restlab::exact
