// Makes certificates: of a method, whose reference and runs it renders, or of images of any
// program.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/part.h"
#include "experiments/certificate/certificate.h"
#include "experiments/certificate/run_folder.h"

namespace restlab::certificate {

// Time limit of the whole command, from when this is made; 0: none.
struct TimeLimit {
  double seconds = 0.0;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  bool isSet() const { return seconds > 0.0; }
  // Not below 0. Infinity without a limit.
  double leftS() const;
};

struct Options {
  Rules rules;
  uint64_t runs = 0;        // 0: as many as a first few say
  uint64_t maxRuns = 4096;  // that these may ask for
  uint64_t maxReferenceSpp = uint64_t(1) << 22;
  TimeLimit limit;
  // What the first few reject takes no more runs than cells need: who asks for the verdicts of many
  // methods need not know each bias as well.
  bool fewOfBiased = false;
  uint32_t jobs = 0;  // runs side by side; 0: one a core
  std::filesystem::path out;
};

// A certificate with what a reader must know of it.
struct Certified {
  std::string name;   // "door-ajar, restir_gi unbiased, pixel"
  std::string label;  // the same as part of a file name
  // The same in its parts; all empty of images of other programs.
  std::string scene, method, denoiser;
  std::optional<BiasClass> declared;  // what the method says of itself while the view stands still
  std::string how;  // what a run is and where the reference comes from, a sentence each
  Certificate certificate;
  Reference reference;
  Image mean;                      // of the runs
  HealthSum health;                // of all their frames; nothing of images of other programs
  std::vector<std::string> notes;  // what qualifies the verdict
  std::string replay;              // the command that prints a pixel of the first run, without it
  double referenceError = 0.0;     // relative standard error of its mean, the largest quantity
};

// Why `allowed` runs are made and not `wanted`: `leftS` seconds of --time-limit are left, and a run
// takes `runS`.
std::string timeLimitText(uint64_t allowed, uint64_t wanted, double leftS, double runS);

// Scene, method and its parameters as part of a file name.
std::string labelOf(const Question& question);

// Renders what is missing below options.out: the reference until its error is a fifth of the
// margin, a first few runs, as many as these ask for, and a fresh batch where the first one
// rejects. Throws Error.
Certified certify(const Question& question, const Options& options);

// Images that are independent runs of one method against the reference in a file. Each second one
// is of the fresh batch. Throws Error (badInput) naming a file that cannot be used: one of another
// size, of another scene or camera, one with the method of another one or its seed or pixels; or
// that there are too few.
Certified certifyImages(const std::vector<std::string>& files, const std::string& reference,
                        const Options& options);

}  // namespace restlab::certificate
