// Parameters of one plugin by name. It remembers which were read; finish() warns of the others.
#pragma once

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/scene/mitsuba/document.h"
#include "core/scene/mitsuba/values.h"
#include "core/scene/scene.h"

namespace restlab::mitsuba {

// The parts of the reader share it.
struct Context {
  const Document& document;
  Files& files;
  Report& report;
  Scene& scene;
  bool allowsUnknown = false;  // draw what is unknown as mid grey
};

class Parameters {
 public:
  Parameters(const Element& element, const Context& context);

  const Element& element() const { return element_; }
  const std::string& place() const { return element_.place; }

  // The parameter of that name, references resolved; nullptr if it is absent.
  const Element* find(const std::string& name);
  bool has(const std::string& name) { return find(name) != nullptr; }

  // Values; the fallback if the parameter is absent. Ranges are inclusive.
  double number(const std::string& name, double fallback, double lo, double hi);
  int64_t integer(const std::string& name, int64_t fallback, int64_t lo, int64_t hi);
  bool boolean(const std::string& name, bool fallback);
  std::string text(const std::string& name, const std::string& fallback);
  std::string choice(const std::string& name, const std::string& fallback,
                     const std::vector<std::string>& choices);
  glm::dvec3 vector(const std::string& name, const glm::dvec3& fallback);
  glm::dmat4 transform(const std::string& name, bool isPlanar = false);
  // A colour of at least 0. Reflectances above 1 are drawn as 1, with a warning.
  glm::dvec3 color(const std::string& name, const glm::dvec3& fallback, Quantity quantity);

  // Children that are plugins with that tag, references resolved.
  std::vector<const Element*> plugins(const std::string& tag);

  // Marks parameters as read that change nothing here.
  void ignore(std::initializer_list<const char*> names);
  // Warns of what was not read.
  void finish();

  [[noreturn]] void fail(const std::string& name, const std::string& text);

 private:
  std::string placeOf(const std::string& name);
  const Element& element_;
  const Context& context_;
  std::vector<const Element*> children_;  // references resolved
  std::set<size_t> read_;                 // indices of children
};

}  // namespace restlab::mitsuba
