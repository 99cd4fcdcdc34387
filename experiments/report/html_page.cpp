// Writes head, foot and figures of the page.
#include <fmt/format.h>

#include "experiments/report/html_parts.h"
#include "experiments/report/pixels.h"
#include "experiments/report/svg_bars.h"
#include "experiments/report/svg_plot.h"
#include "experiments/report/text.h"

namespace restlab::html {
namespace {

std::string paragraph(const char* cssClass, const std::string& text) {
  return text.empty() ? "" : fmt::format("<p class=\"{}\">{}</p>\n", cssClass, escapeMarkup(text));
}

// Returns links to the blocks that are part of the block with this id; "": top-level blocks.
std::string linksTo(const ReportModel& blocks, const std::string& whole) {
  std::string links;
  for (const ReportModel& block : blocks) {
    if (reportText(block, "part_of") != whole) continue;
    const std::string id = reportText(block, "id"), parts = linksTo(blocks, id);
    links += fmt::format("<li><a href=\"#b-{}\">{}</a>{}</li>\n", escapeMarkup(id),
                         escapeMarkup(reportText(block, "title")),
                         parts.empty() ? ""
                                       : fmt::format(" <details><summary>its parts</summary>\n"
                                                     "<ul>\n{}</ul></details>",
                                                     parts));
  }
  return links;
}

std::string contents(const ReportModel& blocks) {
  return fmt::format("<nav aria-label=\"Contents\"><ul>\n{}</ul></nav>\n", linksTo(blocks, ""));
}

}  // namespace

std::string plotFigures(const ReportModel& block) {
  std::string figures;
  for (const ReportModel& plot : reportList(block, "plots")) {
    figures += fmt::format("<figure>{}</figure>\n", plotSvg(plotFromModel(block, plot)));
  }
  const auto bars = block.find("bars");
  if (bars != block.end() && !(*bars)["rows"].empty()) {
    figures += fmt::format("<figure>{}</figure>\n", barsSvg(barsFromModel(*bars)));
  }
  return figures.empty() ? "" : fmt::format("<div class=\"figures\">\n{}</div>\n", figures);
}

std::string reportHead(const ReportModel& model) {
  std::string out =
      fmt::format("<header>\n<h1>{}</h1>\n", escapeMarkup(reportText(model, "title")));
  out += paragraph("question", reportText(model, "question"));
  const std::string generated = reportText(model, "generated");
  const std::string command = reportText(model, "command");
  if (!generated.empty() || !command.empty()) {
    out +=
        fmt::format("<p class=\"made\">{}{}</p>\n", escapeMarkup(generated),
                    command.empty() ? "" : fmt::format(" <code>{}</code>", escapeMarkup(command)));
  }
  for (const ReportModel& warning : reportList(model, "warnings"))
    out += paragraph("warning", warning.get<std::string>());
  out += noteList(reportList(model, "notes"));
  if (model["blocks"].size() > 1) out += contents(model["blocks"]);
  return out + "</header>\n";
}

std::string reportFoot(const ReportModel& model, size_t limit) {
  std::string out = "<footer>\n";
  std::string rows;
  for (const ReportModel& pair : reportList(model, "provenance")) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n",
                        escapeMarkup(pair[0].get<std::string>()),
                        escapeMarkup(pair[1].get<std::string>()));
  }
  if (!rows.empty()) {
    out += fmt::format(
        "<details class=\"provenance\"><summary>Provenance</summary>\n<div class=\"scroll\">"
        "<table><tbody>\n{}</tbody></table></div></details>\n",
        rows);
  }
  out += fmt::format(
      "<p>One file, no network: everything that is shown is in it. Images are lossless: whole up "
      "to "
      "{} pixels in this report (a report holds at most {} pixels of an image and about {} in "
      "all), "
      "crops beyond.</p>\n</footer>\n",
      groupedDigits(limit), groupedDigits(kReportImagePixels), groupedDigits(kReportTotalPixels));
  return out;
}

}  // namespace restlab::html
