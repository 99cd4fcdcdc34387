#include "core/scene/textures/hdr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/scene/textures/image_formats.h"

namespace restlab {

namespace {

constexpr size_t kMaxHeaderBytes = size_t(1) << 20;

// Reads the lines of a header: text up to an empty line, then a line with the size.
class Lines {
 public:
  explicit Lines(const std::vector<uint8_t>& bytes)
      : text_(reinterpret_cast<const char*>(bytes.data()),
              std::min(bytes.size(), kMaxHeaderBytes)) {}
  bool next(std::string_view& line) {
    const size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) return false;
    line = text_.substr(at_, end - at_);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    at_ = end + 1;
    return true;
  }
  size_t position() const { return at_; }

 private:
  std::string_view text_;
  size_t at_ = 0;
};

std::string_view nextWord(std::string_view& text) {
  const size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
  const size_t end = std::min(text.find_first_of(" \t", begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

// Parses `count` finite numbers and nothing else.
bool readNumbers(std::string_view text, size_t count, double* numbers) {
  for (size_t i = 0; i < count; ++i) {
    std::string_view word = nextWord(text);
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), numbers[i]);
    if (word.empty() || status != std::errc() || end != word.data() + word.size()) return false;
    if (!std::isfinite(numbers[i])) return false;
  }
  return nextWord(text).empty();
}

// Sets `value` to the text behind `name` if the line begins with it.
bool startsWith(std::string_view line, std::string_view name, std::string_view& value) {
  if (!line.starts_with(name)) return false;
  value = line.substr(name.size());
  return true;
}

std::string readPrimaries(std::string_view line, std::string_view value, HdrHeader& header) {
  double n[8];
  if (!readNumbers(value, 8, n)) return fmt::format("'{}': eight numbers expected", line);
  header.colours.reset();
  bool areZero = true;
  for (const double number : n) areZero = areZero && number == 0.0;
  if (areZero) return "";  // from programs that do not know the primaries
  const Chromaticities colours = {{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
  if (const std::string why = whyNoColours(colours); !why.empty())
    return fmt::format("'{}': {}", line, why);
  header.colours = colours;
  return "";
}

std::string readVariable(std::string_view line, bool& hasFormat, HdrHeader& header) {
  std::string_view value;
  if (startsWith(line, "FORMAT=", value)) {
    const std::string_view format = nextWord(value);
    if (format != "32-bit_rle_rgbe" && format != "32-bit_rle_xyze")
      return fmt::format("'{}': 32-bit_rle_rgbe or 32-bit_rle_xyze expected", line);
    hasFormat = true;
    header.isXyz = format == "32-bit_rle_xyze";
  } else if (startsWith(line, "EXPOSURE=", value)) {
    double factor = 0.0;
    if (!readNumbers(value, 1, &factor) || factor <= 0.0)
      return fmt::format("'{}': a number above 0 expected", line);
    header.exposure *= factor;
  } else if (startsWith(line, "COLORCORR=", value)) {
    double c[3];
    if (!readNumbers(value, 3, c) || c[0] <= 0.0 || c[1] <= 0.0 || c[2] <= 0.0)
      return fmt::format("'{}': three numbers above 0 expected", line);
    header.exposure *= glm::dvec3(c[0], c[1], c[2]);
  } else if (startsWith(line, "PRIMARIES=", value)) {
    return readPrimaries(line, value, header);
  } else if (startsWith(line, "GAMMA=", value)) {
    double gamma = 1.0;
    if (!readNumbers(value, 1, &gamma) || gamma != 1.0)
      header.notes.push_back(fmt::format("'{}' is not read: pixels are taken as linear", line));
  }
  return "";
}

// Parses a sign, an axis and a number of pixels: "-Y 512".
bool readAxis(std::string_view& text, char& sign, char& axis, uint64_t& count) {
  const std::string_view name = nextWord(text), number = nextWord(text);
  if (name.size() != 2 || (name[0] != '+' && name[0] != '-') || (name[1] != 'X' && name[1] != 'Y'))
    return false;
  sign = name[0];
  axis = name[1];
  const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), count);
  return status == std::errc() && end == number.data() + number.size();
}

std::string readSize(std::string_view line, HdrHeader& header) {
  std::string_view rest = line;
  char signs[2], axes[2];
  uint64_t counts[2];
  if (!readAxis(rest, signs[0], axes[0], counts[0]) ||
      !readAxis(rest, signs[1], axes[1], counts[1]) || axes[0] == axes[1] ||
      !nextWord(rest).empty()) {
    return fmt::format("the size is '{}'; two axes as in '-Y 512 +X 1024' expected",
                       line.substr(0, 80));
  }
  header.rowsAreColumns = axes[0] == 'X';
  const size_t x = header.rowsAreColumns ? 0 : 1, y = 1 - x;
  header.isFromBottom = signs[y] == '+';
  header.isFromRight = signs[x] == '-';
  if (std::string problem = checkPixelCount(counts[x], counts[y]); !problem.empty()) return problem;
  header.rows = uint32_t(counts[0]);
  header.rowLength = uint32_t(counts[1]);
  return "";
}

}  // namespace

std::string readHdrHeader(const std::vector<uint8_t>& bytes, HdrHeader& header) {
  Lines lines(bytes);
  std::string_view line;
  if (!lines.next(line) || !line.starts_with("#?")) return "not a Radiance HDR image";
  bool hasFormat = false;
  while (lines.next(line) && !line.empty()) {
    if (std::string problem = readVariable(line.substr(0, 200), hasFormat, header);
        !problem.empty())
      return problem;
  }
  const double least = 1e-30, most = 1e30;
  for (int c = 0; c < 3; ++c) {
    if (!(header.exposure[c] >= least && header.exposure[c] <= most))
      return fmt::format("EXPOSURE and COLORCORR are {:.3g} in all; {} to {} expected",
                         header.exposure[c], least, most);
  }
  if (!lines.next(line)) return "has no line with its size (truncated or corrupt)";
  if (!hasFormat) return "has no line 'FORMAT=32-bit_rle_rgbe' or 'FORMAT=32-bit_rle_xyze'";
  header.pixels = lines.position();
  return readSize(line, header);
}

}  // namespace restlab
