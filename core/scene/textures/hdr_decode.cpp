// Radiance HDR: rows of pixels with a common exponent, run-length coded in either of two ways.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scene/textures/hdr_header.h"
#include "core/scene/textures/image_formats.h"

namespace restlab {
namespace {

using Rgbe = std::array<uint8_t, 4>;

// Returns the fewest bytes of a row: rows may be flat or have runs of one of two kinds.
uint64_t fewestBytes(uint64_t length) {
  const uint64_t flat = 4 * length;
  // Older runs: a pixel, and marks that repeat it 255, 255 * 256, ... times.
  const uint64_t old = length <= 1 ? 4 : length <= 256 ? 8 : 12;
  return std::min(flat, old);
}

class RowReader {
 public:
  RowReader(const std::vector<uint8_t>& bytes, size_t at) : bytes_(bytes), at_(at) {}

  // Returns "" or what is wrong.
  std::string read(std::vector<Rgbe>& row) {
    // A row of newer runs begins with the bytes 2, 2 and its length; no writer makes such a pixel.
    const size_t length = row.size();
    const bool hasRuns = length >= 8 && length < 32768 && bytes_.size() - at_ >= 4 &&
                         bytes_[at_] == 2 && bytes_[at_ + 1] == 2 && bytes_[at_ + 2] < 128;
    if (!hasRuns) return readFlat(row);
    const size_t said = size_t(bytes_[at_ + 2]) << 8 | bytes_[at_ + 3];
    if (said != length)
      return fmt::format("says it has {} pixels, the image has {} a row", said, length);
    at_ += 4;
    return readRuns(row);
  }

 private:
  // Reads pixels, among them marks (1, 1, 1, n) that repeat the last pixel n times. Consecutive
  // marks are digits to base 256, lowest first.
  std::string readFlat(std::vector<Rgbe>& row) {
    uint32_t shift = 0;
    for (size_t x = 0; x < row.size();) {
      if (bytes_.size() - at_ < 4) return kTruncated;
      Rgbe pixel;
      std::copy_n(bytes_.begin() + std::ptrdiff_t(at_), 4, pixel.begin());
      at_ += 4;
      if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
        row[x++] = pixel;
        shift = 0;
        continue;
      }
      if (x == 0) return "begins with a run, and has no pixel to repeat";
      const uint64_t count = shift < 32 ? uint64_t(pixel[3]) << shift : row.size();
      if (count > row.size() - x) return tooLong(count, x, row.size());
      std::fill_n(row.begin() + std::ptrdiff_t(x), count, row[x - 1]);
      x += count;
      shift += 8;
    }
    return "";
  }

  // Reads each component separately: a byte above 128 and one to repeat, or a count and that many
  // bytes.
  std::string readRuns(std::vector<Rgbe>& row) {
    for (size_t c = 0; c < 4; ++c) {
      for (size_t x = 0; x < row.size();) {
        if (at_ >= bytes_.size()) return kTruncated;
        const uint8_t code = bytes_[at_++];
        const bool isRun = code > 128;
        const size_t count = isRun ? code & 127u : code;
        if (count == 0) return "has a run of no pixels";
        if (count > row.size() - x) return tooLong(count, x, row.size());
        if (bytes_.size() - at_ < (isRun ? 1 : count)) return kTruncated;
        for (size_t i = 0; i < count; ++i) row[x + i][c] = bytes_[at_ + (isRun ? 0 : i)];
        at_ += isRun ? 1 : count;
        x += count;
      }
    }
    return "";
  }

  static std::string tooLong(uint64_t count, size_t x, size_t length) {
    return fmt::format("has a run of {} pixels from pixel {} on, and {} pixels in all", count, x,
                       length);
  }

  static constexpr const char* kTruncated = "truncated";

  const std::vector<uint8_t>& bytes_;
  size_t at_;
};

// Decodes RGBE: mantissas in units of 1/256, exponent to base 2 with a bias of 128.
glm::dvec3 valueOf(const Rgbe& pixel) {
  if (pixel[3] == 0) return glm::dvec3(0.0);
  return glm::dvec3(pixel[0], pixel[1], pixel[2]) * std::ldexp(1.0, int(pixel[3]) - (128 + 8));
}

// Returns the matrix from the file's values to radiance.
glm::dmat3 matrixOf(const HdrHeader& header) {
  const glm::dmat3 exposed(1.0 / header.exposure.x, 0, 0, 0, 1.0 / header.exposure.y, 0, 0, 0,
                           1.0 / header.exposure.z);
  if (header.isXyz) return toRec709(kCieXyz) * exposed;
  if (header.colours && !isRec709(*header.colours)) return toRec709(*header.colours) * exposed;
  return exposed;
}

std::vector<std::string> notesOf(const HdrHeader& header) {
  std::vector<std::string> notes = header.notes;
  if (header.isXyz) {
    notes.push_back(
        "X, Y, Z are converted to Rec. 709 as they are; Radiance's own programs mean cd/m^2, which "
        "are W/(sr m^2) with --environment-scale 0.0055866");
  } else if (header.colours && !isRec709(*header.colours)) {
    notes.push_back("colours are converted to Rec. 709 from " + textOf(*header.colours));
  }
  return notes;
}

}  // namespace

std::string checkHdrHeader(const std::vector<uint8_t>& bytes, ImageSize& size) {
  HdrHeader header;
  if (std::string problem = readHdrHeader(bytes, header); !problem.empty()) return problem;
  size = {header.width(), header.height()};
  return checkFileSize(bytes.size(), header.rows * fewestBytes(header.rowLength), size);
}

std::string decodeHdr(const std::vector<uint8_t>& bytes, DecodedHdr& image) {
  ImageSize size;
  if (std::string problem = checkHdrHeader(bytes, size); !problem.empty()) return problem;
  HdrHeader header;
  readHdrHeader(bytes, header);
  const glm::dmat3 matrix = matrixOf(header);
  image.width = size.width;
  image.height = size.height;
  image.pixels.resize(size_t(size.width) * size.height);
  image.isConverted = header.isXyz || header.colours.has_value();
  image.notes = notesOf(header);
  RowReader reader(bytes, header.pixels);
  std::vector<Rgbe> row(header.rowLength);
  for (uint32_t j = 0; j < header.rows; ++j) {
    if (const std::string problem = reader.read(row); !problem.empty())
      return problem == "truncated" ? problem : fmt::format("row {} {}", j, problem);
    for (uint32_t i = 0; i < header.rowLength; ++i) {
      uint32_t x = header.rowsAreColumns ? j : i, y = header.rowsAreColumns ? i : j;
      if (header.isFromRight) x = image.width - 1 - x;
      if (header.isFromBottom) y = image.height - 1 - y;
      image.pixels[size_t(y) * image.width + x] = glm::vec3(matrix * valueOf(row[i]));
    }
  }
  return "";
}

}  // namespace restlab
