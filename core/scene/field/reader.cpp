#include "core/scene/field/reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/base/error.h"

namespace restlab {

namespace {

constexpr int kMostLevels = 64;
constexpr size_t kShownText = 24;

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

}  // namespace

std::string spanText(std::string_view text, TextSpan span) {
  std::string part(text.substr(span.begin, span.end - span.begin));
  while (!part.empty() && part.back() == ' ') part.pop_back();
  if (part.size() > kShownText) {
    part.resize(kShownText - 3);
    part += "...";
  }
  return part;
}

void FieldReader::skipBlanks() {
  while (at_ < text_.size() &&
         (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
    ++at_;
}

void FieldReader::moveTo(size_t at) {
  at_ = end_ = at;
  skipBlanks();
}

bool FieldReader::take(char c) {
  if (next() != c || isAtEnd()) return false;
  moveTo(at_ + 1);
  return true;
}

void FieldReader::expect(char c) {
  if (!take(c)) fail(at_, fmt::format("'{}' is missing", c));
}

bool FieldReader::isAtNumber() const { return isDigit(next()) || next() == '.'; }
bool FieldReader::isAtName() const { return isLetter(next()); }

double FieldReader::number() {
  double value = 0.0;
  const char* begin = text_.data() + at_;
  const auto [end, status] = std::from_chars(begin, text_.data() + text_.size(), value);
  if (status != std::errc() || !std::isfinite(value) || std::abs(value) > 1e15)
    fail(at_, "not a number of at most 1e15");
  moveTo(at_ + size_t(end - begin));
  return value;
}

std::string FieldReader::name() {
  size_t end = at_;
  while (end < text_.size() && (isLetter(text_[end]) || isDigit(text_[end]))) ++end;
  std::string word(text_.substr(at_, end - at_));
  moveTo(end);
  return word;
}

std::string FieldReader::quoted() {
  const size_t begin = at_;
  const char quote = next();
  if (quote != '\'' && quote != '"') fail(begin, "a name between ' and ' is missing");
  const size_t end = text_.find(quote, begin + 1);
  if (end == std::string_view::npos)
    fail(begin, fmt::format("the {} that ends it is missing", quote));
  std::string word(text_.substr(begin + 1, end - begin - 1));
  moveTo(end + 1);
  return word;
}

void FieldReader::fail(size_t place, const std::string& message) const {
  std::string rest = "the end";
  if (place < text_.size()) rest = fmt::format("'{}'", spanText(text_, {place, text_.size()}));
  failInput(fmt::format("column {}, {}: {}", place + 1, rest, message));
}

FieldReader::Level::Level(FieldReader& reader) : reader_(reader) {
  if (++reader_.depth_ > kMostLevels)
    reader_.fail(reader_.at_, fmt::format("nested deeper than {} levels", kMostLevels));
}

}  // namespace restlab
