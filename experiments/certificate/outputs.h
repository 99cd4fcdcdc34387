// What a certificate leaves: lines for people, JSON, maps and a page.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/certificate/certify.h"

namespace restlab::certificate {

std::string textOf(const Certified& certified);
// One line: "equivalent  door-ajar, restir_gi unbiased: +0.04 % [-0.15, +0.22]".
std::string lineOf(const Certified& certified);
nlohmann::ordered_json jsonOf(const Certified& certified);
// What is said besides of the error, the cells and the health, a sentence each.
std::vector<std::string> detailsOf(const Certified& certified);
// A row a certificate, for documents.
std::string markdownOf(const std::vector<Certified>& all);

// Of a suite: how many of each declared class have which verdict, what is declared unbiased and was
// found biased, and tables of all verdicts, a row a method and up to three scenes beside each
// other. "" of none.
std::string suiteMarkdownOf(const std::vector<Certified>& all, const Rules& rules,
                            const std::string& command);

// DIR/certificates.json and .md, DIR/maps/LABEL-bias.exr (signed difference of the runs' mean to
// the reference, with the layers "mean", "reference" and "p_value", which holds that of the cell)
// and PNGs of both maps, DIR/report.html. Maps of earlier certificates are gone. `table` is the
// text of certificates.md. Throws Error (badInput) where a file cannot be written.
void writeOutputs(const std::filesystem::path& folder, const std::vector<Certified>& all,
                  const std::string& table, const std::string& command);
// DIR/certificates.md alone.
void writeTable(const std::filesystem::path& folder, const std::string& table);

}  // namespace restlab::certificate
