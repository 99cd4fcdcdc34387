// A view without a page: its panes and the reference side by side, as one picture.
#pragma once

#include "experiments/report/figure.h"
#include "experiments/view/live_view.h"

namespace restlab {

struct CaptureOptions {
  uint64_t frames = 1;         // of each pane
  uint64_t referenceSpp = 64;  // at least 2
};

// Throws Error (badUsage) where the picture would be too large.
void requireCaptureSize(const ViewSettings& settings);

// Renders, and lays out A | B | reference with their names above, as bright as a page shows the
// scene at first. Throws Error (interrupted) where a signal has come.
Figure capture(LiveView& view, const CaptureOptions& options);

// The metadata of its PNG: settings that both panes have, those of one as "A.mode", "B.mode".
std::map<std::string, std::string> captureWords(const LiveView& view);

}  // namespace restlab
