// Errors, warnings and notes of the Mitsuba reader: `file:line:column: what is wrong; what would be
// right`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/memory.h"

namespace restlab::mitsuba {

class Report {
 public:
  // Throws Error (badInput). `place` is "file:line:column", or a file's name.
  [[noreturn]] void fail(const std::string& place, const std::string& text) const;

  // Add a line. The first few of one `kind` are kept, the rest become one line.
  void warn(const std::string& kind, const std::string& place, const std::string& text);
  void note(const std::string& kind, const std::string& place, const std::string& text);

  // Checks that `bytes` bytes fit into memory before they are taken.
  void takeMemory(const std::string& what, uint64_t bytes) { memory_.take(what, bytes); }

  std::vector<std::string> warnings() const { return warnings_.all(); }
  std::vector<std::string> notes() const { return notes_.all(); }

 private:
  class Lines {
   public:
    explicit Lines(size_t shown) : shown_(shown) {}
    void add(const std::string& kind, const std::string& line);
    std::vector<std::string> all() const;

   private:
    struct Kind {
      std::vector<std::string> lines;
      size_t count = 0;
    };
    size_t shown_;
    std::map<std::string, size_t> indexOfKind_;
    std::vector<Kind> kinds_;
  };
  Lines warnings_{4}, notes_{2};
  MemoryGuard memory_;
};

}  // namespace restlab::mitsuba
