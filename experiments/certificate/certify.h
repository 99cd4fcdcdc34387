// Makes certificates: of a method, rendering its reference and runs, or of images of any program.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/frame/part.h"
#include "experiments/certificate/certificate.h"
#include "experiments/certificate/run_folder.h"
#include "experiments/runner/base/health_sum.h"

namespace restlab::certificate {

// Time limit of the whole command, counted from construction; 0: none.
struct TimeLimit {
  double seconds = 0.0;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  bool isSet() const { return seconds > 0.0; }
  // Returns the remaining seconds, at least 0; infinity without a limit.
  double leftS() const;
};

struct Options {
  Rules rules;
  uint64_t runs = 0;        // 0: planned from pilot runs
  uint64_t maxRuns = 4096;  // limit of planned runs
  uint64_t maxReferenceSpp = uint64_t(1) << 22;
  TimeLimit limit;
  // Limits runs to kRunsForCells if the pilot runs reject the method: in verdicts on many methods,
  // each bias need not be known as precisely.
  bool fewOfBiased = false;
  uint32_t jobs = 0;  // runs in parallel; 0: one per core
  std::filesystem::path out;
};

// A certificate with its context.
struct Certified {
  std::string name;   // "door-ajar, restir_gi unbiased, pixel"
  std::string label;  // name as part of a file name
  // Parts of the name; all empty for images of other programs.
  std::string scene, method, denoiser;
  std::optional<BiasClass> declared;  // bias class as the method declares it for this view
  std::string how;  // what a run is and where the reference comes from, one sentence each
  Certificate certificate;
  Reference reference;
  Image mean;                      // of the runs
  HealthSum health;                // over all frames of the runs; empty for images of other
                                   // programs
  std::vector<std::string> notes;  // limits of the verdict
  bool isOfImages = false;         // of another program: nothing was rendered
  // Command that prints a pixel of the first run, without the pixel; "" if `render` cannot.
  std::string replay;
  double referenceError = 0.0;  // relative standard error of its mean, the largest over
                                // quantities
};

// Explains why only `allowed` of `wanted` runs are rendered: --time-limit leaves `leftS` seconds,
// and a run takes `runS`.
std::string timeLimitText(uint64_t allowed, uint64_t wanted, double leftS, double runS);

// Returns scene, method and its parameters as part of a file name.
std::string labelOf(const Question& question);

// Renders what is missing below options.out: the reference until its error is a fifth of the
// margin, pilot runs, the planned runs, and a fresh batch if the first one rejects. Throws Error.
Certified certify(const Question& question, const Options& options);

// Certifies images that are independent runs of one method, against the reference in a file. Every
// second image belongs to the fresh batch. Throws Error (badInput) if there are too few, or naming
// a file that cannot be used: of another size, scene, camera or method, or with the seed or pixels
// of another file.
Certified certifyImages(const std::vector<std::string>& files, const std::string& reference,
                        const Options& options);

}  // namespace restlab::certificate
