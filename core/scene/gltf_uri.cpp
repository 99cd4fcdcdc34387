#include "core/scene/gltf_uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.h"
#include "core/file_reason.h"

namespace restlab::gltf {
namespace fs = std::filesystem;
namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<std::string> percentDecode(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded.push_back(text[i]);
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const int high = hexDigit(text[i + 1]), low = hexDigit(text[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    decoded.push_back(static_cast<char>(high * 16 + low));
    i += 2;
  }
  return decoded;
}

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

// Letters, digits, '+', '-', '.' before the first ':' (RFC 3986); a one-letter scheme is a drive.
bool hasScheme(std::string_view uri) {
  const size_t colon = uri.find(':');
  if (colon == std::string_view::npos) return false;
  return std::all_of(uri.begin(), uri.begin() + static_cast<ptrdiff_t>(colon), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.';
  });
}

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

// What stands where the file should be, or a hint at the name that was meant.
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

DataUri decodeDataUri(std::string_view uri, const std::string& place, const Report& report) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos) {
    report.fail(place, "data URI without a comma; data:<media type>;base64,<data> expected");
  }
  const std::string_view header = uri.substr(5, comma - 5);
  if (header.find(";;") != std::string_view::npos) {
    report.fail(place, "data URI has an empty parameter (';;')");
  }
  constexpr std::string_view kBase64 = ";base64";
  const bool isBase64 =
      header.size() >= kBase64.size() && header.substr(header.size() - kBase64.size()) == kBase64;
  DataUri data;
  data.mediaType = std::string(header.substr(0, header.find(';')));
  const std::string_view text = uri.substr(comma + 1);
  if (isBase64) {
    std::optional<std::vector<uint8_t>> bytes = base64Decode(text);
    if (!bytes) report.fail(place, "data URI holds invalid base64");
    data.bytes = std::move(*bytes);
  } else {
    const std::optional<std::string> bytes = percentDecode(text);
    if (!bytes) report.fail(place, "data URI holds a bad percent escape; %XX expected");
    data.bytes.assign(bytes->begin(), bytes->end());
  }
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
  const std::optional<std::string> name = percentDecode(uri);
  if (!name) report.fail(place, fmt::format("'{}' holds a bad percent escape; %XX expected", uri));
  if (name->find('\0') != std::string::npos) {
    report.fail(place, "file name holds a zero character");
  }
  const fs::path relative = pathFromUtf8(*name).lexically_normal();
  if (relative.is_absolute() || relative.begin() == relative.end() || *relative.begin() == "..") {
    report.fail(
        place, fmt::format("'{}' leaves the scene's directory; only files below it are read", uri));
  }
  const fs::path file = directory / relative;
  if (isRegularFile(file)) return file;
  // Exporters that do not escape: the name holds a literal percent sign. The same rules apply.
  const fs::path verbatim = pathFromUtf8(uri).lexically_normal();
  if (*name != uri && *verbatim.begin() != ".." && isRegularFile(directory / verbatim)) {
    report.warn("unescaped URI", place, fmt::format("'{}' is not percent-escaped", uri));
    return directory / verbatim;
  }
  report.fail(place, missingText(file, *name));
}

}  // namespace restlab::gltf
