#include "experiments/view/capture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/backend/stop.h"
#include "core/base/error.h"
#include "experiments/report/svg_style.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/run/experiment.h"
#include "experiments/view/view_exposure.h"
#include "experiments/view/view_session.h"

namespace restlab {

namespace {

constexpr double kMargin = 8.0, kGap = 6.0;
constexpr double kLargestText = 16.0, kSmallestText = 10.0;
constexpr uint64_t kMaxPixels = uint64_t(1) << 26;  // same limit as `figure`
constexpr const char* kInterrupted = "nothing was written";

struct Column {
  std::string name;
  const Image* image = nullptr;
};

void renderAll(LiveView& view, const CaptureOptions& options) {
  const LiveReference& reference = view.reference();
  Progress progress("frame or sample", options.frames + options.referenceSpp);
  try {
    for (uint64_t frame = 0; frame < options.frames; ++frame) {
      throwIfInterrupted(kInterrupted);
      view.renderFrames();
      progress.update(frame + 1);
    }
    while (view.hasScene() && (reference.spp() < options.referenceSpp || !reference.hasImage())) {
      throwIfInterrupted(kInterrupted);
      view.refineReference();
      progress.update(options.frames + reference.spp());
    }
  } catch (const FrameStopped&) {
    throwIfInterrupted(kInterrupted);
    throw;
  }
}

// Returns the largest size at which every name fits above its picture.
double textSize(const std::vector<Column>& columns, double width) {
  double size = kLargestText;
  for (const Column& column : columns)
    size = std::min(size, width / std::max(1.0, svg::textWidth(column.name, 1.0)));
  return std::max(kSmallestText, std::floor(size));
}

Figure layOut(const std::vector<Column>& columns, float exposure) {
  const Image& first = *columns.front().image;
  const double width = first.width, height = first.height;
  const double size = textSize(columns, width);
  const double top = kMargin + std::ceil(1.35 * size);
  Figure figure;
  double x = kMargin;
  for (const Column& column : columns) {
    const std::string name = svg::fitText(column.name, width, size);
    if (name.size() < column.name.size()) figure.cutLabels.push_back(column.name);
    figure.texts.push_back({x + width / 2.0, kMargin + size, "middle", name, size, false});
    figure.pictures.push_back(
        {x, top, width, height,
         pictureOf(*column.image, {0, 0, first.width, first.height}, exposure, 1)});
    x += width + kGap;
  }
  figure.width = x - kGap + kMargin;
  figure.height = top + height + kMargin;
  return figure;
}

}  // namespace

void requireCaptureSize(const ViewSettings& settings) {
  const SessionConfig& config = settings.panes.front().config;
  const uint64_t width = config.width * (settings.panes.size() + 1);
  if (width * config.height <= kMaxPixels) return;
  failUsage(fmt::format(
      "--capture: the picture would have {}x{} pixels, and at most {} fit; choose a smaller "
      "--resolution",
      width, config.height, kMaxPixels));
}

Figure capture(LiveView& view, const CaptureOptions& options) {
  renderAll(view, options);
  const std::vector<std::string> names = paneNames(view);
  std::vector<Column> columns;
  for (size_t i = 0; i < view.panes(); ++i) {
    const std::string letter = view.hasScene() ? fmt::format("{}: ", char('A' + int(i))) : "";
    columns.push_back({letter + names[i], view.picture(i)});
  }
  if (view.reference().hasImage())
    columns.push_back(
        {fmt::format("reference, {} spp", view.reference().spp()), &view.reference().mean()});
  return layOut(columns, float(exposureOf(view)));
}

std::map<std::string, std::string> captureWords(const LiveView& view) {
  std::map<std::string, std::string> words = provenanceWords();
  std::vector<std::map<std::string, std::string>> panes(view.panes());
  for (size_t i = 0; i < panes.size(); ++i) {
    if (view.renders(i)) {
      panes[i] = describe(view.shown(), view.session(i).config());
      panes[i]["seed"] = std::to_string(view.session(i).config().seed);
      panes[i]["frame"] = std::to_string(view.frames(i) - 1);
    } else {
      panes[i]["source"] = view.settings().panes[i].source;
    }
  }
  for (size_t i = 0; i < panes.size(); ++i) {
    for (const auto& [key, value] : panes[i]) {
      const bool isCommon = std::all_of(panes.begin(), panes.end(), [&](const auto& other) {
        const auto found = other.find(key);
        return found != other.end() && found->second == value;
      });
      const std::string pane =
          view.hasScene() ? std::string(1, char('A' + int(i))) : std::to_string(i + 1);
      words[isCommon ? key : fmt::format("{}.{}", pane, key)] = value;
    }
  }
  words["kind"] = "capture";
  words["exposure"] = fmt::format("{:.6g}", exposureOf(view));
  if (view.reference().hasImage()) words["reference_spp"] = std::to_string(view.reference().spp());
  return words;
}

}  // namespace restlab
