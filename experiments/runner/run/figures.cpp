#include "experiments/runner/run/figures.h"

#include "experiments/runner/reference/reference_error.h"

namespace restlab {

std::vector<FigureInfo> figureInfos(const Suite& suite) {
  std::vector<FigureInfo> all;
  for (const std::string& metric : suite.metrics) all.push_back({metric, metric, -1});
  for (size_t i = 0; i < suite.masks.size(); ++i) {
    const std::string& mask = suite.masks[i].name;
    all.push_back({"mse@" + mask, "mse", int(i)});
    for (const std::string& metric : suite.metrics)
      all.push_back({metric + "@" + mask, metric, int(i)});
  }
  return all;
}

nlohmann::ordered_json figuresWords(const Suite& suite) {
  nlohmann::ordered_json masks = nlohmann::ordered_json::array();
  for (const SuiteMask& mask : suite.masks) {
    nlohmann::ordered_json rectangles = nlohmann::ordered_json::array();
    for (const PixelRectangle& r : mask.rectangles) rectangles.push_back({r.x0, r.y0, r.x1, r.y1});
    masks.push_back({mask.name, mask.scene, mask.objects, rectangles, mask.withoutLights});
  }
  return {suite.metrics, masks};
}

std::vector<std::pair<std::string, MetricValue>> measureFigures(const Suite& suite,
                                                                const BlockResult& block,
                                                                const Image& image) {
  std::vector<std::pair<std::string, MetricValue>> figures;
  for (const FigureInfo& figure : figureInfos(suite)) {
    MetricOptions options;
    if (figure.mask >= 0) {
      options.mask = block.masks.at(size_t(figure.mask));
      if (options.mask.empty()) continue;
    }
    figures.emplace_back(figure.name, errorAgainst(figure.metric, image, block.reference, options));
  }
  return figures;
}

}  // namespace restlab
