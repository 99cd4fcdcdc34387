// The contract between whoever measures and the report: one JSON document, and EXR files beside it.
//
// { "schema": 1,
//   "title": text, "question": text?, "generated": text? (UTC), "command": text?,
//   "warnings": [text...]?, "notes": [text...]?,
//   "provenance": [[key, value]...]?                   texts
//   "blocks": [ {
//     "id": text                                       [A-Za-z0-9._-]+, once in the document
//     "title": text, "subtitle": text?,
//     "notes": [text...]?                              what is said of all of its rows
//     "part_of": text?                                 id of an earlier block, which lists this one
//     "row_title": text?                               of the first column; "method" by default
//     "columns": [ { "key": text, "title": text, "unit": text?, "help": text?,
//                    "better": "lower" | "higher" | "none"?,
//                    "detail": bool?               true: in a second table
//                    "digits": integer? } ]            that count, 1 to 17; 3 by default
//     "rows": [ { "method": text, "counts": bool?, "flags": [text...]?,
//                 "cells": { KEY: { "value": number, "lo": number?, "hi": number?, "note": text?,
//                                  "ranked": bool? } } } ]
//                                                          KEY is a column's; cells may be missing
//     "plots": [ { "id": text                          as a block's, once in the block
//                  "title": text,
//                  "x": { "title": text, "log": bool?, "note": text? },
//                                                   a note stands behind the title
//                  "y": likewise,
//                  "series": [ { "name": text,
//                                "points": [[x, y] | [x, y, lo, hi]...]   in order of x
//                                "hollow": [integer...]?    places among the points, from 0
//                                "fit": { "slope": number, "lo": number?, "hi": number?,
//                                         "intercept": number }? } ] } ]?
//     "bars": { "title": text, "unit": text?, "rows": [ { "name": text,
//               "parts": [[name, number]...] } ] }?    numbers of at least 0
//     "settings": [ { "method": text, "text": text } ]?
//     "left_out": [ { "method": text, "features": [text...] } ]?
//     "health": { "columns": [ text | { "name": text, "help": text?, "bad": bool? } ],
//                 "rows": [ { "method": text, "counts": [integer...] } ] }?
//     "images": [ { "name": text, "file": text, "role": "reference" | "method" } ]?
//     "exposure": number?                              above 0; 1 by default
//   } ] }
//
// "?" stands after what may be left out. A number is a JSON number or "nan", "inf", "-inf"; a NaN
// "lo" or "hi" is an unknown one. `counts` false: the row does not count, `flags` says why; it is
// true by default. `note` stands behind the number. `ranked` false: the number is not compared with
// those of other rows, and never the best; true by default.
// A series that has the name of a row looks the same in all plots of the block. `fit`: log10 y =
// intercept + slope log10 x where both axes are logarithmic (a linear axis enters without its
// logarithm); lo and hi are the slope's interval. `hollow`: points that the fit leaves out. `bad`:
// any count above 0 is a fault. `file` is relative to the report's folder; the images of a block
// have one size.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace restlab {

using ReportModel = nlohmann::ordered_json;

constexpr int kReportSchema = 1;

// Throws Error (badInput) naming the first field that is missing, unknown, of the wrong type or
// out of bounds: "report model: blocks[0].rows[1].cells.mse.value: ...".
void checkReportModel(const ReportModel& model);

// A number of a checked model: a JSON number, "nan", "inf" or "-inf".
double reportNumber(const ReportModel& value);

// The same for a member that may be missing: then `otherwise`.
double reportNumber(const ReportModel& object, const char* key, double otherwise);

// A text that may be missing: then "".
std::string reportText(const ReportModel& object, const char* key);

// The list of that name, or an empty one.
const ReportModel& reportList(const ReportModel& object, const char* key);

}  // namespace restlab
