#include "core/scene/gltf/uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/base/error.h"
#include "core/base/file_reason.h"

namespace restlab::gltf {
namespace fs = std::filesystem;
namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

struct PercentText {
  std::string decoded;
  bool hasEscape = false;
  bool hasRaw = false;  // percent signs that begin no escape and stay literal
};

PercentText percentDecode(std::string_view text) {
  PercentText result;
  result.decoded.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    const bool isPercent = text[i] == '%', hasRoom = isPercent && i + 2 < text.size();
    const int high = hasRoom ? hexDigit(text[i + 1]) : -1,
              low = hasRoom ? hexDigit(text[i + 2]) : -1;
    if (high < 0 || low < 0) {
      result.hasRaw |= isPercent;
      result.decoded.push_back(text[i]);
      continue;
    }
    result.hasEscape = true;
    result.decoded.push_back(static_cast<char>(high * 16 + low));
    i += 2;
  }
  return result;
}

// Decodes base64 (RFC 4648), padded or not.
std::optional<std::vector<uint8_t>> base64Decode(std::string_view text) {
  static const std::array<int8_t, 256> kValues = [] {
    std::array<int8_t, 256> values{};
    values.fill(-1);
    constexpr std::string_view kAlphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < kAlphabet.size(); ++i) {
      values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<int8_t>(i);
    }
    return values;
  }();
  for (int padding = 0; padding < 2 && !text.empty() && text.back() == '='; ++padding) {
    text.remove_suffix(1);
  }
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  uint32_t bits = 0;
  int bitCount = 0;
  for (const char c : text) {
    const int value = kValues[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    bits = (bits << 6) | static_cast<uint32_t>(value);
    bitCount += 6;
    if (bitCount >= 8) {
      bitCount -= 8;
      bytes.push_back(static_cast<uint8_t>(bits >> bitCount));
    }
  }
  return bytes;
}

// Returns whether the URI has a scheme: letters, digits, '+', '-', '.' before the first ':' (RFC
// 3986). A scheme of one letter is a drive.
bool hasScheme(std::string_view uri) {
  const size_t colon = uri.find(':');
  if (colon == std::string_view::npos) return false;
  return std::all_of(uri.begin(), uri.begin() + static_cast<ptrdiff_t>(colon), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.';
  });
}

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\f' || c == '\r'; }

std::vector<std::string> namesIn(const fs::path& directory) {
  std::vector<std::string> names;
  std::error_code error;
  const fs::path folder = directory.empty() ? fs::path(".") : directory;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    names.push_back(it->path().filename().string());
  }
  std::sort(names.begin(), names.end());  // the order of a directory is not defined
  return names;
}

// Says what is at the path instead of the file, or suggests the name that was meant.
std::string missingText(const fs::path& file, const std::string& uri) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) return fmt::format("file '{}' is a directory", uri);
  if (fs::exists(status)) return fmt::format("file '{}' is not a regular file", uri);
  if (isHidden(error)) return fmt::format("file '{}' {}", uri, unreadableReason(file));
  if (uri.find('\\') != std::string::npos) {
    return fmt::format("file '{}' does not exist; URIs separate folders by '/'", uri);
  }
  return fmt::format("file '{}' does not exist{}", uri,
                     didYouMean(file.filename().string(), namesIn(file.parent_path())));
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
  return text;
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

// Accepts escapes and blanks in base64, as browsers do; their meaning is unambiguous.
std::vector<uint8_t> decodeBase64(std::string_view text, const std::string& place, Report& report) {
  const bool isPlain = std::none_of(text.begin(), text.end(), [](char c) {
    return c == '%' || c == '-' || c == '_' || isSpace(c);
  });
  std::string repaired;
  if (!isPlain) {
    repaired = percentDecode(text).decoded;
    std::erase_if(repaired, isSpace);
    std::replace(repaired.begin(), repaired.end(), '-', '+');
    std::replace(repaired.begin(), repaired.end(), '_', '/');
  }
  std::optional<std::vector<uint8_t>> bytes = base64Decode(isPlain ? text : repaired);
  if (!bytes) report.fail(place, "data URI holds invalid base64");
  if ((isPlain ? text : repaired).size() % 4 != 0) {
    report.warn("base64 padding", place,
                "data URI's base64 is not padded with '=' to a multiple of 4 characters; it is "
                "read as if it were");
  }
  if (!isPlain) {
    report.warn("base64 text", place,
                "data URI holds escapes, blanks or the letters '-' and '_' in its base64; they are "
                "read as what they stand for");
  }
  return std::move(*bytes);
}

