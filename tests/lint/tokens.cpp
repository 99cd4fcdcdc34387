#include "tests/lint/tokens.h"

#include <algorithm>
#include <cctype>

namespace restlab::lint {

namespace {

// Replaces comments by blanks and joins continued lines. Keeps the line count: the newlines removed
// by joining follow the joined line.
std::string withoutComments(const std::string& text) {
  std::string out;
  int swallowed = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "//") == 0) {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (text.compare(i, 2, "/*") == 0) {
      const size_t end = std::min(text.find("*/", i + 2), text.size());
      for (; i < end; ++i) {
        if (text[i] == '\n') out += '\n';
      }
      ++i;
      out += ' ';
      continue;
    }
    if (i >= text.size()) break;
    if (text.compare(i, 2, "\\\n") == 0) {
      ++swallowed;
      ++i;
      out += ' ';
      continue;
    }
    out += text[i];
    if (text[i] == '\n') {
      out.append(size_t(swallowed), '\n');
      swallowed = 0;
    }
  }
  return out;
}

bool isWordStart(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)); }

// Returns the length of the preprocessing number that starts at `at`.
size_t numberLength(const std::string& text, size_t at) {
  size_t end = at;
  while (end < text.size()) {
    const char c = text[end];
    const bool isExponentSign = (c == '+' || c == '-') && end > at &&
                                (text[end - 1] == 'e' || text[end - 1] == 'E') &&
                                text.compare(at, 2, "0x") != 0;
    if (!isWordStart(c) && !isDigit(c) && c != '.' && !isExponentSign) break;
    ++end;
  }
  return end - at;
}

}  // namespace

TokenizedFile tokenize(const std::string& path, const std::string& text) {
  TokenizedFile file{path, {}, {}};
  const std::string clean = withoutComments(text);
  int line = 1;
  bool atLineStart = true;
  for (size_t i = 0; i < clean.size();) {
    const char c = clean[i];
    if (c == '\n') {
      ++line;
      ++i;
      atLineStart = true;
    } else if (std::isspace(static_cast<unsigned char>(c))) {
      ++i;
    } else if (c == '#' && atLineStart) {
      const size_t end = std::min(clean.find('\n', i), clean.size());
      file.directives.push_back({clean.substr(i, end - i), line});
      i = end;
    } else if (isWordStart(c)) {
      size_t end = i;
      while (end < clean.size() && (isWordStart(clean[end]) || isDigit(clean[end]))) ++end;
      file.tokens.push_back({TokenKind::identifier, clean.substr(i, end - i), line});
      i = end;
      atLineStart = false;
    } else if (isDigit(c) || (c == '.' && i + 1 < clean.size() && isDigit(clean[i + 1]))) {
      const size_t length = numberLength(clean, i);
      file.tokens.push_back({TokenKind::number, clean.substr(i, length), line});
      i += length;
      atLineStart = false;
    } else {
      file.tokens.push_back({TokenKind::punctuation, std::string(1, c), line});
      ++i;
      atLineStart = false;
    }
  }
  return file;
}

std::vector<TokenRange> statements(const TokenizedFile& file) {
  std::vector<TokenRange> result;
  size_t first = 0;
  for (size_t i = 0; i <= file.tokens.size(); ++i) {
    const bool isEnd = i == file.tokens.size() || file.tokens[i].text == ";" ||
                       file.tokens[i].text == "{" || file.tokens[i].text == "}";
    if (!isEnd) continue;
    if (i > first) result.push_back({first, i});
    first = i + 1;
  }
  return result;
}

}  // namespace restlab::lint
