#include "experiments/certificate/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/base/control_characters.h"
#include "core/image/io/atomic_file.h"
#include "experiments/report/report_html.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"

namespace restlab::certificate {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Suffixes of the names of maps, after the label.
constexpr const char* kMaps[] = {"-bias.exr",      "-bias.png", "-p.png",     "-mean.exr",
                                 "-reference.exr", "-p.exr",    "-signed.exr"};

Image differenceOf(const Image& a, const Image& b) {
  Image result = a;
  for (size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] -= b.pixels[i];
  return result;
}

// Maps p-values of luminance, before Holm's correction; 1 for cells that are equal without noise,
// -1 for untested ones. Skips the whole-image test.
Image pValues(const Certified& certified) {
  const Image& mean = certified.mean;
  const stats::BlockGrid grid(mean.width, mean.height);
  Image map(mean.width, mean.height, glm::vec3(-1.0f));
  for (const stats::CellVerdict& v : certified.certificate.cells.cells) {
    if (v.quantity != stats::Quantity::luminance || v.wholeImage) continue;
    const float p = v.testable ? float(v.welch.pValue) : v.equal ? 1.0f : -1.0f;
    for (uint32_t y = grid.rowBegin(v.area.y); y < grid.rowBegin(v.area.y + v.area.size); ++y)
      for (uint32_t x = grid.columnBegin(v.area.x); x < grid.columnBegin(v.area.x + v.area.size);
           ++x)
        map.at(x, y) = glm::vec3(p);
  }
  return map;
}

// Colours brighter pixels orange, darker ones blue; saturated at a tenth of the image's mean.
Image signedColours(const Image& difference, const Image& reference) {
  double sum = 0.0;
  for (const glm::vec3& p : reference.pixels)
    sum += stats::quantityOf(p, stats::Quantity::luminance);
  const double full = std::max(0.1 * sum / double(reference.pixels.size()), 1e-30);
  Image picture(difference.width, difference.height);
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    const auto d = std::clamp(
        float(stats::quantityOf(difference.pixels[i], stats::Quantity::luminance) / full), -1.0f,
        1.0f);
    picture.pixels[i] = d > 0.0f ? glm::vec3(d, 0.15f * d, 0.0f) : glm::vec3(0.0f, -0.3f * d, -d);
  }
  return picture;
}

// Colours p = 1 black, p <= 1e-4 yellow, untested cells grey.
Image pColours(const Image& pValues) {
  Image picture(pValues.width, pValues.height);
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    const float p = pValues.pixels[i].x;
    const float size = std::min(1.0f, -std::log10(std::max(p, 1e-30f)) / 4.0f);
    picture.pixels[i] = p < 0.0f ? glm::vec3(0.2f) : glm::vec3(size, 0.7f * size, 0.05f * size);
  }
  return picture;
}

void writeMaps(const fs::path& folder, const Certified& certified) {
  const Image& reference = certified.reference.mean;
  LayeredImage file;
  file.layers[""] = differenceOf(certified.mean, reference);
  file.layers["mean"] = certified.mean;
  file.layers["reference"] = reference;
  file.layers["p_value"] = pValues(certified);
  file.metadata = provenanceWords();
  file.metadata["kind"] = "bias";
  file.metadata["method"] = certified.name;
  file.frame.origin = reference.origin;
  writeExr(folder / (certified.label + "-bias.exr"), file);
  writePng(folder / (certified.label + "-bias.png"), signedColours(file.layers[""], reference),
           1.0f, file.metadata);
  writePng(folder / (certified.label + "-p.png"), pColours(file.layers["p_value"]), 1.0f,
           file.metadata);
  // Write each image that the page compares into a file of its own.
  const auto writeOne = [&](const char* what, const Image& image) {
    LayeredImage one;
    one.layers[""] = image;
    one.metadata = file.metadata;
    one.frame = file.frame;
    writeExr(folder / fmt::format("{}-{}.exr", certified.label, what), one);
  };
  writeOne("mean", certified.mean);
  writeOne("reference", reference);
  writeOne("p", pColours(file.layers["p_value"]));
  writeOne("signed", signedColours(file.layers[""], reference));
}

