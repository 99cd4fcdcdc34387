// Text of others inside HTML, SVG and scripts.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace restlab {

// Valid UTF-8 without the control characters that XML forbids; what is neither becomes U+FFFD.
std::string cleanText(std::string_view text);

// Clean text for content and quoted attributes of HTML and XML.
std::string escapeMarkup(std::string_view text);

// Compact JSON that may stand inside <script>: no '<', '>', '&' and no line separators.
std::string scriptJson(const nlohmann::ordered_json& json);

// Three significant digits, as tables have them; "nan", "inf", "-inf".
std::string shortNumber(double value);

// " [lo, hi]", " [unbounded]", or "" where an end is unknown.
std::string intervalText(double lo, double hi);

// 1234567 as "1,234,567".
std::string groupedDigits(uint64_t value);

}  // namespace restlab
