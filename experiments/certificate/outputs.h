// Output of certificates: text, JSON, maps and a page.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/certificate/certify.h"

namespace restlab::certificate {

std::string textOf(const Certified& certified);
// Returns one line: "equivalent door-ajar, restir_gi unbiased: +0.04 % [-0.15, +0.22]".
std::string lineOf(const Certified& certified);
nlohmann::ordered_json jsonOf(const Certified& certified);
// Returns further statements on error, cells and health, one sentence each.
std::vector<std::string> detailsOf(const Certified& certified);
// Returns a markdown table, one row per certificate.
std::string markdownOf(const std::vector<Certified>& all);

// Returns the summary of a suite: verdicts counted by declared class, methods declared unbiased but
// found biased, and tables of all verdicts with one row per method and up to three scenes side by
// side. "" without certificates.
std::string suiteMarkdownOf(const std::vector<Certified>& all, const Rules& rules,
                            const std::string& command);

// Writes DIR/certificates.json and .md, DIR/maps/LABEL-bias.exr (runs' mean minus reference, with
// the layers "mean", "reference" and "p_value" of the pixel's cell), PNGs of both maps and
// DIR/report.html. Removes maps of earlier certificates. `table`: text of certificates.md. Throws
// Error (badInput) if a file cannot be written.
void writeOutputs(const std::filesystem::path& folder, const std::vector<Certified>& all,
                  const std::string& table, const std::string& command);
// Writes only DIR/certificates.md.
void writeTable(const std::filesystem::path& folder, const std::string& table);

}  // namespace restlab::certificate
