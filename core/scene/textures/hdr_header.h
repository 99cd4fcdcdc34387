// The header of a Radiance HDR image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image/io/chromaticities.h"

namespace restlab {

struct HdrHeader {
  bool isXyz = false;                     // X, Y, Z with an exponent, not R, G, B
  glm::dvec3 exposure{1.0};               // product of all factors on the file's values
  std::optional<Chromaticities> colours;  // absent, or eight zeros in the file: Rec. 709
  uint32_t rows = 0, rowLength = 0;       // order of the file: rows may be columns
  bool rowsAreColumns = false;            // a row of the file runs vertically
  bool isFromBottom = false, isFromRight = false;
  size_t pixels = 0;  // offset of the first pixel, bytes
  std::vector<std::string> notes;

  uint32_t width() const { return rowsAreColumns ? rows : rowLength; }
  uint32_t height() const { return rowsAreColumns ? rowLength : rows; }
};

// Returns "" or what is wrong.
std::string readHdrHeader(const std::vector<uint8_t>& bytes, HdrHeader& header);

}  // namespace restlab