// Removes the maps of the certificates that the folder's certificates.json lists, and no other
// files.
void removeMaps(const fs::path& folder) {
  std::ifstream in(folder / "certificates.json");
  const Json document = Json::parse(in, nullptr, /*allow_exceptions=*/false);
  if (!document.is_object() || !document.contains("certificates")) return;
  for (const Json& one : document["certificates"]) {
    if (!one.is_object() || !one.contains("label") || !one["label"].is_string()) continue;
    const std::string label = one["label"].get<std::string>();
    if (label != safeFileName(label)) continue;
    std::error_code status;  // maps that cannot be removed stay
    for (const char* what : kMaps) fs::remove(folder / "maps" / (label + what), status);
  }
}

Json intervalCell(const Interval& i) {
  const auto number = [](double v) -> Json {
    if (std::isnan(v)) return "nan";
    if (std::isinf(v)) return v > 0.0 ? "inf" : "-inf";
    return v;
  };
  return {{"value", number(100.0 * i.value)},
          {"lo", number(100.0 * i.lo)},
          {"hi", number(100.0 * i.hi)},
          {"ranked", false}};
}

Interval only(double value) { return {value, std::nan(""), std::nan("")}; }

Json blockOf(size_t index, const Certified& certified) {
  const Certificate& c = certified.certificate;
  Json rows = Json::array();
  for (const ImageBias& b : c.image) {
    rows.push_back({{"method", stats::quantityName(b.quantity)},
                    {"cells",
                     {{"bias", intervalCell(b.isNormal ? b.bias : only(b.bias.value))},
                      {"detectable", intervalCell(only(b.detectable))}}}});
  }
  const std::string replay = certified.replay.empty() ? "" : " A pixel: " + certified.replay;
  return {
      {"id", fmt::format("certificate-{}", index)},
      {"title", fmt::format("{}: {}", certified.name, verdictName(c.verdict))},
      {"subtitle",
       fmt::format("{}. {}{}{}", c.reason, certified.how,
                   c.moreRuns ? fmt::format(" About {} more runs would decide.", *c.moreRuns) : "",
                   replay)},
      {"notes", detailsOf(certified)},
      {"row_title", "quantity"},
      {"columns",
       {{{"key", "bias"},
         {"title", "bias"},
         {"unit", "%"},
         {"help", "of the image's mean, relative to the reference, with its 95 % interval"},
         {"better", "none"}},
        {{"key", "detectable"},
         {"title", "smallest found"},
         {"unit", "%"},
         {"help", "bias that a test of the image at 5 % finds nine times out of ten"},
         {"better", "none"}}}},
      {"rows", rows},
      {"images",
       {{{"name", "mean of the runs"},
         {"file", "maps/" + certified.label + "-mean.exr"},
         {"role", "method"}},
        {{"name", "bias (orange brighter, blue darker, full at a tenth of the mean)"},
         {"file", "maps/" + certified.label + "-signed.exr"},
         {"role", "method"}},
        {{"name", "p of the cells (black 1, yellow 1e-4)"},
         {"file", "maps/" + certified.label + "-p.exr"},
         {"role", "method"}},
        {{"name", "reference"},
         {"file", "maps/" + certified.label + "-reference.exr"},
         {"role", "reference"}}}}};
}

}  // namespace

void writeTable(const fs::path& folder, const std::string& table) {
  writeTextFile(folder / "certificates.md", withoutControls(table, true));
}

void writeOutputs(const fs::path& folder, const std::vector<Certified>& all,
                  const std::string& table, const std::string& command) {
  removeMaps(folder);
  makeWritableDirectory(folder / "maps");
  Json certificates = Json::array(), blocks = Json::array(), notes = Json::array();
  for (const Certified& certified : all) {
    writeMaps(folder / "maps", certified);
    certificates.push_back(jsonOf(certified));
    blocks.push_back(blockOf(blocks.size(), certified));
    for (const std::string& note : certified.notes) notes.push_back(certified.name + ": " + note);
  }
  writeTextFile(
      folder / "certificates.json",
      jsonWithoutControls(
          Json({{"schema", 1}, {"command", command}, {"certificates", certificates}}).dump(2)) +
          "\n");
  writeTable(folder, table);
  Json provenance = Json::array();
  for (const auto& [key, value] : provenanceWords()) provenance.push_back({key, value});
  writeReport(folder, {{"schema", kReportSchema},
                       {"title", all.size() == 1 ? "Certificate of bias" : "Certificates of bias"},
                       {"question", "Is the mean of the method the reference?"},
                       {"generated", utcNow()},
                       {"command", command},
                       {"notes", notes},
                       {"provenance", provenance},
                       {"blocks", blocks}});
}

}  // namespace restlab::certificate
