// What the viewer says to pages: one JSON object a message, {"say": NAME, ...}.
//
//   hello    the scene and what there is to choose from; the first message
//   state    what is set, after each change and after hello
//   numbers  of the last frames: errors, times, rays, health
//   probe    what a pane keeps of a pixel
//   error    why a command was refused
//   said     a notice
//   saved    what is set, as a suite
//   measure  how far the run of a saved session is: running, finished, failed or cancelled
//   file     a file for the reader, in base64
//
// A number that is not known is null, and never a word or a zero.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/view/image_message.h"
#include "experiments/view/live_view.h"
#include "experiments/view/measurement.h"

namespace restlab {

// What a page cannot change.
struct ViewFacts {
  SceneRequest request;
  int threads = 1;
  std::filesystem::path program = {};  // that `run`s sessions; empty: this one
};

// Of the images that go to pages.
struct Transport {
  PixelFormat format = PixelFormat::floats;
  double megabytesPerSecond = 0.0;  // to all pages, measured
};

std::string helloText(const ViewFacts& facts, const LiveView& view);
std::string stateText(const LiveView& view, bool isPaused);
// `load`: processes that want to run, for each thread of the machine.
std::string numbersText(const LiveView& view, const Transport& transport, double load);
// Throws Error (badUsage) where there is no such pixel or no frame yet.
std::string probeText(const ViewFacts& facts, const LiveView& view, const Probe& probe);
// `command`: the text that was refused.
std::string errorText(const std::string& line, const std::string& command);
std::string saidText(const std::string& line);
std::string savedText(const std::string& name, const std::string& toml);
std::string measureText(const Measurement& measurement);
std::string fileText(const std::string& name, const std::string& bytes);

// `restlab render ...` that makes the pixel again; "" where no command does: the camera is none of
// the scene's, or the light or a parameter was changed while the history went on.
std::string probeCommand(const ViewFacts& facts, const LiveView& view, const Probe& probe);

}  // namespace restlab
