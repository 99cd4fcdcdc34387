// Columns of single frames: times, errors, rays and bytes.
#include <fmt/format.h>

#include "core/image/metrics/metrics.h"
#include "experiments/runner/run/figures.h"
#include "experiments/runner/tables/column_groups.h"

namespace restlab {

namespace {

using Row = MethodSummary;

std::string textOfPasses(const std::vector<PassTiming>& passes) {
  std::string text;
  for (const PassTiming& pass : passes)
    text += fmt::format("{}{}={:.4g}", text.empty() ? "" : " ", pass.name, pass.timeMs);
  return text;
}
std::string passesText(const Row& row) { return textOfPasses(row.passes); }
std::string scenePassesText(const Row& row) { return textOfPasses(row.scenePasses); }

// Images of other programs have no buffers here.
ColumnValue bytesPerPixelOf(const Row& row) {
  if (row.method->images) return kNone;
  return uint64_t(row.result->bytesPerPixel);
}

}  // namespace

Columns frameColumns() {
  return {
      {.key = "time_ms_median",
       .get = [](const Row& row) { return only(row.timeMsMedian); },
       .title = "time per frame",
       .narrow = "time per frame (x times that of {0})",
       .tex = "ms",
       .reportKey = "time_ms",
       .unit = "ms",
       .better = "lower",
       .help = "median over timed frames: passes, nothing else",
       .isMain = true,
       .ranked = Ranked::measured},
      {.key = "time_ms_p95",
       .get = [](const Row& row) { return only(row.timeMsP95); },
       .unit = "ms",
       .help = "95th percentile over timed frames"},
      {.key = "mse",
       .get = [](const Row& row) { return row.mse; },
       .ends = Ends::all,
       .title = "MSE",
       .better = "lower",
       .help = "of the frame after the warm-up, against the reference's halves",
       .isMain = true,
       .form = Form::error,
       .ranked = Ranked::positive},
      {.key = "mse_ratio",
       .get = [](const Row& row) { return row.mseRatio; },
       .ends = Ends::all,
       .title = "MSE of {0} / MSE",
       .narrow = "than {0}",
       .tex = "lower",
       .better = "higher",
       .help = "above 1: a lower MSE than {0}",
       .isMain = true,
       .against = Against::baseline},
      {.key = "average_mse_ratio",
       .get = [](const Row& row) { return row.ratioToAverage; },
       .ends = Ends::all,
       .title = "MSE of {1} / MSE",
       .narrow = "than {1}",
       .reportKey = "average_ratio",
       .better = "higher",
       .help = "above 1: a lower MSE than {1}",
       .isMain = true,
       .against = Against::average},
      {.key = "time_ratio",
       .get = [](const Row& row) { return row.timeRatio; },
       .ends = Ends::all,
       .title = "time / time of {0}",
       .tex = "time",
       .better = "lower",
       .help = "geometric mean over runs of the median over frames of time / time of the frame of "
               "{0} beside it; the ratio of two medians may differ where the machine was disturbed",
       .isMain = true,
       .ranked = Ranked::measured,
       .against = Against::baseline},
      {.key = "time_ratio_of_medians",
       .get = [](const Row& row) { return only(row.timeRatioOfMedians); },
       .help = "ratio of the two time_ms_median"},
      {.key = "efficiency_ratio",
       .get = [](const Row& row) { return row.efficiencyRatio; },
       .ends = Ends::all,
       .title = "efficiency against {0}",
       .narrow = "efficiency (against {0})",
       .reportKey = "efficiency",
       .better = "higher",
       .help = "MSE of {0} / MSE, divided by the time ratio to {0}",
       .ranked = Ranked::measured,
       .against = Against::baseline},
      {.key = "energy_ratio",
       .get = [](const Row& row) { return row.energyRatio; },
       .ends = Ends::all,
       .title = "energy",
       .reportKey = "energy",
       .help = "mean(image) / mean(reference); its ideal is 1",
       .isMain = true,
       .digits = kEnergyDigits},
      {.key = "relmse_e1e-2",
       .get = [](const Row& row) { return row.relmse; },
       .ends = Ends::all,
       .title = "relMSE",
       .reportKey = "relmse",
       .better = "lower",
       .help = "relmse_e1e-2",
       .form = Form::error,
       .ranked = Ranked::positive},
      {.key = "relmse_e1e-2_trim0.1",
       .get = [](const Row& row) { return row.relmseTrimmed; },
       .ends = Ends::all,
       .title = "relMSE without the worst 0.1 %",
       .narrow = "relMSE without the worst 0.1 % (than {0})",
       .reportKey = "relmse_trimmed",
       .better = "lower",
       .help = "relmse_e1e-2_trim0.1",
       .form = Form::error,
       .ranked = Ranked::positive},
      {.key = "relmse_e1e-2_trim0.1_ratio",
       .get = [](const Row& row) { return row.relmseTrimmedRatio; },
       .ends = Ends::all,
       .help = "that of {0} / that of the method",
       .against = Against::baseline},
      {.key = "mse_without_lights",
       .get = [](const Row& row) { return row.mseWithoutLights; },
       .ends = Ends::all,
       .title = "MSE without lights in view",
       .narrow = "MSE without lights in view (than {0})",
       .better = "lower",
       .help = "over the pixels that show no light directly",
       .form = Form::error,
       .ranked = Ranked::positive},
      {.key = "mse_ratio_without_lights",
       .get = [](const Row& row) { return row.mseRatioWithoutLights; },
       .ends = Ends::all,
       .help = "mse_without_lights of {0} / that of the method",
       .against = Against::baseline},
      {.key = "bias_squared",
       .get = [](const Row& row) { return row.biasSquared; },
       .ends = Ends::all,
       .help = "over all pairs of runs, signed; with the noise of the reference in the interval"},
      {.key = "bias_share_of_mse",
       .get = [](const Row& row) { return row.biasShare; },
       .ends = Ends::people,
       .title = "bias^2 / MSE",
       .narrow = "bias^2/MSE",
       .tex = "bias$^2$",
       .reportKey = "bias_share",
       .unit = "%",
       .help = "signed; over all pairs of runs",
       .form = Form::percent},
      {.key = "variance",
       .get = [](const Row& row) { return row.variance; },
       .ends = Ends::all,
       .title = "variance",
       .better = "lower",
       .help = "MSE less bias^2: mean over pixels, from pairs of runs",
       .ranked = Ranked::positive},
      {.key = "worst_0.1pct_share_of_mse",
       .get = [](const Row& row) { return only(row.worstShare); },
       .title = "worst 0.1 %",
       .reportKey = "worst_share",
       .unit = "%",
       .help = "share of the MSE in the worst thousandth of the pixels",
       .form = Form::percent},
      {.key = "rays_per_pixel",
       .get = [](const Row& row) { return only(row.raysPathPerPixel + row.raysShadowPerPixel); },
       .title = "rays / pixel",
       .narrow = "rays/px",
       .reportKey = "rays",
       .help = "path and shadow rays of a frame"},
      {.key = "path_rays_per_pixel",
       .get = [](const Row& row) { return only(row.raysPathPerPixel); },
       .help = "path rays of a timed frame"},
      {.key = "shadow_rays_per_pixel",
       .get = [](const Row& row) { return only(row.raysShadowPerPixel); },
       .help = "shadow rays of a timed frame"},
      {.key = "bytes_per_pixel",
       .get = bytesPerPixelOf,
       .title = "bytes / pixel",
       .reportKey = "bytes",
       .better = "lower",
       .help = "of all buffers"},
      {.key = "passes_ms_median", .get = passesText, .unit = "ms", .help = "median of each pass"},
      {.key = "scene_ms",
       .get = [](const Row& row) { return only(row.sceneMs); },
       .title = "time once a scene",
       .unit = "ms",
       .better = "lower",
       .help = "work for the scene, of which no frame is the owner: factors of radiosity, say",
       .ranked = Ranked::measured},
      {.key = "scene_passes_ms",
       .get = scenePassesText,
       .unit = "ms",
       .help = "of each pass of that work, over all frames"}};
}

Columns figureColumns(const Suite& suite) {
  Columns all;
  const std::vector<FigureInfo> infos = figureInfos(suite);
  for (size_t i = 0; i < infos.size(); ++i) {
    const MetricInfo& metric = findMetric(infos[i].metric);
    const bool isEnergy = infos[i].metric == "energy_ratio";  // its ideal is 1
    all.push_back({.key = infos[i].name,
                   .get = [i](const Row& row) { return row.figures.at(i).second; },
                   .ends = Ends::all,
                   .title = infos[i].name,
                   .better = isEnergy                ? "none"
                             : metric.higherIsBetter ? "higher"
                                                     : "lower",
                   .help = metric.formula,
                   .digits = isEnergy ? kEnergyDigits : kDigits});
  }
  return all;
}

}  // namespace restlab
