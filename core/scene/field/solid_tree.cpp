#include "core/scene/field/solid_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "core/base/error.h"

namespace restlab {

namespace {

// A number of a solid: any, or above 0.
struct SolidNumber {
  const char* name;
  bool isPositive = false;
};

struct SolidForm {
  SolidKind kind;
  const char* name;
  std::vector<SolidNumber> numbers;
  size_t leastParts = 0;
  size_t mostParts = 0;
  bool hasFile = false;
};

constexpr size_t kMany = 64;
constexpr double kMostNumber = 1e6;

const std::vector<SolidForm>& solidForms() {
  static const std::vector<SolidForm> kAll{
      {SolidKind::sphere, "sphere", {{"radius", true}}},
      {SolidKind::box, "box", {{"x", true}, {"y", true}, {"z", true}}},
      {SolidKind::torus, "torus", {{"radius", true}, {"thickness", true}}},
      {SolidKind::capsule, "capsule", {{"height", true}, {"radius", true}}},
      {SolidKind::cylinder, "cylinder", {{"height", true}, {"radius", true}}},
      {SolidKind::plane, "plane", {{"x"}, {"y"}, {"z"}, {"distance"}}},
      {SolidKind::unite, "union", {}, 2, kMany},
      {SolidKind::intersect, "intersection", {}, 2, kMany},
      {SolidKind::subtract, "difference", {}, 2, kMany},
      {SolidKind::smoothUnite, "smooth_union", {{"radius", true}}, 2, kMany},
      {SolidKind::smoothIntersect, "smooth_intersection", {{"radius", true}}, 2, kMany},
      {SolidKind::smoothSubtract, "smooth_difference", {{"radius", true}}, 2, kMany},
      {SolidKind::round, "round", {{"radius", true}}, 1, 1},
      {SolidKind::shell, "shell", {{"thickness", true}}, 1, 1},
      {SolidKind::translate, "translate", {{"x"}, {"y"}, {"z"}}, 1, 1},
      {SolidKind::rotate, "rotate", {{"x"}, {"y"}, {"z"}, {"degrees"}}, 1, 1},
      {SolidKind::scale, "scale", {{"factor", true}}, 1, 1},
      {SolidKind::repeat, "repeat", {{"x"}, {"y"}, {"z"}}, 1, 1},
      {SolidKind::twist, "twist", {{"degrees"}}, 1, 1},
      {SolidKind::displace, "displace", {{"height"}, {"frequency", true}}, 1, 1},
      {SolidKind::grid, "grid", {}, 0, 0, true}};
  return kAll;
}

std::string usageOf(const SolidForm& form) {
  std::vector<std::string> words;
  if (form.hasFile) words.emplace_back("'FILE.vol'");
  for (const SolidNumber& number : form.numbers) words.emplace_back(number.name);
  if (form.mostParts > 0) words.emplace_back("SOLID");
  if (form.mostParts > 1) words.emplace_back("SOLID, ...");
  return fmt::format("{}({})", form.name, fmt::join(words, ", "));
}

class Tree {
 public:
  Tree(const std::string& text, const GridFiles& files) : reader_(text), files_(files) {}

  Solid read() {
    Solid all = solid();
    if (!reader_.isAtEnd()) reader_.fail(reader_.place(), "not expected behind the last solid");
    return all;
  }

 private:
  const SolidForm& form() {
    const size_t begin = reader_.place();
    if (!reader_.isAtName()) reader_.fail(begin, "a solid is missing, as sphere(1)");
    const std::string name = reader_.name();
    std::vector<std::string> names;
    for (const SolidForm& form : solidForms()) {
      if (name == form.name) return form;
      names.emplace_back(form.name);
    }
    reader_.fail(begin, fmt::format("no solid is called '{}': {}{}", name, fmt::join(names, ", "),
                                    didYouMean(name, names)));
  }

  double number(const SolidForm& form, const SolidNumber& wanted) {
    const size_t begin = reader_.place();
    const bool isNegative = reader_.take('-');
    if (!reader_.isAtNumber())
      reader_.fail(begin,
                   fmt::format("the number '{}' of {} is missing", wanted.name, usageOf(form)));
    const double value = isNegative ? -reader_.number() : reader_.number();
    if (std::abs(value) > kMostNumber || (wanted.isPositive && !(value >= 1.0 / kMostNumber)))
      reader_.fail(
          begin,
          fmt::format("'{}' of {} is {:g}: from {:g} to {:g}", wanted.name, usageOf(form), value,
                      wanted.isPositive ? 1.0 / kMostNumber : -kMostNumber, kMostNumber));
    return value;
  }

  Solid solid() {
    const FieldReader::Level level(reader_);
    const size_t begin = reader_.place();
    const SolidForm& form = this->form();
    Solid made;
    made.kind = form.kind;
    reader_.expect('(');
    if (form.hasFile) made.grid = gridFile();
    for (const SolidNumber& wanted : form.numbers) {
      if (&wanted != form.numbers.data()) reader_.expect(',');
      made.numbers.push_back(number(form, wanted));
    }
    while (made.parts.size() < form.mostParts) {
      const bool isFirst = made.numbers.empty() && made.parts.empty();
      if (!isFirst && made.parts.size() >= form.leastParts && reader_.next() == ')') break;
      if (!isFirst) reader_.expect(',');
      made.parts.push_back(solid());
    }
    reader_.expect(')');
    made.span = reader_.since(begin);
    check(made, begin);
    return made;
  }

