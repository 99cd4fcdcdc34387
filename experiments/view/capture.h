// Renders a view without a page and lays out its panes and the reference side by side, as one
// picture.
#pragma once

#include "experiments/report/figure.h"
#include "experiments/view/live_view.h"

namespace restlab {

struct CaptureOptions {
  uint64_t frames = 1;         // per pane
  uint64_t referenceSpp = 64;  // at least 2
};

// Throws Error (badUsage) if the picture would be too large.
void requireCaptureSize(const ViewSettings& settings);

// Renders and lays out A | B | reference with their names above, at the exposure with which a page
// opens the scene. Throws Error (interrupted) on a signal.
Figure capture(LiveView& view, const CaptureOptions& options);

// Returns the metadata of the PNG. A setting that both panes share has its plain key, any other is
// written as "A.mode", "B.mode".
std::map<std::string, std::string> captureWords(const LiveView& view);

}  // namespace restlab
