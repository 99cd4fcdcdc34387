#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/scene/curves/curve_words.h"
#include "core/scene/curves/read_curves.h"
#include "core/scene/curves/stand_in.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab {

namespace {

StrandBasis readBasis(const ConfigTable& table) {
  const std::vector<std::string>& names = strandBases();
  const std::string name = table.getChoice("basis", "bspline", names);
  return StrandBasis(std::find(names.begin(), names.end(), name) - names.begin());
}

void takeStrands(const ConfigTable& table, const std::string& place, const Strands& strands,
                 ShapeGeometry& shape) {
  const double error = table.getNumber("error", kStrandError, 1e-4, 1.0);
  shape.words = atPlace(place, [&] { return curveWords(cutStrands(strands, error)); });
}

ShapeExample exampleOf(const std::string& name, const Strands& strands) {
  return {name, {}, curveWords(cutStrands(strands, kStrandError))};
}

// A coil that gets thinner.
Strands coil() {
  Strands strands;
  for (int i = 0; i < 10; ++i)
    strands.points.emplace_back(std::cos(i * 1.1), std::sin(i * 1.1), 0.2 * i - 0.9,
                                0.24 - 0.015 * i);
  strands.counts = {strands.points.size()};
  return strands;
}

// A thick bent wire and a thin straight one through it, a cone from a large ball to a small one.
Strands wires() {
  return {StrandBasis::linear,
          {{-0.8, -0.6, 0, 0.2},
           {0.6, -0.6, 0.1, 0.25},
           {0.5, 0.6, 0, 0.15},
           {-0.7, 0.7, 0.3, 0.2},
           {-0.9, 0.1, -0.9, 0.06},
           {0.9, -0.8, 0.9, 0.06},
           {0, 0, -0.8, 0.4},
           {0, 0.1, 0.8, 0.1}},
          {4, 2, 2}};
}

constexpr uint64_t kMostStrandBytes = uint64_t{1} << 32;

}  // namespace

ShapeInfo curvesShape() {
  ShapeInfo info;
  info.summary = "strands with radii: hair, fibres, wires; 'points' or a 'file' of them";
  info.hasDraws = false;
  info.examples = {
      exampleOf("curves_coil", coil()), exampleOf("curves_wires", wires()),
      exampleOf("curves_sphere", {StrandBasis::linear, {{0, 0, 0, 1}, {0, 0, 0, 1}}, {2}})};
  info.readsFile = true;
  info.read = [](const ConfigTable& table, const ShapeFiles& files, ShapeGeometry& shape) {
    const StrandBasis basis = readBasis(table);
    if (!table.has("file")) {
      takeStrands(table, table.place("points"), readStrands(table, basis), shape);
      return;
    }
    if (table.has("points"))
      table.fail("points", "'points' beside 'file': the points are here or there, not both");
    const NamedFile file =
        files(table.getString("file", ""), table.place("file"), kMostStrandBytes);
    takeStrands(table, file.name, readStrandText(file.bytes, file.name, basis), shape);
  };
  info.isClosed = [](const ShapeGeometry&) { return true; };
  info.isInside = [](const ShapeGeometry& shape, const glm::dvec3& posL) {
    return isInCurves(shape.words, posL);
  };
  info.box = [](const ShapeGeometry& shape) { return boxOfCurves(shape.words); };
  info.standIn = [](const ShapeGeometry& shape) { return tubesOf(shape.words, false); };
  return info;
}

}  // namespace restlab