  std::shared_ptr<const FieldGrid> gridFile() {
    const size_t begin = reader_.place();
    const std::string name = reader_.quoted();
    if (!files_) reader_.fail(begin, "no files are read here");
    auto& grid = grids_[name];
    if (grid) return grid;
    try {
      grid = std::make_shared<const FieldGrid>(files_(name));
    } catch (const Error& error) {
      if (error.code() != ExitCode::badInput) throw;
      reader_.fail(begin, error.what());
    }
    return grid;
  }

  void check(const Solid& made, size_t begin) const {
    const std::vector<double>& n = made.numbers;
    const bool hasAxis = made.kind == SolidKind::plane || made.kind == SolidKind::rotate;
    if (hasAxis && !(glm::length(glm::dvec3(n[0], n[1], n[2])) > 1.0 / kMostNumber))
      reader_.fail(begin, "the direction is 0");
    if (made.kind == SolidKind::repeat &&
        (std::min({n[0], n[1], n[2]}) < 0.0 || !(std::max({n[0], n[1], n[2]}) > 0.0)))
      reader_.fail(begin,
                   "a distance of copies is 0 (no copies) or above, and one of them is above");
  }

  FieldReader reader_;
  const GridFiles& files_;
  std::map<std::string, std::shared_ptr<const FieldGrid>> grids_;
};

SolidBox grown(SolidBox box, double by) {
  box.low -= by;
  box.high += by;
  return box;
}

SolidBox around(double x, double y, double z) {
  return {-glm::dvec3(x, y, z), glm::dvec3(x, y, z)};
}

std::optional<SolidBox> boundsOfParts(const Solid& solid) {
  const bool unites = solid.kind == SolidKind::unite || solid.kind == SolidKind::smoothUnite;
  const bool subtracts =
      solid.kind == SolidKind::subtract || solid.kind == SolidKind::smoothSubtract;
  std::optional<SolidBox> all = boundsOf(solid.parts.front());
  if (subtracts) return all;
  for (size_t i = 1; i < solid.parts.size(); ++i) {
    const std::optional<SolidBox> part = boundsOf(solid.parts[i]);
    if (unites) {
      if (!all || !part) return std::nullopt;
      all = SolidBox{glm::min(all->low, part->low), glm::max(all->high, part->high)};
    } else if (!all) {
      all = part;
    } else if (part) {
      all = SolidBox{glm::max(all->low, part->low), glm::min(all->high, part->high)};
    }
  }
  // A smooth union adds up to a quarter of its radius a part.
  if (all && solid.kind == SolidKind::smoothUnite)
    all = grown(*all, 0.25 * solid.numbers[0] * double(solid.parts.size() - 1));
  return all;
}

SolidBox transformed(const SolidBox& box, const glm::dmat4& by) {
  SolidBox all{glm::dvec3(1e300), glm::dvec3(-1e300)};
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) != 0 ? box.high.x : box.low.x,
                            (i & 2) != 0 ? box.high.y : box.low.y,
                            (i & 4) != 0 ? box.high.z : box.low.z);
    const glm::dvec3 p(by * glm::dvec4(corner, 1.0));
    all = {glm::min(all.low, p), glm::max(all.high, p)};
  }
  return all;
}

}  // namespace

Solid readSolidTree(const std::string& text, const GridFiles& files) {
  return Tree(text, files).read();
}

std::optional<SolidBox> boundsOf(const Solid& solid) {
  const std::vector<double>& n = solid.numbers;
  std::optional<SolidBox> part;
  if (solid.parts.size() == 1) {
    part = boundsOf(solid.parts[0]);
    if (!part) return std::nullopt;
  }
  switch (solid.kind) {
    case SolidKind::sphere:
      return around(n[0], n[0], n[0]);
    case SolidKind::box:
      return around(n[0], n[1], n[2]);
    case SolidKind::torus:
      return around(n[0] + n[1], n[0] + n[1], n[1]);
    case SolidKind::capsule:
      return around(n[1], n[1], 0.5 * n[0] + n[1]);
    case SolidKind::cylinder:
      return around(n[1], n[1], 0.5 * n[0]);
    case SolidKind::grid:
      return SolidBox{solid.grid->insideLow(), solid.grid->insideHigh()};
    case SolidKind::round:
      return grown(*part, n[0]);
    case SolidKind::shell:
      return grown(*part, 0.5 * n[0]);
    case SolidKind::displace:
      return grown(*part, std::abs(n[0]));
    case SolidKind::translate:
      return SolidBox{part->low + glm::dvec3(n[0], n[1], n[2]),
                      part->high + glm::dvec3(n[0], n[1], n[2])};
    case SolidKind::scale:
      return SolidBox{part->low * n[0], part->high * n[0]};
    case SolidKind::rotate:
      return transformed(*part, glm::rotate(glm::dmat4(1.0), glm::radians(n[3]),
                                            glm::normalize(glm::dvec3(n[0], n[1], n[2]))));
    case SolidKind::twist: {
      const glm::dvec2 far =
          glm::max(glm::abs(glm::dvec2(part->low)), glm::abs(glm::dvec2(part->high)));
      const double r = glm::length(far);
      return SolidBox{{-r, -r, part->low.z}, {r, r, part->high.z}};
    }
    case SolidKind::plane:
    case SolidKind::repeat:
      return std::nullopt;
    default:
      return boundsOfParts(solid);
  }
}

}  // namespace restlab
