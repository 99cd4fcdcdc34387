#include "core/scene/mitsuba/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace restlab::mitsuba {

Parameters::Parameters(const Element& element, const Context& context)
    : element_(element), context_(context) {
  std::set<std::string> names;
  for (const Element& child : element.children) {
    children_.push_back(&context.document.resolve(child));
    if (!child.name.empty() && !names.insert(child.name).second)
      context.report.fail(child.place, fmt::format("'{}' is given twice", child.name));
  }
}

const Element* Parameters::find(const std::string& name) {
  for (size_t i = 0; i < children_.size(); ++i) {
    if (element_.children[i].name != name) continue;
    read_.insert(i);
    return children_[i];
  }
  return nullptr;
}

std::string Parameters::placeOf(const std::string& name) {
  const Element* child = find(name);
  return child == nullptr ? element_.place : child->place;
}

void Parameters::fail(const std::string& name, const std::string& text) {
  context_.report.fail(placeOf(name), text);
}

double Parameters::number(const std::string& name, double fallback, double lo, double hi) {
  const Element* child = find(name);
  if (child == nullptr) return fallback;
  if (child->tag != "float" && child->tag != "integer")
    fail(name, fmt::format("'{}' is a <{}>; <float> expected", name, child->tag));
  const double value = parseNumber(valueOf(*child, context_.report), child->place, context_.report);
  if (!(value >= lo && value <= hi))
    fail(name, fmt::format("'{}' is {:g}; {:g} to {:g} expected", name, value, lo, hi));
  return value;
}

int64_t Parameters::integer(const std::string& name, int64_t fallback, int64_t lo, int64_t hi) {
  const double value = number(name, double(fallback), double(lo), double(hi));
  if (value != std::floor(value))
    fail(name, fmt::format("'{}' is {:g}; a whole number expected", name, value));
  return int64_t(value);
}

bool Parameters::boolean(const std::string& name, bool fallback) {
  const Element* child = find(name);
  if (child == nullptr) return fallback;
  const std::string& value = valueOf(*child, context_.report);
  if (child->tag != "boolean" || (value != "true" && value != "false"))
    fail(name, fmt::format("'{}' is <{}> '{}'; <boolean> true or false expected", name, child->tag,
                           value));
  return value == "true";
}

std::string Parameters::text(const std::string& name, const std::string& fallback) {
  const Element* child = find(name);
  if (child == nullptr) return fallback;
  if (child->tag != "string")
    fail(name, fmt::format("'{}' is a <{}>; <string> expected", name, child->tag));
  return valueOf(*child, context_.report);
}

std::string Parameters::choice(const std::string& name, const std::string& fallback,
                               const std::vector<std::string>& choices) {
  const std::string value = text(name, fallback);
  if (std::find(choices.begin(), choices.end(), value) == choices.end())
    fail(name,
         fmt::format("'{}' is '{}'; one of {} expected", name, value, fmt::join(choices, ", ")));
  return value;
}

glm::dvec3 Parameters::vector(const std::string& name, const glm::dvec3& fallback) {
  const Element* child = find(name);
  return child == nullptr ? fallback : vectorOf(*child, context_.report);
}

glm::dmat4 Parameters::transform(const std::string& name, bool isPlanar) {
  const Element* child = find(name);
  return child == nullptr ? glm::dmat4(1.0) : transformOf(*child, isPlanar, context_.report);
}

glm::dvec3 Parameters::color(const std::string& name, const glm::dvec3& fallback,
                             Quantity quantity) {
  const Element* child = find(name);
  if (child == nullptr) return fallback;
  if (!isColor(*child))
    fail(name, fmt::format("'{}' is a <{}>; <rgb> or <spectrum> expected", name, child->tag));
  glm::dvec3 color = colorOf(*child, quantity, context_.files, context_.report);
  const glm::dvec3 given = color;
  const double most = quantity == Quantity::reflectance ? 1.0 : 1e12;
  color = glm::clamp(color, 0.0, most);
  if (color != given)
    context_.report.warn(
        "range of a colour", child->place,
        fmt::format("'{}' is ({:g}, {:g}, {:g}); it is drawn as ({:g}, {:g}, {:g})", name, given.x,
                    given.y, given.z, color.x, color.y, color.z));
  return color;
}

std::vector<const Element*> Parameters::plugins(const std::string& tag) {
  std::vector<const Element*> found;
  for (size_t i = 0; i < children_.size(); ++i) {
    if (children_[i]->tag != tag) continue;
    read_.insert(i);
    found.push_back(children_[i]);
  }
  return found;
}

void Parameters::ignore(std::initializer_list<const char*> names) {
  for (const char* name : names) find(name);
}

void Parameters::finish() {
  for (size_t i = 0; i < children_.size(); ++i) {
    if (read_.count(i) != 0) continue;
    const Element& child = element_.children[i];
    const std::string what = child.name.empty() ? fmt::format("<{}>", children_[i]->tag)
                                                : fmt::format("parameter '{}'", child.name);
    context_.report.warn(
        fmt::format("parameter of {}", element_.type), child.place,
        fmt::format("{} of {} '{}' is not read", what, element_.tag, element_.type));
  }
}

}  // namespace restlab::mitsuba
