#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/scene/curves/curve_words.h"
#include "core/scene/curves/read_curves.h"
#include "core/scene/curves/stand_in.h"
#include "tests/fuzz/entries.h"

namespace restlab::fuzz {

// Checks that strands of few pieces have numbers alone, and that their middle is inside.
static void checkStrands(const Strands& strands) {
  std::vector<StrandPiece> cut = cutStrands(strands, 0.5);
  if (cut.size() > 100'000) return;  // no slow inputs
  const std::vector<uint32_t> words = curveWords(std::move(cut));
  const size_t pieces = curvePieces(words);
  for (size_t i = 0; i < pieces && i < 1000; ++i) {
    const StrandPiece piece = curvePiece(words, i);
    if (!std::isfinite(piece.across.x) || !isInCurves(words, glm::dvec3(piece.start)))
      throw std::logic_error("a strand has no inside");
  }
  if (pieces < 1000) tubesOf(words, true);
}

bool readCurves(const uint8_t* bytes, size_t count) {
  if (count == 0) return false;
  const auto basis = StrandBasis(bytes[0] % strandBases().size());
  try {
    checkStrands(readStrandText(std::vector<uint8_t>(bytes + 1, bytes + count), "x.txt", basis));
    return true;
  } catch (const Error& error) {
    if (error.code() != ExitCode::badInput || std::string(error.what()).empty())
      throw std::logic_error(error.what());
    return false;
  }
}

}  // namespace restlab::fuzz
