#include "experiments/report/report_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <set>
#include <vector>

#include "core/base/error.h"

namespace restlab {
namespace {

// JSON value with its path in the model.
struct Place {
  const ReportModel& json;
  std::string path;
};

[[noreturn]] void failAt(const std::string& path, const std::string& what) {
  failInput(fmt::format("report model: {}: {}", path.empty() ? "the document" : path, what));
}

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

using Names = std::initializer_list<const char*>;

// Requires an object that has every name of `required` and no others except `optional`.
void requireObject(const Place& at, Names required, Names optional) {
  if (!at.json.is_object()) failAt(at.path, "must be an object");
  for (const char* name : required) {
    if (!at.json.contains(name)) failAt(joined(at.path, name), "is missing");
  }
  std::vector<std::string> known(required.begin(), required.end());
  known.insert(known.end(), optional.begin(), optional.end());
  for (const auto& item : at.json.items()) {
    if (std::find(known.begin(), known.end(), item.key()) == known.end()) {
      failAt(joined(at.path, item.key()), "unknown field" + didYouMean(item.key(), known));
    }
  }
}

// Calls check(place) for the member `name`, if it is there.
template <class Check>
void member(const Place& at, const char* name, const Check& check) {
  const auto found = at.json.find(name);
  if (found != at.json.end()) check(Place{*found, joined(at.path, name)});
}

template <class Check>
void forEach(const Place& at, const Check& check) {
  if (!at.json.is_array()) failAt(at.path, "must be a list");
  for (size_t i = 0; i < at.json.size(); ++i) {
    check(Place{at.json[i], fmt::format("{}[{}]", at.path, i)});
  }
}

void text(const Place& at) {
  if (!at.json.is_string()) failAt(at.path, "must be a text");
}

void flag(const Place& at) {
  if (!at.json.is_boolean()) failAt(at.path, "must be true or false");
}

void texts(const Place& at) { forEach(at, text); }

void number(const Place& at) {
  if (at.json.is_number()) return;
  if (at.json == "nan" || at.json == "inf" || at.json == "-inf") return;
  failAt(at.path, R"(must be a number, "nan", "inf" or "-inf")");
}

void oneOf(const Place& at, Names names) {
  for (const char* name : names) {
    if (at.json == name) return;
  }
  failAt(at.path, fmt::format("must be one of {}", fmt::join(names, ", ")));
}

// Requires an id that is unique and can be used unescaped in file names and addresses.
void uniqueId(const Place& at, std::set<std::string>& seen) {
  text(at);
  const std::string id = at.json.get<std::string>();
  const bool plain = !id.empty() && id[0] != '.' &&
                     id.find_first_not_of(
                         "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                         "0123456789._-") == std::string::npos;
  if (!plain) failAt(at.path, "must be of letters, digits, '.', '_', '-' and not start with '.'");
  if (!seen.insert(id).second) failAt(at.path, fmt::format("'{}' is there twice", id));
}

std::set<std::string> columns(const Place& at) {
  std::set<std::string> keys;
  forEach(at, [&](const Place& column) {
    requireObject(column, {"key", "title"}, {"unit", "better", "detail", "digits", "help"});
    member(column, "detail", flag);
    for (const char* name : {"key", "title", "unit", "help"}) member(column, name, text);
    member(column, "better", [](const Place& p) { oneOf(p, {"lower", "higher", "none"}); });
    member(column, "digits", [](const Place& p) {
      if (!p.json.is_number_integer() || p.json < 1 || p.json > 17)
        failAt(p.path, "must be an integer of 1 to 17");
    });
    if (!keys.insert(column.json["key"].get<std::string>()).second) {
      failAt(column.path + ".key", "is there twice");
    }
  });
  return keys;
}

void row(const Place& at, const std::set<std::string>& keys) {
  requireObject(at, {"method", "cells"}, {"counts", "warnings", "flags"});
  member(at, "method", text);
  member(at, "counts", flag);
  for (const char* name : {"warnings", "flags"}) member(at, name, texts);
  const Place cells{at.json["cells"], at.path + ".cells"};
  if (!cells.json.is_object()) failAt(cells.path, "must be an object");
  for (const auto& item : cells.json.items()) {
    const Place cell{item.value(), joined(cells.path, item.key())};
    if (!keys.count(item.key())) failAt(cell.path, "no column has this key");
    requireObject(cell, {"value"}, {"lo", "hi", "note", "ranked"});
    for (const char* name : {"value", "lo", "hi"}) member(cell, name, number);
    member(cell, "note", text);
    member(cell, "ranked", flag);
  }
}

void series(const Place& at) {
  requireObject(at, {"name", "points"}, {"hollow", "fit"});
  member(at, "name", text);
  member(at, "points", [](const Place& points) {
    forEach(points, [](const Place& point) {
      forEach(point, number);
      if (point.json.size() != 2 && point.json.size() != 4) {
        failAt(point.path, "must be [x, y] or [x, y, lo, hi]");
      }
    });
  });
  member(at, "hollow", [&](const Place& places) {
    const size_t points = at.json["points"].size();
    forEach(places, [points](const Place& place) {
      if (!place.json.is_number_integer() || place.json < 0 || place.json >= points)
        failAt(place.path, fmt::format("must be the place of one of {} points, from 0", points));
    });
  });
  member(at, "fit", [](const Place& fit) {
    requireObject(fit, {"slope", "intercept"}, {"lo", "hi"});
    for (const char* name : {"slope", "intercept", "lo", "hi"}) member(fit, name, number);
  });
}

void plots(const Place& at) {
  std::set<std::string> ids;
  forEach(at, [&](const Place& plot) {
    requireObject(plot, {"id", "title", "x", "y", "series"}, {"intervals"});
    member(plot, "id", [&](const Place& p) { uniqueId(p, ids); });
    member(plot, "title", text);
    member(plot, "intervals", [](const Place& p) { oneOf(p, {"bands", "bars"}); });
    for (const char* axis : {"x", "y"}) {
      member(plot, axis, [](const Place& p) {
        requireObject(p, {"title"}, {"log", "note"});
        member(p, "title", text);
        member(p, "note", text);
        member(p, "log", flag);
      });
    }
    member(plot, "series", [](const Place& p) { forEach(p, series); });
  });
}

void bars(const Place& at) {
  requireObject(at, {"title", "rows"}, {"unit"});
  member(at, "title", text);
  member(at, "unit", text);
  forEach({at.json["rows"], at.path + ".rows"}, [](const Place& bar) {
    requireObject(bar, {"name", "parts"}, {});
    member(bar, "name", text);
    forEach({bar.json["parts"], bar.path + ".parts"}, [](const Place& part) {
      if (!part.json.is_array() || part.json.size() != 2)
        failAt(part.path, "must be [name, number]");
      text({part.json[0], part.path + "[0]"});
      number({part.json[1], part.path + "[1]"});
      if (!(reportNumber(part.json[1]) >= 0.0) || std::isinf(reportNumber(part.json[1]))) {
        failAt(part.path + "[1]", "must be a finite number of at least 0");
      }
    });
  });
}

void settings(const Place& at) {
  forEach(at, [](const Place& entry) {
    requireObject(entry, {"method", "text"}, {});
    for (const char* name : {"method", "text"}) member(entry, name, text);
  });
}

void leftOut(const Place& at) {
  forEach(at, [](const Place& entry) {
    requireObject(entry, {"method", "features"}, {});
    member(entry, "method", text);
    member(entry, "features", texts);
  });
}

void health(const Place& at) {
  requireObject(at, {"columns", "rows"}, {});
  forEach({at.json["columns"], at.path + ".columns"}, [](const Place& column) {
    if (column.json.is_string()) return;
    requireObject(column, {"name"}, {"help", "bad"});
    member(column, "name", text);
    member(column, "help", text);
    member(column, "bad", flag);
  });
  const size_t width = at.json["columns"].size();
  forEach({at.json["rows"], at.path + ".rows"}, [&](const Place& entry) {
    requireObject(entry, {"method", "counts"}, {});
    member(entry, "method", text);
    const Place counts{entry.json["counts"], entry.path + ".counts"};
    forEach(counts, [](const Place& count) {
      if (!count.json.is_number_integer() || count.json < 0) {
        failAt(count.path, "must be a whole number of at least 0");
      }
    });
    if (counts.json.size() != width) {
      failAt(counts.path, fmt::format("has {} counts for {} columns", counts.json.size(), width));
    }
  });
}

void images(const Place& at) {
  size_t references = 0;
  forEach(at, [&](const Place& image) {
    requireObject(image, {"name", "file", "role"}, {});
    member(image, "name", text);
    member(image, "file", text);
    member(image, "role", [](const Place& p) { oneOf(p, {"reference", "method"}); });
    const std::string file = image.json["file"].get<std::string>();
    if (file.empty() || file[0] == '/') {
      failAt(image.path + ".file", "must be a path relative to the report's folder");
    }
    if (image.json["role"] == "reference" && ++references > 1) {
      failAt(image.path + ".role", "a block has one reference");
    }
  });
}

void block(const Place& at, std::set<std::string>& ids) {
  requireObject(at, {"id", "title", "columns", "rows"},
                {"subtitle", "notes", "part_of", "row_title", "plots", "bars", "settings",
                 "left_out", "health", "images", "opens_on", "exposure"});
  member(at, "part_of", [&](const Place& p) {
    text(p);
    if (!ids.count(p.json.get<std::string>())) failAt(p.path, "must be the id of an earlier block");
  });
  member(at, "id", [&](const Place& p) { uniqueId(p, ids); });
  member(at, "title", text);
  member(at, "subtitle", text);
  member(at, "notes", texts);
  member(at, "row_title", text);
  const std::set<std::string> keys = columns({at.json["columns"], at.path + ".columns"});
  forEach({at.json["rows"], at.path + ".rows"}, [&](const Place& p) { row(p, keys); });
  member(at, "plots", plots);
  member(at, "bars", bars);
  member(at, "settings", settings);
  member(at, "left_out", leftOut);
  member(at, "health", health);
  member(at, "images", images);
  member(at, "opens_on", [&](const Place& p) {
    text(p);
    const ReportModel& all = reportList(at.json, "images");
    const bool isThere = std::any_of(all.begin(), all.end(), [&](const ReportModel& image) {
      return image["name"] == p.json && image["role"] == "method";
    });
    if (!isThere) failAt(p.path, "must be the name of an image whose role is method");
  });
  member(at, "exposure", [](const Place& p) {
    number(p);
    const double exposure = reportNumber(p.json);
    if (!(exposure > 0.0) || std::isinf(exposure)) failAt(p.path, "must be finite and above 0");
  });
}

}  // namespace

void checkReportModel(const ReportModel& model) {
  const Place all{model, ""};
  requireObject(all, {"schema", "title", "blocks"},
                {"question", "generated", "command", "warnings", "notes", "provenance"});
  if (model["schema"] != kReportSchema) {
    failAt("schema", fmt::format("must be {}", kReportSchema));
  }
  for (const char* name : {"title", "question", "generated", "command"}) member(all, name, text);
  for (const char* name : {"warnings", "notes"}) member(all, name, texts);
  member(all, "provenance", [](const Place& list) {
    forEach(list, [](const Place& pair) {
      texts(pair);
      if (pair.json.size() != 2) failAt(pair.path, "must be [key, value]");
    });
  });
  std::set<std::string> ids;
  forEach({model["blocks"], "blocks"}, [&](const Place& p) { block(p, ids); });
}

double reportNumber(const ReportModel& value) {
  if (value.is_number()) return value.get<double>();
  if (value == "inf") return std::numeric_limits<double>::infinity();
  if (value == "-inf") return -std::numeric_limits<double>::infinity();
  return std::numeric_limits<double>::quiet_NaN();
}

double reportNumber(const ReportModel& object, const char* key, double otherwise) {
  const auto found = object.find(key);
  return found == object.end() ? otherwise : reportNumber(*found);
}

std::string reportText(const ReportModel& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? "" : found->get<std::string>();
}

const ReportModel& reportList(const ReportModel& object, const char* key) {
  static const ReportModel none = ReportModel::array();
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

}  // namespace restlab
