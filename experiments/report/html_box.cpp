#include "experiments/report/html_box.h"

#include <fmt/format.h>

#include "experiments/report/text.h"

namespace restlab::html {
namespace {

std::string titled(const std::string& help) {
  return help.empty() ? "" : fmt::format(" title=\"{}\"", escapeMarkup(help));
}

}  // namespace

std::string headCell(const Heading& heading) {
  return fmt::format(
      "<th scope=\"col\"{} aria-sort=\"none\" data-better=\"{}\"><button "
      "type=\"button\"{}>{}{}</button></th>",
      heading.isNumber ? " class=\"num\"" : "", heading.better, titled(heading.help),
      escapeMarkup(heading.title),
      heading.unit.empty()
          ? ""
          : fmt::format(" <span class=\"unit\">{}</span>", escapeMarkup(heading.unit)));
}

std::string tableBox(const std::string& cssClass, const std::string& label, const std::string& head,
                     const std::string& body) {
  return fmt::format(
      "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{}\">\n<table "
      "class=\"{}\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>\n</table></div>\n",
      escapeMarkup(label), cssClass, head, body);
}

void SaidOnce::add(const std::string& title, const std::string& help, const std::string& shown) {
  std::string& list = shown.empty() ? zeros_ : values_;
  list += fmt::format("{}<span{}>{}</span>{}{}", list.empty() ? "" : ", ", titled(help),
                      escapeMarkup(title), shown.empty() ? "" : " ", shown);
}

std::string SaidOnce::paragraph() const {
  if (values_.empty() && zeros_.empty()) return "";
  return fmt::format("<p class=\"once\">{}{}{}</p>\n",
                     values_.empty() ? "" : fmt::format("In all rows: {}.", values_),
                     values_.empty() || zeros_.empty() ? "" : " ",
                     zeros_.empty() ? "" : fmt::format("Zero in all rows: {}.", zeros_));
}

}  // namespace restlab::html
