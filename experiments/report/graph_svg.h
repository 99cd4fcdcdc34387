// Draws the passes of a frame and the buffers between them.
#pragma once

#include <string>
#include <vector>

namespace restlab {

struct GraphDrawing {
  enum class Use { none, read, written, both };
  struct Pass {
    std::string name;
    std::string note;             // beside the name: its rays
    bool runsInStillView = true;  // false: drawn with a dashed frame
    std::vector<Use> uses;        // by buffer
  };
  struct DrawnBuffer {
    std::string name;
    std::string note;  // beside the name: its size
    bool isFromLastFrame = false, isForNextFrame = false;
  };
  std::string title;
  std::string footnote;
  std::vector<Pass> passes;
  std::vector<DrawnBuffer> buffers;
};

// Returns an SVG image: a row per pass, from top to bottom as the frame runs, and a lane per buffer
// over the passes in which it holds something.
std::string graphSvg(const GraphDrawing& graph);

}  // namespace restlab
