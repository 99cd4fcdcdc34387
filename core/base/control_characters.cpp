#include "core/base/control_characters.h"

#include <fmt/format.h>

#include <cstdint>

namespace restlab {

namespace {

// Returns the length in bytes of the control character that begins at `at`, and sets its number;
// returns 0 if none begins there.
size_t controlAt(const std::string& text, size_t at, uint32_t& number) {
  const auto byte = [&](size_t i) { return i < text.size() ? uint8_t(text[i]) : 0u; };
  number = byte(at);
  if (number < 0x20 || number == 0x7f) return 1;
  if (number != 0xc2 || byte(at + 1) < 0x80 || byte(at + 1) > 0x9f) return 0;
  number = byte(at + 1);
  return 2;
}

template <class Instead>
std::string replaced(const std::string& text, bool keepsLines, const Instead& instead) {
  std::string result;
  result.reserve(text.size());
  for (size_t at = 0; at < text.size();) {
    uint32_t number = 0;
    const size_t bytes = controlAt(text, at, number);
    const bool isKept = bytes == 0 || (keepsLines && (number == '\n' || number == '\t'));
    result += isKept ? text.substr(at, 1) : instead(number);
    at += isKept ? 1 : bytes;
  }
  return result;
}

}  // namespace

std::string withoutControls(const std::string& text, bool keepsLines) {
  return replaced(text, keepsLines, [](uint32_t) { return std::string(" "); });
}

std::string jsonWithoutControls(const std::string& dump) {
  return replaced(dump, true, [](uint32_t number) { return fmt::format("\\u{:04x}", number); });
}

}  // namespace restlab
