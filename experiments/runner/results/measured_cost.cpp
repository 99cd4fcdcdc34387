#include "experiments/runner/results/measured_cost.h"

#include <chrono>

#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/reference/reference_halves.h"
#include "experiments/runner/suite/picture.h"

namespace restlab {

namespace {

// Returns the wall-clock seconds of a frame, including work between its passes.
double secondsOfFrame(const PreparedScene& prepared, const SessionConfig& config,
                      size_t& bytesPerPixel) {
  Session session(prepared.scene, config);
  bytesPerPixel = session.bytesPerPixel();
  double seconds = 0.0;
  for (uint32_t i = 0; i < kProbeFrames; ++i) {
    throwIfInterrupted("nothing was written");
    const auto start = std::chrono::steady_clock::now();
    session.frame();
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return seconds;
}

}  // namespace

MeasuredCost measureRun(const Suite& suite, const PreparedScene& prepared,
                        const BlockResult& block) {
  MeasuredCost cost;
  const SessionConfig picture = pictureOf(suite, block.width, block.height, block.component);
  const double frames = double(suite.warmupFrames) + double(suite.timedFrames);
  for (const SuiteMethod& method : suite.rendered()) {
    size_t own = 0;
    cost.runS +=
        frames * secondsOfFrame(prepared, methodConfig(suite, method, prepared, picture), own);
    cost.bytesPerPixel += own + hostBytesPerPixelOfMethod(suite);
  }
  return cost;
}

double secondsOfSample(const Suite& suite, const PreparedScene& prepared,
                       const BlockResult& block) {
  const SessionConfig picture = pictureOf(suite, block.width, block.height, block.component);
  size_t ignored = 0;
  return secondsOfFrame(prepared, referenceSession(prepared, referenceOfSuite(suite, picture)),
                        ignored);
}

}  // namespace restlab
