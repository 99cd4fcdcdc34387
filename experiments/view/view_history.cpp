#include "experiments/view/view_history.h"

#include <utility>

namespace restlab {

void ViewHistory::add(const ViewSettings& before, const std::string& target,
                      const std::string& text, Clock::time_point now) {
  future_.clear();
  const bool isInTime = now - std::exchange(changed_, now) <= kPause;
  if (isInTime && isOpen_ && !target.empty() && !past_.empty() && past_.back().target == target) {
    past_.back().text = text;
    return;
  }
  past_.push_back({before, target, text});
  if (past_.size() > kMostSteps) past_.erase(past_.begin());
  isOpen_ = true;
}

void ViewHistory::go(std::vector<Step>& from, std::vector<Step>& to, const ViewSettings& now) {
  Step step = std::move(from.back());
  from.pop_back();
  step.settings = now;
  to.push_back(std::move(step));
  isOpen_ = false;
}

}  // namespace restlab
