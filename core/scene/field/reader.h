// Reads the texts of fields piece by piece.
#pragma once

#include <string>
#include <string_view>

#include "core/scene/field/builder.h"

namespace restlab {

class FieldReader {
 public:
  explicit FieldReader(std::string_view text) : text_(text) { skipBlanks(); }

  size_t place() const { return at_; }
  bool isAtEnd() const { return at_ == text_.size(); }
  char next() const { return isAtEnd() ? '\0' : text_[at_]; }
  // Takes the character if it is the next one.
  bool take(char c);
  // Fails if it is not the next one.
  void expect(char c);
  bool isAtNumber() const;
  bool isAtName() const;
  double number();
  std::string name();
  // Text between two ' or two ".
  std::string quoted();
  // The span from a place to what was read last.
  TextSpan since(size_t begin) const { return {begin, end_}; }

  // Throws Error (badInput): "column 7, 'sin(x': message".
  [[noreturn]] void fail(size_t place, const std::string& message) const;

  // Levels of nesting, at most 64. One object a level.
  class Level {
   public:
    explicit Level(FieldReader& reader);
    ~Level() { --reader_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    FieldReader& reader_;
  };

 private:
  void skipBlanks();
  void moveTo(size_t at);

  std::string_view text_;
  size_t at_ = 0, end_ = 0;
  int depth_ = 0;
};

// Takes the span out of a text, shortened for a message.
std::string spanText(std::string_view text, TextSpan span);

}  // namespace restlab
