// Text from outside for HTML, SVG and scripts, and numbers as text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace restlab {

// Returns valid UTF-8 without the control characters that XML forbids; anything else becomes
// U+FFFD.
std::string cleanText(std::string_view text);

// Cleans and escapes text for content and quoted attributes of HTML and XML.
std::string escapeMarkup(std::string_view text);

// Returns compact JSON that may stand inside <script>: no '<', '>', '&' and no line separators.
std::string scriptJson(const nlohmann::ordered_json& json);

// Formats with significant digits, including trailing zeros, as in table.md, table.tex and
// report.html: "1.20", "0.0175", "1234". Integers stay as they are; exponents below 1e-4 and from
// 1e6 on; "nan", "inf", "-inf".
constexpr int kDigits = 3;
std::string shortNumber(double value, int digits = kDigits);

// Formats both numbers with just enough digits to tell them apart, at least `digits`; equal numbers
// with `digits`.
std::pair<std::string, std::string> apartNumbers(double a, double b, int digits = kDigits);

// Returns " [lo, hi]"; "unbounded" replaces an infinite end, and appears once if both are infinite;
// "" if an end is unknown.
std::string intervalText(double lo, double hi, int digits = kDigits);

// Describes a ratio with its interval: "2.5x lower [2.3, 2.8]"; below 1 its inverse, "4.0x higher
// [3.8, 4.2]". A lower end that is not positive is no bound: "2.5x lower [unbounded, 2.8]", "4.0x
// higher [3.8, unbounded]". "not known" if the ratio is not positive.
std::string timesText(double value, double lo, double hi, const char* above, const char* below);

// Digits of a mean energy relative to the reference's; the ideal is 1.
constexpr int kEnergyDigits = 4;

// "1 run", "3 runs".
std::string counted(uint64_t number, const char* what);

// 1234567 as "1,234,567".
std::string groupedDigits(uint64_t value);

}  // namespace restlab