bool isRegularFile(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

}  // namespace

bool isDataUri(std::string_view uri) {
  constexpr std::string_view kScheme = "data:";
  return uri.size() >= kScheme.size() &&
         std::equal(kScheme.begin(), kScheme.end(), uri.begin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

DataUri decodeDataUri(std::string_view uri, const std::string& place, Report& report) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos) {
    report.fail(place, "data URI without a comma; data:<media type>;base64,<data> expected");
  }
  const std::string_view header = uri.substr(5, comma - 5);
  if (header.find(";;") != std::string_view::npos) {
    report.fail(place, "data URI has an empty parameter (';;')");
  }
  DataUri data;
  data.mediaType = std::string(trimmed(header.substr(0, header.find(';'))));
  const size_t lastParameter = header.rfind(';');
  const std::string_view encoding =
      lastParameter == std::string_view::npos ? "" : header.substr(lastParameter + 1);
  const std::string_view text = uri.substr(comma + 1);
  if (lowerCase(trimmed(encoding)) == "base64") {
    if (encoding != "base64") {
      report.warn("base64 label", place,
                  fmt::format("data URI says ';{}'; it is read as ';base64'", encoding));
    }
    data.bytes = decodeBase64(text, place, report);
    return data;
  }
  const PercentText bytes = percentDecode(text);
  if (bytes.hasRaw) {
    report.warn(
        "data URI percent", place,
        "data URI holds a percent sign that begins no escape (%XX); it is read as one byte");
  }
  data.bytes.assign(bytes.decoded.begin(), bytes.decoded.end());
  return data;
}

fs::path pathFromUtf8(const std::string& name) {
  return fs::path(std::u8string(name.begin(), name.end()));
}

fs::path resolveUri(const std::string& uri, const fs::path& directory, const std::string& place,
                    Report& report) {
  if (uri.empty()) report.fail(place, "empty URI; a file name or a data URI expected");
  if (hasScheme(uri)) {
    report.fail(place, fmt::format("'{}' is not a relative path; only files below the scene's "
                                   "directory and data URIs are read",
                                   uri));
  }
  const PercentText text = percentDecode(uri);
  const std::string& name = text.decoded;
  if (name.find('\0') != std::string::npos) {
    report.fail(place, "file name holds a zero character");
  }
  const fs::path relative = pathFromUtf8(name).lexically_normal();
  if (relative.is_absolute() || relative.begin() == relative.end() || *relative.begin() == "..") {
    report.fail(
        place, fmt::format("'{}' leaves the scene's directory; only files below it are read", uri));
  }
  const auto warnUnescaped = [&] {
    report.warn("unescaped URI", place,
                fmt::format("'{}' holds a percent sign that is not escaped (%25); it is read as it "
                            "stands",
                            uri));
  };
  const fs::path file = directory / relative;
  if (isRegularFile(file)) {
    if (text.hasRaw) warnUnescaped();
    return file;
  }
  // Some exporters do not escape: what looks like an escape is then part of the name. The same
  // rules apply.
  const fs::path verbatim = pathFromUtf8(uri).lexically_normal();
  if (name != uri && *verbatim.begin() != ".." && isRegularFile(directory / verbatim)) {
    warnUnescaped();
    return directory / verbatim;
  }
  report.fail(place, missingText(file, name));
}

}  // namespace restlab::gltf
