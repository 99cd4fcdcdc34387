// Interface between measurements and the report: one JSON document, with EXR files beside it.
//
// { "schema": 1,
//   "title": text, "question": text?, "generated": text? (UTC), "command": text?,
//   "warnings": [text...]?, "notes": [text...]?,
//   "provenance": [[key, value]...]?                   texts
//   "blocks": [ {
//     "id": text                                       [A-Za-z0-9._-]+, once in the document
//     "title": text, "subtitle": text?,
//     "notes": [text...]?                              notes on all of its rows
//     "part_of": text?                                 id of an earlier block, which lists this one
//     "row_title": text?                               title of the first column; default "method"
//     "columns": [ { "key": text, "title": text, "unit": text?, "help": text?,
//                    "better": "lower" | "higher" | "none"?,
//                    "detail": bool?               true: in a second table
//                    "digits": integer? } ]            significant digits, 1 to 17; default 3
//     "rows": [ { "method": text, "counts": bool?, "warnings": [text...]?, "flags": [text...]?,
//                 "cells": { KEY: { "value": number, "lo": number?, "hi": number?, "note": text?,
//                                  "ranked": bool? } } } ]
//                                                          KEY is a column's; cells may be missing
//     "plots": [ { "id": text                          as a block's, once in the block
//                  "title": text,
//                  "x": { "title": text, "log": bool?, "note": text? },
//                                                   a note is placed behind the title
//                  "y": likewise,
//                  "intervals": "bands" | "bars"?    default "bands"
//                  "series": [ { "name": text,
//                                "points": [[x, y] | [x, y, lo, hi]...]   in order of x
//                                "hollow": [integer...]?    indices of points, from 0
//                                "fit": { "slope": number, "lo": number?, "hi": number?,
//                                         "intercept": number }? } ] } ]?
//     "bars": { "title": text, "unit": text?, "rows": [ { "name": text,
//               "parts": [[name, number]...] } ] }?    numbers of at least 0
//     "settings": [ { "method": text, "text": text } ]?
//     "left_out": [ { "method": text, "features": [text...] } ]?
//     "health": { "columns": [ text | { "name": text, "help": text?, "bad": bool? } ],
//                 "rows": [ { "method": text, "counts": [integer...] } ] }?
//     "images": [ { "name": text, "file": text, "role": "reference" | "method" } ]?
//     "opens_on": text?                                name of an image that is no reference
//     "exposure": number?                              above 0; default 1
//   } ] }
//
// "?" marks an optional member. A number is a JSON number or "nan", "inf", "-inf"; NaN as "lo" or
// "hi" means unknown. `counts` false: the row does not count; default true. `warnings`: why, and
// why else not to trust its numbers; they are always shown, while several notes and `flags` are a
// line that opens. `intervals`: "bars" where nothing was measured between the points. `opens_on`:
// what the block's images show first, beside the reference; default: the first that is no
// reference. `note` is placed behind the number. `ranked` false: the number is not compared with
// other rows and is never the best; default true. A series with the name of a row looks the same in
// all plots of the block. `fit`: log10 y = intercept + slope log10 x if both axes are logarithmic
// (a linear axis enters without its logarithm); lo and hi are the interval of the slope. `hollow`:
// points that the fit leaves out. `bad`: any count above 0 is a fault. `file` is relative to the
// report's folder; the images of a block have one size.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace restlab {

using ReportModel = nlohmann::ordered_json;

constexpr int kReportSchema = 1;

// Throws Error (badInput) naming the first field that is missing, unknown, of the wrong type or
// out of bounds: "report model: blocks[0].rows[1].cells.mse.value: ...".
void checkReportModel(const ReportModel& model);

// Returns a number of a checked model: a JSON number, "nan", "inf" or "-inf".
double reportNumber(const ReportModel& value);

// Returns the number of a member, or `otherwise` if it is missing.
double reportNumber(const ReportModel& object, const char* key, double otherwise);

// Returns the text of a member, or "" if it is missing.
std::string reportText(const ReportModel& object, const char* key);

// Returns the list of a member, or an empty one if it is missing.
const ReportModel& reportList(const ReportModel& object, const char* key);

}  // namespace restlab
