// Messages of the viewer to pages: one JSON object per message, {"say": NAME, ...}.
//
//   hello    the scene, everything to choose from, warnings of the start; the first message
//   state    the settings, after each change and after hello
//   numbers  whether nothing is lit, errors, times, rays and health of the last frames
//   probe    what a pane keeps for a pixel
//   error    why a command was refused
//   said     a notice
//   saved    the settings as a suite
//   measure  progress of the run of a saved session: running, finished, failed or cancelled
//   file     a file for the reader, in base64
//
// An unknown number is null, never a word or a zero.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/view/image_message.h"
#include "experiments/view/live_view.h"
#include "experiments/view/measurement.h"

namespace restlab {

// Facts that a page cannot change.
struct ViewFacts {
  SceneRequest request;
  int threads = 1;
  std::filesystem::path program = {};      // program that `run`s sessions; empty: this one
  std::vector<std::string> warnings = {};  // of the start; few and short
};

// Format and rate of the images that go to pages.
struct Transport {
  PixelFormat format = PixelFormat::floats;
  double megabytesPerSecond = 0.0;  // to all pages, measured
};

std::string helloText(const ViewFacts& facts, const LiveView& view);
// State of the loop that pages can change.
struct LoopState {
  bool isPaused = false, isAdaptive = true;
};
std::string stateText(const LiveView& view, const LoopState& loop);
// `load`: load average per thread of the machine.
std::string numbersText(const LiveView& view, const Transport& transport, double load);
// Throws Error (badUsage) if there is no such pixel or no frame yet.
std::string probeText(const ViewFacts& facts, const LiveView& view, const Probe& probe);
// `command`: text of the refused command.
std::string errorText(const std::string& line, const std::string& command);
// Tells that a frame of a pane is under way; `fraction` of its work is done.
std::string progressText(size_t pane, uint64_t frame, double fraction);
// Tells that a method is made ready, which may take seconds: its kernels are compiled.
std::string preparingText();
std::string saidText(const std::string& line);
std::string savedText(const std::string& name, const std::string& toml);
std::string measureText(const Measurement& measurement);
std::string fileText(const std::string& name, const std::string& bytes);

// Returns a `restlab render ...` that makes the pixel again; "" if no command does: the camera is
// not one of the scene's, or the light or a parameter was changed during the history.
std::string probeCommand(const ViewFacts& facts, const LiveView& view, const Probe& probe);

}  // namespace restlab
