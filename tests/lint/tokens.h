// A tokenizer just sharp enough for the rules of the kernel dialect.
#pragma once

#include <string>
#include <vector>

namespace restlab::lint {

enum class TokenKind { identifier, number, punctuation };

struct Token {
  TokenKind kind;
  std::string text;
  int line;  // from 1
};

// A preprocessor line, continuation lines joined, comments removed.
struct Directive {
  std::string text;
  int line;
};

struct TokenizedFile {
  std::string path;  // relative to the repository
  std::vector<Token> tokens;
  std::vector<Directive> directives;
};

// Comments and string literals give no tokens; punctuation is one character a token.
TokenizedFile tokenize(const std::string& path, const std::string& text);

// [first, last) ranges of tokens between ';', '{' and '}'. The three clauses of a `for` are three.
struct TokenRange {
  size_t first, last;
};
std::vector<TokenRange> statements(const TokenizedFile& file);

}  // namespace restlab::lint
