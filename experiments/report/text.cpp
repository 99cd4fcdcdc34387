#include "experiments/report/text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace restlab {
namespace {

constexpr const char* kReplacement = "\xef\xbf\xbd";

// Returns the length in bytes of the UTF-8 sequence at the start of `text`, or 0 if it is not one
// that XML allows.
size_t sequenceLength(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? uint8_t(text[i]) : 0u; };
  const uint32_t first = byte(0);
  if (first < 0x80) {
    return (first >= 0x20 && first != 0x7f) || first == '\n' || first == '\t' ? 1 : 0;
  }
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return 0;
  uint32_t code = first & (0x7fu >> length);
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0u) != 0x80u) return 0;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  const bool control = code < 0xa0 || code == 0xfffe || code == 0xffff;
  return overlong || surrogate || control || code > 0x10ffff ? 0 : length;
}

template <class Emit>
void forEachCharacter(std::string_view text, const Emit& emit) {
  while (!text.empty()) {
    const size_t length = sequenceLength(text);
    emit(length ? text.substr(0, length) : std::string_view(kReplacement));
    text.remove_prefix(length ? length : 1);
  }
}

}  // namespace

std::string cleanText(std::string_view text) {
  std::string out;
  forEachCharacter(text, [&](std::string_view character) { out += character; });
  return out;
}

std::string escapeMarkup(std::string_view text) {
  std::string out;
  forEachCharacter(text, [&](std::string_view character) {
    switch (character[0]) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += character;
    }
  });
  return out;
}

std::string scriptJson(const nlohmann::ordered_json& json) {
  // ASCII only, to escape U+2028 and U+2029, too.
  const std::string plain = json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string out;
  for (const char c : plain) {
    if (c == '<' || c == '>' || c == '&') {
      out += fmt::format("\\u{:04x}", c);
    } else {
      out += c;
    }
  }
  return out;
}

std::string shortNumber(double value, int digits) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  const bool isReadable = std::abs(value) < 1e6;
  if (isReadable && value == std::round(value)) return fmt::format("{:.0f}", value);
  // fmt's "#" adds one zero too many if no digit follows the point ("123.0").
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%#.*g", digits, value);
  std::string text = buffer.data();
  // Keep all digits before the point: "1234", not "1.23e+03".
  if (isReadable && std::abs(value) >= 1.0 && text.find('e') != std::string::npos)
    return fmt::format("{:.0f}", value);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::pair<std::string, std::string> apartNumbers(double a, double b, int digits) {
  constexpr int kAllDigits = 17;
  while (digits < kAllDigits && a != b && shortNumber(a, digits) == shortNumber(b, digits))
    ++digits;
  return {shortNumber(a, digits), shortNumber(b, digits)};
}

std::string intervalText(double lo, double hi, int digits) {
  if (std::isnan(lo) || std::isnan(hi)) return "";
  const bool isOpen = std::isinf(lo), isOpenAbove = std::isinf(hi);
  if (isOpen && isOpenAbove) return " [unbounded]";
  return fmt::format(" [{}, {}]", isOpen ? "unbounded" : shortNumber(lo, digits),
                     isOpenAbove ? "unbounded" : shortNumber(hi, digits));
}

std::string timesText(double value, double lo, double hi, const char* above, const char* below) {
  if (!(value > 0.0)) return "not known";  // the error is below its reference's noise
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (lo <= 0.0) lo = -kInfinity;
  if (value >= 1.0) return fmt::format("{}x {}{}", shortNumber(value), above, intervalText(lo, hi));
  const auto inverse = [](double end) { return std::isinf(end) ? -end : 1.0 / end; };
  return fmt::format("{}x {}{}", shortNumber(1.0 / value), below,
                     intervalText(inverse(hi), inverse(lo)));
}

std::string counted(uint64_t number, const char* what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

std::string groupedDigits(uint64_t value) {
  std::string digits = std::to_string(value);
  for (size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return digits;
}

}  // namespace restlab
