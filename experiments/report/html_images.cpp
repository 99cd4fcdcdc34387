// Writes the viewer's container and its data.
#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <utility>

#include "core/base/error.h"
#include "core/image/image.h"
#include "experiments/report/html_parts.h"
#include "experiments/report/pixels.h"
#include "experiments/report/text.h"

namespace restlab::html {
namespace {

Image readImage(const std::filesystem::path& file) {
  LayeredImage read = readExr(file, {ExrLayers::colours, {""}});
  const auto layer = read.layers.find("");
  if (layer == read.layers.end()) {
    failInput(fmt::format("{}: has no R, G, B channels outside named layers", file.string()));
  }
  return std::move(layer->second);
}

std::string extentText(const Image& image, const Crop& crop, size_t limit, bool byError) {
  const std::string kept = "32-bit floats, every bit of the EXR files";
  if (crop.width == image.width && crop.height == image.height) {
    return fmt::format("Whole images, {}x{} pixels: {}.", image.width, image.height, kept);
  }
  return fmt::format(
      "Crop {}x{} at ({}, {}) of {}x{} pixels, {}: {}. This report holds at most {} pixels of an "
      "image; the EXR files hold all.",
      crop.width, crop.height, crop.x, crop.y, image.width, image.height,
      byError ? "where the relative error is largest" : "the centre", kept, groupedDigits(limit));
}

// Adds error and time of the image's row, for its label.
void addNumbers(const ReportModel& block, const ReportModel& name, ReportModel& image) {
  for (const ReportModel& row : block["rows"]) {
    if (row["method"] != name) continue;
    for (const auto& [key, label] : {std::pair("mse", "mse"), {"time_ms", "ms"}}) {
      const auto cell = row["cells"].find(key);
      if (cell == row["cells"].end()) continue;
      const double number = reportNumber((*cell)["value"]);
      if (std::isfinite(number)) image[label] = number;
    }
  }
}

}  // namespace

void writeImages(std::ostream& out, const ReportModel& block, size_t index,
                 const std::filesystem::path& folder, size_t limit) {
  const ReportModel& list = reportList(block, "images");
  if (list.empty()) return;
  std::vector<Image> images;
  std::vector<const Image*> pointers;
  const Image* reference = nullptr;
  images.reserve(list.size());  // keeps the pointers valid
  for (const ReportModel& entry : list) {
    const std::filesystem::path file = folder / reportText(entry, "file");
    const Image& image = images.emplace_back(readImage(file));
    const Image& first = images.front();
    if (image.width != first.width || image.height != first.height) {
      failInput(fmt::format("{}: is {}x{}, the first image of its block is {}x{}", file.string(),
                            image.width, image.height, first.width, first.height));
    }
    pointers.push_back(&image);
    if (entry["role"] == "reference") reference = &image;
  }
  const Image& first = images.front();
  const Crop crop = chooseCrop(pointers, reference, limit);
  ReportModel data = {{"x", crop.x},
                      {"y", crop.y},
                      {"width", crop.width},
                      {"height", crop.height},
                      {"whole", crop.width == first.width && crop.height == first.height},
                      {"exposure", reportNumber(block, "exposure", 1.0)},
                      {"images", ReportModel::array()}};
  const std::string opensOn = reportText(block, "opens_on");
  for (size_t i = 0; i < list.size(); ++i) {
    const bool isThat = list[i]["role"] == "method" && reportText(list[i], "name") == opensOn;
    if (isThat && !data.contains("first")) data["first"] = i;
    data["images"].push_back({{"name", cleanText(reportText(list[i], "name"))},
                              {"role", list[i]["role"]},
                              {"pixels", fmt::format("pixels-{}-{}", index, i)}});
    if (list[i]["role"] == "method") addNumbers(block, list[i]["name"], data["images"].back());
  }
  out << fmt::format(
      "<h3>Images</h3>\n<p class=\"hint\">{}</p>\n"
      "<div class=\"viewer\" role=\"group\" aria-label=\"Images: {}\" data-source=\"images-{}\" "
      "style=\"--ratio: {:.4f}\">"
      "<noscript><p class=\"bad\">The images need JavaScript; the EXR files stand beside this "
      "report.</p></noscript></div>\n"
      "<script type=\"application/json\" id=\"images-{}\">{}</script>\n",
      extentText(first, crop, limit, reference && images.size() > 1),
      escapeMarkup(reportText(block, "title")), index, double(crop.height) / double(crop.width),
      index, scriptJson(data));
  for (size_t i = 0; i < images.size(); ++i) {
    out << fmt::format("<script type=\"application/octet-stream\" id=\"pixels-{}-{}\">", index, i)
        << packPixels(images[i], crop) << "</script>\n";
    images[i] = Image();  // frees the memory early
  }
}

}  // namespace restlab::html
