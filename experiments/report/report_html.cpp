#include "experiments/report/report_html.h"

#include <fmt/format.h>

#include <system_error>

#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "experiments/report/assets.h"
#include "experiments/report/html_parts.h"
#include "experiments/report/pixels.h"
#include "experiments/report/script_policy.h"
#include "experiments/report/svg_bars.h"
#include "experiments/report/svg_plot.h"
#include "experiments/report/text.h"

namespace restlab {
namespace {

namespace fs = std::filesystem;

// Returns the content of the page's <script>.
std::string pageScript() {
  return fmt::format("\n(() => {{\n'use strict';\n{}}})();\n", reportScript());
}

// Content-Security-Policy: nothing is fetched and only the page's own script runs.
std::string policy() {
  return fmt::format(
      "default-src 'none'; script-src {}; style-src 'unsafe-inline'; img-src data: blob:; base-uri "
      "'none'; form-action 'none'",
      scriptHash(pageScript()));
}

std::string blockHead(const ReportModel& block) {
  const std::string subtitle = reportText(block, "subtitle");
  return fmt::format(
      "<section class=\"block\" id=\"b-{}\">\n<h2>{}</h2>\n{}{}",
      escapeMarkup(reportText(block, "id")), escapeMarkup(reportText(block, "title")),
      subtitle.empty() ? "" : fmt::format("<p class=\"subtitle\">{}</p>\n", escapeMarkup(subtitle)),
      html::noteList(reportList(block, "notes")));
}

}  // namespace

void writeReport(const fs::path& folder, const ReportModel& model) {
  checkReportModel(model);
  size_t images = 0;
  for (const ReportModel& block : model["blocks"]) images += reportList(block, "images").size();
  const size_t limit = reportPixelLimit(images);

  AtomicFile file(folder / "report.html");
  std::ostream& out = file.stream();
  out << fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{}</title>\n<style>\n",
      policy(), escapeMarkup(reportText(model, "title")));
  out << reportStyle() << "</style>\n</head>\n<body>\n" << html::reportHead(model) << "<main>\n";
  size_t index = 0;
  for (const ReportModel& block : model["blocks"]) {
    out << blockHead(block) << html::resultTable(block);
    html::writeImages(out, block, index++, folder, limit);
    out << html::plotFigures(block) << html::detailTables(block) << html::settingsList(block)
        << html::leftOutList(block) << html::healthTable(block) << "</section>\n";
  }
  out << "</main>\n" << html::reportFoot(model, limit);
  out << "<script>" << pageScript() << "</script>\n</body>\n</html>\n";
  file.commit();
}

void writePlots(const fs::path& folder, const ReportModel& model) {
  checkReportModel(model);
  const fs::path plots = folder / "plots";
  std::error_code status;
  fs::create_directories(plots, status);
  if (status) {
    failInput(fmt::format("{}: cannot be created: {}", plots.string(), status.message()));
  }
  for (const ReportModel& block : model["blocks"]) {
    const std::string id = reportText(block, "id");
    for (const ReportModel& plot : reportList(block, "plots")) {
      writeTextFile(plots / fmt::format("{}-{}.svg", id, reportText(plot, "id")),
                    plotSvg(plotFromModel(block, plot)));
    }
    const auto bars = block.find("bars");
    if (bars == block.end() || (*bars)["rows"].empty()) continue;
    writeTextFile(plots / fmt::format("{}-bars.svg", id), barsSvg(barsFromModel(*bars)));
  }
}

}  // namespace restlab
