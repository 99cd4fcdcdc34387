#include "experiments/runner/results/run_cost.h"

namespace restlab {

double costOfRun(const Suite& suite, const SuiteScene& scene) {
  constexpr double kAspect = 16.0 / 9.0, kUsualWidth = 640.0;
  double width = scene.width || scene.height ? scene.width : suite.width;
  double height = scene.width || scene.height ? scene.height : suite.height;
  if (width == 0.0 && height == 0.0) width = kUsualWidth;
  if (width == 0.0) width = height * kAspect;
  if (height == 0.0) height = width / kAspect;
  const double frames = double(suite.warmupFrames) + double(suite.timedFrames);
  return width * height * frames * double(suite.rendered().size());
}

}  // namespace restlab
