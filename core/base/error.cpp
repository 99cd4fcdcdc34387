#include "core/base/error.h"

#include <algorithm>
#include <cctype>
#include <numeric>

#include "core/base/control_characters.h"

namespace restlab {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Edits (insert, delete, replace, swap of neighbours) that turn `a` into `b`, ignoring case.
size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> beforePrevious(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  std::iota(previous.begin(), previous.end(), size_t(0));
  for (size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replace = previous[j - 1] + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replace});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1])) {
        current[j] = std::min(current[j], beforePrevious[j - 2] + 1);
      }
    }
    std::swap(beforePrevious, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

}  // namespace

std::string oneLine(std::string text) { return withoutControls(text, false); }

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  // Up to a third of the letters may differ: "cornel" finds "cornell-box" only as a prefix.
  constexpr size_t kLongestCompared = 256;
  if (name.empty() || name.size() > kLongestCompared) return "";
  const size_t allowed = std::max<size_t>(1, name.size() / 3);
  std::string best;
  size_t bestDistance = allowed + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongestCompared) continue;
    size_t distance = editDistance(name, candidate);
    // A correct prefix counts as one edit, however much is missing.
    if (name.size() >= 3 && candidate.size() > name.size() &&
        std::equal(name.begin(), name.end(), candidate.begin(),
                   [](char a, char b) { return lower(a) == lower(b); })) {
      distance = std::min<size_t>(distance, 1);
    }
    if (distance < bestDistance) {
      bestDistance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string didYouMean(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearestName(name, candidates);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace restlab
