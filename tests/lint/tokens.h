// Tokenizer that is just precise enough for the rules of the kernel dialect.
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

// Preprocessor line with continuation lines joined and comments removed.
struct Directive {
  std::string text;
  int line;
};

struct TokenizedFile {
  std::string path;  // relative to the repository
  std::vector<Token> tokens;
  std::vector<Directive> directives;
};

// Skips comments and string literals; punctuation is one character per token.
TokenizedFile tokenize(const std::string& path, const std::string& text);

// Ranges [first, last) of tokens between ';', '{' and '}'. The three clauses of a `for` are
// separate.
struct TokenRange {
  size_t first, last;
};
std::vector<TokenRange> statements(const TokenizedFile& file);

}  // namespace restlab::lint
