// Undo and redo of a viewer's settings.
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
  static constexpr size_t kMostSteps = 200;  // older steps are discarded
  // Longest pause within one drag: rounds of frames may take as long.
  static constexpr std::chrono::seconds kPause{2};

  // Adds a step; `before`: settings before the change. Consecutive changes of one target with
  // pauses of at most kPause are one step, such as a drag.
  void add(const ViewSettings& before, const std::string& target, const std::string& text,
           Clock::time_point now = Clock::now());

  bool canUndo() const { return !past_.empty(); }
  bool canRedo() const { return !future_.empty(); }
  std::string undoText() const { return canUndo() ? past_.back().text : ""; }
  std::string redoText() const { return canRedo() ? future_.back().text : ""; }

  // Settings to restore. Requires canUndo() or canRedo().
  const ViewSettings& undone() const { return past_.back().settings; }
  const ViewSettings& redone() const { return future_.back().settings; }
  // Moves the step to the other list, after its settings were restored; `now`: settings before
  // that.
  void undo(const ViewSettings& now) { go(past_, future_, now); }
  void redo(const ViewSettings& now) { go(future_, past_, now); }

 private:
  struct Step {
    ViewSettings settings;  // settings on the other side of the step
    std::string target, text;
  };
  void go(std::vector<Step>& from, std::vector<Step>& to, const ViewSettings& now);

  std::vector<Step> past_, future_;
  bool isOpen_ = false;  // the last step may be extended
  Clock::time_point changed_;
};

}  // namespace restlab
