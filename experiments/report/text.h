// Text of others inside HTML, SVG and scripts.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace restlab {

// Valid UTF-8 without the control characters that XML forbids; what is neither becomes U+FFFD.
std::string cleanText(std::string_view text);

// Clean text for content and quoted attributes of HTML and XML.
std::string escapeMarkup(std::string_view text);

// Compact JSON that may stand inside <script>: no '<', '>', '&' and no line separators.
std::string scriptJson(const nlohmann::ordered_json& json);

// Significant digits, zeros at the end included, as table.md, table.tex and report.html have them:
// "1.20", "0.0175", "1234"; integers as they are, powers of ten below 1e-4 and from 1e6 on; "nan",
// "inf", "-inf".
constexpr int kDigits = 3;
std::string shortNumber(double value, int digits = kDigits);

// Both numbers with as few digits as tell them apart, at least `digits`; with all where they are
// the same.
std::pair<std::string, std::string> apartNumbers(double a, double b, int digits = kDigits);

// " [lo, hi]"; "unbounded" in the place of an end that is infinite, and once where both are; ""
// where an end is unknown.
std::string intervalText(double lo, double hi, int digits = kDigits);

// A ratio with its interval as words: "2.5x lower [2.3, 2.8]", and of one below 1 its inverse,
// "4.0x higher [3.8, 4.2]". A lower end that is not above 0 is no bound: "2.5x lower [unbounded,
// 2.8]", "4.0x higher [3.8, unbounded]". "not known" where the ratio is not positive.
std::string timesText(double value, double lo, double hi, const char* above, const char* below);

// Digits of a mean energy over that of the reference, whose ideal is 1.
constexpr int kEnergyDigits = 4;

// "1 run", "3 runs".
std::string counted(uint64_t number, const char* what);

// 1234567 as "1,234,567".
std::string groupedDigits(uint64_t value);

}  // namespace restlab
