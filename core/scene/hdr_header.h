// The header of a Radiance HDR image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image/chromaticities.h"

namespace restlab {

struct HdrHeader {
  bool isXyz = false;                     // X, Y, Z with an exponent, else R, G, B
  glm::dvec3 exposure{1.0};               // what the file's values were multiplied by, in all
  std::optional<Chromaticities> colours;  // none, or eight zeros: Rec. 709
  uint32_t rows = 0, rowLength = 0;       // as the file has them: rows may be columns
  bool rowsAreColumns = false;            // a row of the file goes from top to bottom, or back
  bool isFromBottom = false, isFromRight = false;
  size_t pixels = 0;  // where they begin
  std::vector<std::string> notes;

  uint32_t width() const { return rowsAreColumns ? rows : rowLength; }
  uint32_t height() const { return rowsAreColumns ? rowLength : rows; }
};

// Returns "" or what is wrong.
std::string readHdrHeader(const std::vector<uint8_t>& bytes, HdrHeader& header);

}  // namespace restlab
