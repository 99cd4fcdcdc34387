// Steps back and forth through what was set in a viewer.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "experiments/view/view_settings.h"

namespace restlab {

class ViewHistory {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr size_t kMostSteps = 200;  // older ones are forgotten
  // A drag goes on for so long after its last change: rounds of frames may take as long.
  static constexpr std::chrono::seconds kPause{2};

  // `before` was set before the change. Changes of one target in a row, with no longer pauses, are
  // one step: a drag is.
  void add(const ViewSettings& before, const std::string& target, const std::string& text,
           Clock::time_point now = Clock::now());

  bool canUndo() const { return !past_.empty(); }
  bool canRedo() const { return !future_.empty(); }
  std::string undoText() const { return canUndo() ? past_.back().text : ""; }
  std::string redoText() const { return canRedo() ? future_.back().text : ""; }

  // What to set, where `now` is set. There is a step.
  const ViewSettings& undone() const { return past_.back().settings; }
  const ViewSettings& redone() const { return future_.back().settings; }
  // The step was gone.
  void undo(const ViewSettings& now) { go(past_, future_, now); }
  void redo(const ViewSettings& now) { go(future_, past_, now); }

 private:
  struct Step {
    ViewSettings settings;  // on its other side
    std::string target, text;
  };
  void go(std::vector<Step>& from, std::vector<Step>& to, const ViewSettings& now);

  std::vector<Step> past_, future_;
  bool isOpen_ = false;  // the last step may grow
  Clock::time_point changed_;
};

}  // namespace restlab
