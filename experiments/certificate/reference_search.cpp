#include "experiments/certificate/reference_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/frame/session.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"

namespace restlab::certificate {
namespace {

// Wanted standard error of the reference, as a share of the margin: half of the variance that the
// planned interval may have, so that twice as many runs are needed as with an exact reference. Half
// of that error would need four times the samples.
constexpr double kReferenceShare = 0.2;
constexpr uint64_t kFirstReferenceSpp = 2048;
constexpr size_t kLongestLabel = 120;          // file names are limited to 255 bytes
constexpr uint32_t kSeedsOfViews = 1'000'003;  // distance of their seeds
// Samples and frames from which --plan estimates costs.
constexpr uint64_t kPlanSpp = 64;
constexpr uint32_t kPlanFrames = 4;
constexpr double kShareOfReference = 0.5;  // of the time limit

std::string duration(double seconds) {
  if (seconds < 120.0) return fmt::format("{} s", shortNumber(seconds, 2));
  return seconds < 7200.0 ? fmt::format("{:.0f} min", seconds / 60.0)
                          : fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string percent(double share) { return shortNumber(100.0 * share, 2) + " %"; }

// Prints both without sign, with enough digits to tell them apart.
std::pair<std::string, std::string> percents(double error, double wanted) {
  return apartNumbers(100.0 * error, 100.0 * wanted, 2);
}

void warnOfCoarse(const Reference& reference, double error, const Options& options,
                  const std::string& boundBy) {
  const auto [own, most] = percents(error, wantedReferenceError(options));
  logWarning(
      fmt::format("the reference's own error is {} % after {} spp, more than {} %: stopped by "
                  "{}; the interval is wider for it",
                  own, groupedDigits(reference.spp), most, boundBy));
}

double secondsOfRun(const Question& question) {
  Session session(question.prepared.scene, question.config);
  double seconds = 0.0;
  for (uint32_t i = 0; i < kPlanFrames; ++i) {
    throwIfInterrupted("nothing was written");
    const auto start = std::chrono::steady_clock::now();
    enterFrame(question, i, session);
    session.frame();
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return seconds * double(question.warmup + question.frames);
}

// Adds `weight` times an image to another.
void addScaled(const Image& image, float weight, Image& sum) {
  for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += weight * image.pixels[i];
}

// Obtains the reference of the mean of the counted frames: of each view, with its share of the
// samples.
Reference referenceOfFrames(const Question& question, const ReferenceTarget& target,
                            const std::filesystem::path& folder, const std::string& label) {
  ReferenceConfig config = referenceConfigOf(question.config);
  config.integrator = question.against;
  const std::vector<CountedView> views = countedViews(question);
  if (views.size() == 1) {
    config.camera = views[0].camera;
    return obtainReference(*views[0].prepared, config, target, folder, label);
  }
  Reference all;
  for (const CountedView& view : views) {
    const double share = double(view.frames) / double(question.frames);
    ReferenceTarget part = target;
    part.spp = std::max(uint64_t(2), uint64_t(std::ceil(share * double(target.spp))));
    part.timeLimitS = share * target.timeLimitS;
    config.camera = view.camera;
    // Errors of views that resemble each other must not.
    config.seed = question.config.seed + kSeedsOfViews * (view.firstFrame + 1);
    const Reference one = obtainReference(
        *view.prepared, config, part, folder,
        fmt::format("{}-frame{}", label.substr(0, kLongestLabel), view.firstFrame + 1));
    const bool isFirst = all.spp == 0;
    if (isFirst) all.mean = Image(one.mean.width, one.mean.height);
    if (isFirst) all.half0 = all.half1 = all.mean;
    addScaled(one.mean, float(share), all.mean);
    addScaled(one.half0.value(), float(share), *all.half0);
    addScaled(one.half1.value(), float(share), *all.half1);
    all.spp += one.spp;
    all.timeS += one.timeS;
    if (isFirst || !whyNotConverged(one).empty()) all.metadata = one.metadata;
  }
  return all;
}

std::string referencePlan(const Question& question, const Options& options) {
  if (question.exact) return "in closed form";
  const CountedView view = countedViews(question).front();
  ReferenceConfig config = referenceConfigOf(question.config);
  config.integrator = question.against;
  config.camera = view.camera;
  const Reference guess = renderReference(*view.prepared, config, {.spp = kPlanSpp});
  const stats::BlockGrid grid(question.config.width, question.config.height);
  const double error = relativeError(truthOf(guess, grid));
  const double spp = std::max(sppForError(error, double(guess.spp), wantedReferenceError(options)),
                              double(std::min(kFirstReferenceSpp, options.maxReferenceSpp)));
  const bool isBounded = spp > double(options.maxReferenceSpp);
  const double taken = std::min(spp, double(options.maxReferenceSpp));
  return fmt::format(
      "an error of {} of the mean is wanted, a fifth of the margin: about {} spp{}, {}",
      percent(wantedReferenceError(options)), groupedDigits(uint64_t(std::min(spp, 1e18))),
      isBounded ? fmt::format(", of which --max-reference-spp allows {}",
                              groupedDigits(options.maxReferenceSpp))
                : "",
      duration(taken * guess.timeS / double(guess.spp)));
}

}  // namespace

double wantedReferenceError(const Options& options) {
  return kReferenceShare * options.rules.margin;
}

double sppForError(double error, double spp, double wanted) {
  return spp * (error / wanted) * (error / wanted);
}

std::string searchText(double error, uint64_t spp, double timeS, const Options& options) {
  const double wanted = wantedReferenceError(options);
  // At least one more: the present samples are not enough.
  const double all = std::max(std::ceil(sppForError(error, double(spp), wanted)), double(spp) + 1);
  const double left = (all - double(spp)) * timeS / double(spp);
  const auto [own, most] = percents(error, wanted);
  return fmt::format(
      "its error is {} % after {} spp; wanted is {} %, a fifth of the margin: about {} spp, {} "
      "more",
      own, groupedDigits(spp), most, groupedDigits(uint64_t(std::min(all, 1e18))), duration(left));
}

Reference convergedReference(const Question& question, const std::string& label,
                             const Options& options) {
  const double wanted = wantedReferenceError(options);
  ReferenceTarget target;
  const stats::BlockGrid grid(question.config.width, question.config.height);
  target.timeLimitS = kShareOfReference * options.limit.seconds;
  target.spp = std::min(kFirstReferenceSpp, options.maxReferenceSpp);
  for (;; target.spp = std::min(2 * target.spp, options.maxReferenceSpp)) {
    Reference reference = referenceOfFrames(question, target, options.out / "references", label);
    const double error = relativeError(truthOf(reference, grid));
    if (const std::string why = whyNotConverged(reference); !why.empty() && error <= wanted)
      logWarning("the reference may lack light that no run can then be held against: " + why);
    if (error <= wanted) return reference;
    logInfo("reference: " + searchText(error, reference.spp, reference.timeS, options));
    if (target.spp >= options.maxReferenceSpp) {
      warnOfCoarse(reference, error, options, "--max-reference-spp");
      return reference;
    }
    // The next step takes as long as all before.
    const double nextS = reference.timeS * double(target.spp) / double(reference.spp);
    if (options.limit.isSet() && nextS > kShareOfReference * options.limit.leftS()) {
      warnOfCoarse(reference, error, options, "--time-limit");
      return reference;
    }
    target.timeLimitS = 0.0;  // time of earlier calls is in reference.timeS
  }
}

std::string planOf(const Question& question, const Options& options) {
  const double runS = secondsOfRun(question);
  const std::string runs =
      options.runs > 0
          ? fmt::format("{}: {}; as many fresh ones where the first batch rejects",
                        counted(options.runs, "run"), duration(runS * double(options.runs)))
          : fmt::format(
                "64 first ones, {}; these say how many are wanted, at most {} "
                "(--max-runs), {}; as many fresh ones where the first batch rejects",
                duration(64.0 * runS), options.maxRuns, duration(runS * double(options.maxRuns)));
  return fmt::format("{}\n  reference: {}\n  runs: {}\n", labelOf(question),
                     referencePlan(question, options), runs);
}

}  // namespace restlab::certificate
