#include "experiments/report/series.h"

#include <algorithm>
#include <cmath>

#include "experiments/report/svg_style.h"

namespace restlab {

namespace {

constexpr double kSeriesMargin = 8.0, kSeriesGap = 6.0;
constexpr double kLargestLabel = 18.0, kSmallestLabel = 10.0;

}  // namespace

Figure layOutSeries(const std::vector<SeriesPicture>& pictures, const std::string& title,
                    float exposure) {
  const double width = pictures.front().image.width, height = pictures.front().image.height;
  double size = kLargestLabel;
  for (const SeriesPicture& picture : pictures)
    size = std::min(size, width / std::max(1.0, svg::textWidth(picture.label, 1.0)));
  size = std::max(kSmallestLabel, std::floor(size));
  const double top = kSeriesMargin + std::ceil(1.5 * size), line = std::ceil(1.5 * size);
  Figure figure;
  figure.description = title;
  const auto addText = [&](double x, double y, const char* anchor, const std::string& text,
                           double most) {
    const std::string fitted = svg::fitText(text, most, size);
    if (fitted.size() < text.size()) figure.cutLabels.push_back(text);
    figure.texts.push_back({x, y, anchor, fitted, size, false});
  };
  double x = kSeriesMargin;
  for (const SeriesPicture& picture : pictures) {
    const Image& image = picture.image;
    figure.pictures.push_back(
        {x, top, width, height, pictureOf(image, {0, 0, image.width, image.height}, exposure, 1)});
    addText(x + width / 2.0, kSeriesMargin + size, "middle", picture.label, width);
    x += width + kSeriesGap;
  }
  figure.width = std::ceil(x - kSeriesGap + kSeriesMargin);
  figure.height = std::ceil(top + height + line + kSeriesMargin);
  addText(kSeriesMargin, top + height + size + 4.0, "start", title,
          figure.width - 2.0 * kSeriesMargin);
  return figure;
}

}  // namespace restlab
