#include "experiments/report/figure.h"

#include <algorithm>
#include <cmath>

#include "experiments/report/svg_style.h"

namespace restlab {
namespace {

constexpr double kMargin = 8.0, kGap = 6.0;
constexpr double kLargestText = 18.0, kSmallestText = 10.0;

// Returns the largest size of text at which every label fits into a column.
double textSize(const FigureSpec& spec, double width) {
  double size = kLargestText;
  for (const FigureColumn& column : spec.columns) {
    size = std::min(size, width / std::max(1.0, svg::textWidth(column.label, 1.0)));
  }
  return std::max(kSmallestText, std::floor(size));
}

std::string cropColour(size_t index) {
  // Palette order that begins with colours that stand out on pictures.
  static const size_t order[] = {1, 5, 2, 4, 3, 0, 6};
  return svg::colour(order[index % 7]);
}

class Layout {
 public:
  explicit Layout(const FigureSpec& spec) : spec_(spec) {
    cellWidth_ = double(spec.crops.front().width) * spec.scale;
    cellHeight_ = double(spec.crops.front().height) * spec.scale;
    size_ = textSize(spec, cellWidth_);
    line_ = std::ceil(1.35 * size_);
    for (const FigureColumn& column : spec.columns) hasCropErrors_ |= !column.cropErrors.empty();
    const double rows = double(spec.crops.size());
    rowStep_ = cellHeight_ + kGap + (hasCropErrors_ ? line_ : 0.0);
    // Keep the descenders of the labels clear of the frames.
    top_ = kMargin + std::ceil(1.2 * size_) + 5.0;
    stripHeight_ = rows * rowStep_ - kGap;
  }

  Figure make() {
    const double fullWidth = addFull();
    double x = kMargin + fullWidth + 2.0 * kGap;
    for (const FigureColumn& column : spec_.columns) {
      addColumn(column, x);
      x += cellWidth_ + kGap;
    }
    addMetricName(fullWidth);
    figure_.width = std::ceil(x - kGap + kMargin);
    figure_.height = std::ceil(top_ + stripHeight_ + line_ + kMargin);
    return std::move(figure_);
  }

 private:
  // Adds the whole image, as high as the rows of crops. Returns its width.
  double addFull() {
    const Image& full = *spec_.full;
    const double height = hasCropErrors_ ? stripHeight_ - line_ : stripHeight_;
    const double scale = height / double(full.height);
    const double width = std::round(scale * double(full.width));
    const Image shown = resized(full, uint32_t(width), uint32_t(height));
    figure_.pictures.push_back(
        {kMargin, top_, width, height,
         pictureOf(shown, {0, 0, shown.width, shown.height}, spec_.exposure, 1)});
    addText(kMargin + width / 2.0, kMargin + size_, "middle", spec_.fullLabel, width, false);
    for (size_t i = 0; i < spec_.crops.size(); ++i) {
      const Crop& crop = spec_.crops[i];
      FigureFrame frame = {kMargin + scale * crop.x,
                           top_ + scale * crop.y,
                           scale * crop.width,
                           scale * crop.height,
                           4.0,
                           "#ffffff"};
      figure_.frames.push_back(frame);
      frame.thickness = 2.0;
      frame.colour = cropColour(i);
      figure_.frames.push_back(frame);
    }
    return width;
  }

  void addColumn(const FigureColumn& column, double x) {
    const double middle = x + cellWidth_ / 2.0;
    addText(middle, kMargin + size_, "middle", column.label, cellWidth_, false);
    for (size_t i = 0; i < spec_.crops.size(); ++i) {
      const double y = top_ + rowStep_ * double(i);
      figure_.pictures.push_back(
          {x, y, cellWidth_, cellHeight_,
           pictureOf(*column.image, spec_.crops[i], spec_.exposure, spec_.scale)});
      figure_.frames.push_back({x, y, cellWidth_, cellHeight_, 2.0, cropColour(i)});
      if (column.cropErrors.empty()) continue;
      addText(middle, y + cellHeight_ + size_ + 1.0, "middle", column.cropErrors[i], cellWidth_,
              false);
    }
    addText(middle, errorLine(), "middle", column.error, cellWidth_, column.best);
  }

  // Left of the first column, on the line of the errors.
  void addMetricName(double fullWidth) {
    addText(kMargin + fullWidth, errorLine(), "end", spec_.metric, fullWidth, false);
  }

  double errorLine() const { return top_ + stripHeight_ + size_ + 3.0; }

  void addText(double x, double y, const char* anchor, const std::string& text, double width,
               bool bold) {
    if (text.empty()) return;
    const std::string fitted = svg::fitText(text, width, size_);
    if (fitted.size() < text.size()) figure_.cutLabels.push_back(text);
    figure_.texts.push_back({x, y, anchor, fitted, size_, bold});
  }

  const FigureSpec& spec_;
  Figure figure_;
  double cellWidth_, cellHeight_, size_, line_, rowStep_, top_, stripHeight_;
  bool hasCropErrors_ = false;
};

}  // namespace

Figure layOutFigure(const FigureSpec& spec) { return Layout(spec).make(); }

}  // namespace restlab
