#include "core/scene/curves/read_curves.h"

#include <algorithm>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "core/base/error.h"
#include "core/base/memory.h"

namespace restlab {

Strands readStrands(const ConfigTable& table, StrandBasis basis) {
  if (!table.has("points"))
    table.fail("",
               "[[shape]] of kind 'curves' has no 'points', as [[x, y, z, radius], ...], and no "
               "'file' of such lines");
  Strands strands{basis, {}, {}};
  for (const std::vector<double>& p :
       table.getRows("points", 4, -kMostStrandCoordinate, kMostStrandCoordinate)) {
    strands.points.emplace_back(p[0], p[1], p[2], p[3]);
    const std::string fault = faultOfPoint(strands.points.back());
    if (!fault.empty())
      table.fail("points",
                 fmt::format("point {} of 'points': {}", strands.points.size() - 1, fault));
  }
  const std::string key = table.has("strands") ? "strands" : "points";
  size_t total = 0;
  if (key == "strands") {
    for (const int64_t count : table.getIntegers("strands", {}, 1, int64_t(kMostStrandPoints))) {
      strands.counts.push_back(size_t(count));
      total += size_t(count);
    }
  } else {
    strands.counts.push_back(total = strands.points.size());
  }
  if (total != strands.points.size())
    table.fail(key,
               fmt::format("'strands' has the number of points of each strand: their sum is {}, "
                           "and there are {} points",
                           total, strands.points.size()));
  for (const size_t count : strands.counts) {
    const std::string fault = faultOfCount(basis, count);
    if (!fault.empty()) table.fail(key, fault);
  }
  return strands;
}

namespace {

class StrandReader {
 public:
  StrandReader(const std::vector<uint8_t>& bytes, const std::string& file, StrandBasis basis)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), file_(file) {
    strands_.basis = basis;
  }

  Strands read() {
    while (!text_.empty()) {
      ++line_;
      const size_t end = std::min(text_.find('\n'), text_.size());
      readLine(text_.substr(0, end));
      text_.remove_prefix(std::min(end + 1, text_.size()));
    }
    endStrand();
    if (strands_.counts.empty())
      failInput(fmt::format("{}: it has no points; lines of x, y, z and radius expected", file_));
    return std::move(strands_);
  }

 private:
  [[noreturn]] void fail(size_t line, const std::string& text) const {
    failInput(fmt::format("{}:{}: {}", file_, line, text));
  }

  void readLine(std::string_view rest) {
    glm::dvec4 point(0.0);
    int numbers = 0;
    while (true) {
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r"), rest.size()));
      if (rest.empty()) break;
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r"));
      rest.remove_prefix(word.size());
      double value = 0.0;
      const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || stop != word.data() + word.size() || !std::isfinite(value))
        fail(line_, fmt::format("'{}' is not a finite number", word.substr(0, 40)));
      if (numbers == 4) fail(line_, "more than four numbers; x, y, z and radius expected");
      point[numbers++] = value;
    }
    if (numbers == 0) return endStrand();
    if (numbers < 4) fail(line_, fmt::format("{} numbers; x, y, z and radius expected", numbers));
    const std::string fault = faultOfPoint(point);
    if (!fault.empty()) fail(line_, fault);
    if (strands_.points.size() == kMostStrandPoints)
      fail(line_, fmt::format("more than {} points", kMostStrandPoints));
    if (begun_ == strands_.points.size()) beginLine_ = line_;
    memory_.take(file_, 2 * sizeof point);  // a vector that grows holds twice as much
    strands_.points.push_back(point);
  }

  void endStrand() {
    const size_t count = strands_.points.size() - begun_;
    if (count == 0) return;
    const std::string fault = faultOfCount(strands_.basis, count);
    if (!fault.empty()) fail(beginLine_, fault);
    strands_.counts.push_back(count);
    begun_ = strands_.points.size();
  }

  std::string_view text_;
  const std::string& file_;
  Strands strands_;
  MemoryGuard memory_;
  size_t line_ = 0, begun_ = 0, beginLine_ = 0;
};

}  // namespace

Strands readStrandText(const std::vector<uint8_t>& bytes, const std::string& file,
                       StrandBasis basis) {
  return StrandReader(bytes, file, basis).read();
}

}  // namespace restlab
