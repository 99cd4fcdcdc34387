// Columns of many frames: of accumulated ones, and of the change from one to the next.
#include <fmt/format.h>

#include <cmath>

#include "experiments/runner/tables/column_groups.h"

namespace restlab {

namespace {

using Row = MethodSummary;

// Returns the last point of the curve; null without one.
const ConvergencePoint* lastPoint(const Row& row) {
  return row.convergence && !row.convergence->points.empty() ? &row.convergence->points.back()
                                                             : nullptr;
}

Interval slopeOf(const Row& row) { return row.convergence ? row.convergence->slope : kNone; }

uint64_t pointsOf(const Row& row) { return row.convergence ? row.convergence->points.size() : 0; }

// Without times no line is fitted.
Interval fittedOf(const Row& row) {
  if (!row.suite->timing) return kNone;
  return only(row.convergence ? double(row.convergence->fitted()) : 0.0);
}

Interval misfitOf(const Row& row) {
  return row.convergence && row.convergence->fitted() > 1 ? only(row.convergence->misfit) : kNone;
}

// Returns "6 of 8 points (not 1, 2 frames), up to 1.04x off"; "" without a line.
std::string lineText(const Row& row) {
  if (std::isnan(slopeOf(row).value)) return "";
  const Convergence& curve = *row.convergence;
  std::string left;
  for (const ConvergencePoint& point : curve.points)
    if (!point.isFitted) left += fmt::format("{}{}", left.empty() ? "" : ", ", point.frames);
  return fmt::format("{} of {} points{}, up to {}x off", curve.fitted(), curve.points.size(),
                     left.empty() ? "" : fmt::format(" (not {} frames)", left),
                     shortNumber(std::pow(10.0, curve.misfit)));
}

// Returns getters of a reading; kNone where nothing was read.
auto readingOf(CurveReading SpeedUp::*reading, Interval CurveReading::*ratio) {
  return [=](const Row& row) { return row.speedUp ? (*row.speedUp).*reading.*ratio : kNone; };
}
auto placeOf(CurveReading SpeedUp::*reading) {
  return
      [=](const Row& row) { return only(row.speedUp ? ((*row.speedUp).*reading).at : kUnknown); };
}

auto temporalOf(Interval TemporalSummary::*figure) {
  return [=](const Row& row) { return row.temporal ? (*row.temporal).*figure : kNone; };
}
auto temporalOf(double TemporalSummary::*figure) {
  return [=](const Row& row) { return only(row.temporal ? (*row.temporal).*figure : kUnknown); };
}

Column correlationColumn(size_t lag) {
  Column column = {.key = fmt::format("error_autocorrelation_{}", lag),
                   .get =
                       [lag](const Row& row) {
                         return row.temporal ? row.temporal->autocorrelation[lag - 1] : kNone;
                       },
                   .ends = Ends::all,
                   .narrow = std::to_string(lag)};
  column.help = fmt::format("correlation of errors that lie {} apart",
                            lag == 1 ? "a frame" : fmt::format("{} frames", lag));
  if (lag > 1) return column;
  column.title = "correlation of errors";
  column.reportKey = "correlation";
  column.better = "lower";
  return column;
}

}  // namespace

Columns accumulatedColumns() {
  return {{.key = "accumulated_frames",
           .get = [](const Row& row) -> ColumnValue {
             const ConvergencePoint* last = lastPoint(row);
             return last ? ColumnValue(uint64_t(last->frames)) : kNone;
           },
           .inCsv = false,
           .narrow = "frames",
           .tex = "frames"},
          {.key = "accumulated_ms",
           .get =
               [](const Row& row) {
                 const ConvergencePoint* last = lastPoint(row);
                 return only(last ? last->timeMs : kUnknown);
               },
           .inCsv = false,
           .narrow = "time",
           .unit = "ms"},
          {.key = "accumulated_mse",
           .get = [](const Row& row) { return lastPoint(row) ? lastPoint(row)->mse : kNone; },
           .ends = Ends::people,
           .inCsv = false,
           .narrow = "MSE",
           .form = Form::error},
          {.key = "accumulated_line", .get = lineText, .inCsv = false, .narrow = "line"},
          {.key = "accumulated_slope",
           .get = slopeOf,
           .ends = Ends::all,
           .title = "slope",
           .reportKey = "slope",
           .better = "lower",
           .help = "of log(MSE) over log(time) while frames accumulate"},
          {.key = "accumulated_points",
           .get = pointsOf,
           .help = "points of the curve, at 1, 2, 4, ... frames"},
          {.key = "accumulated_points_fitted",
           .get = fittedOf,
           .help = "points that the line goes through: those above the noise of the reference"},
          {.key = "accumulated_misfit_log10",
           .get = misfitOf,
           .help = "the largest |log10(MSE / line)|"},
          {.key = "equal_time_mse_ratio",
           .get = readingOf(&SpeedUp::equalTime, &CurveReading::ratio),
           .ends = Ends::all,
           .title = "MSE of {0} / MSE at equal time",
           .narrow = "at equal time",
           .tex = "lower",
           .reportKey = "equal_time",
           .better = "higher",
           .help = "MSE of {0} / MSE off the fitted lines, where both have taken the same time",
           .against = Against::baseline,
           .noteWord = "at",
           .noteKey = "equal_time_ms"},
          {.key = "equal_time_mse_ratio_measured",
           .get = readingOf(&SpeedUp::equalTime, &CurveReading::measured),
           .ends = Ends::all,
           .help = "the same between measured points, straight in the logarithms"},
          {.key = "equal_time_ms",
           .get = placeOf(&SpeedUp::equalTime),
           .unit = "ms",
           .help = "where equal_time_mse_ratio was read"},
          {.key = "equal_error_time_ratio",
           .get = readingOf(&SpeedUp::equalError, &CurveReading::ratio),
           .ends = Ends::all,
           .title = "time of {0} / time to equal error",
           .narrow = "to equal error",
           .tex = "faster",
           .reportKey = "equal_error",
           .better = "higher",
           .help = "off the fitted lines; above 1: faster",
           .against = Against::baseline,
           .noteWord = "to",
           .noteKey = "equal_error_mse"},
          {.key = "equal_error_time_ratio_measured",
           .get = readingOf(&SpeedUp::equalError, &CurveReading::measured),
           .ends = Ends::all,
           .help = "the same between measured points"},
          {.key = "equal_error_mse",
           .get = placeOf(&SpeedUp::equalError),
           .help = "where equal_error_time_ratio was read"}};
}

Columns temporalColumns() {
  Columns all = {
      {.key = "temporal_variance",
       .get = temporalOf(&TemporalSummary::variance),
       .ends = Ends::all,
       .title = "variance over frames",
       .narrow = "variance",
       .better = "lower",
       .help = "flicker of a pixel"},
      {.key = "temporal_difference",
       .get = temporalOf(&TemporalSummary::difference),
       .ends = Ends::all,
       .title = "frame difference",
       .narrow = "difference",
       .help = "mean |f_t - f_(t-1)|, motion included"},
      {.key = "temporal_error_difference_squared",
       .get = temporalOf(&TemporalSummary::errorDifferenceSquared),
       .ends = Ends::all,
       .title = "change of errors",
       .reportKey = "temporal_error_difference",
       .better = "lower",
       .help =
           "mean (e_t - e_(t-1))^2 of the errors against the reference's halves: without motion "
           "and without the reference's noise"},
      {.key = "temporal_difference_of_reference",
       .get = temporalOf(&TemporalSummary::referenceDifference),
       .help = "mean |r_t - r_(t-1)| of a moving camera, motion and noise"},
      {.key = "temporal_difference_of_reference_noise",
       .get = temporalOf(&TemporalSummary::referenceDifferenceNoise),
       .help = "how much of that is noise, at most"},
      {.key = "camera_path",
       .get = [](const Row& row) { return row.suite->cameraPathName; },
       .help = "name of the camera path"}};
  const size_t lags = std::tuple_size_v<decltype(TemporalSummary::autocorrelation)>;
  for (size_t lag = 1; lag <= lags; ++lag) all.push_back(correlationColumn(lag));
  return all;
}

}  // namespace restlab
