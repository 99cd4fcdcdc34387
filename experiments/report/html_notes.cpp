// Notes on a report, a block or its rows: one line that opens, and warnings that are always seen.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "experiments/report/html_parts.h"
#include "experiments/report/text.h"

namespace restlab::html {
namespace {

// A flag, and the markup of the names of the rows that have it.
struct Said {
  std::string flag, methods;
};

void say(const ReportModel& row, const char* key, std::vector<Said>& all) {
  const std::string method =
      fmt::format("<span class=\"method\">{}</span>", escapeMarkup(reportText(row, "method")));
  for (const ReportModel& flag : reportList(row, key)) {
    const std::string text = escapeMarkup(flag.get<std::string>());
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const Said& said) { return said.flag == text; });
    if (same == all.end()) {
      all.push_back({text, method});
    } else {
      same->methods += ", " + method;
    }
  }
}

std::vector<std::string> markupOf(const std::vector<Said>& all) {
  std::vector<std::string> notes;
  for (const Said& said : all) notes.push_back(said.methods + ": " + said.flag);
  return notes;
}

}  // namespace

std::string noteList(const std::vector<std::string>& notes) {
  if (notes.empty()) return "";
  std::string list;
  for (const std::string& note : notes) list += fmt::format("<li>{}</li>\n", note);
  list = fmt::format("<ul class=\"flags\">\n{}</ul>\n", list);
  if (notes.size() == 1) return list;
  return fmt::format(
      "<details class=\"notes\"><summary><strong>{} notes</strong><span class=\"first\">: "
      "{}</span></summary>"
      "\n{}</details>\n",
      notes.size(), notes.front(), list);
}

std::string noteList(const ReportModel& texts) {
  std::vector<std::string> notes;
  for (const ReportModel& text : texts) notes.push_back(escapeMarkup(text.get<std::string>()));
  return noteList(notes);
}

std::string rowNotes(const ReportModel& block) {
  std::vector<Said> warnings, flags;
  for (const ReportModel& row : block["rows"]) {
    say(row, "warnings", warnings);
    say(row, "flags", flags);
  }
  std::string list;
  for (const std::string& warning : markupOf(warnings))
    list += fmt::format("<li class=\"no\">{}</li>\n", warning);
  return (list.empty() ? "" : fmt::format("<ul class=\"flags\">\n{}</ul>\n", list)) +
         noteList(markupOf(flags));
}

}  // namespace restlab::html
