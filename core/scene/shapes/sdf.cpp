#include "core/base/config.h"
#include "core/scene/field/grid_file.h"
#include "core/scene/field/shape.h"
#include "core/scene/field/solid.h"

namespace restlab {

namespace {

// Distances to the unit sphere, 32 cells along each axis.
FieldProgram gridOfSphere() {
  constexpr int kSamples = 33;
  constexpr double kReach = 1.125;
  SampledGrid grid{glm::ivec3(kSamples), glm::dvec3(-kReach), glm::dvec3(kReach), {}};
  for (int i = 0; i < kSamples * kSamples * kSamples; ++i) {
    const glm::dvec3 at(i % kSamples, i / kSamples % kSamples, i / (kSamples * kSamples));
    const glm::dvec3 p = at * (2.0 * kReach / (kSamples - 1)) - kReach;
    grid.values.push_back(static_cast<float>(glm::length(p) - 1.0));
  }
  return readSolid("grid('sphere')", {}, [&](const std::string&) { return FieldGrid(grid); });
}

}  // namespace

ShapeInfo sdfShape() {
  ShapeInfo info = fieldShape();
  info.summary = "a solid made of others by their signed distances: 'tree'";
  const auto example = [](const std::string& name, const std::string& text) {
    return ShapeExample{name, {}, fieldWords(readSolid(text))};
  };
  info.examples = {example("sdf_sphere", "sphere(1)"),
                   example("sdf_dumbbell",
                           "smooth_union(0.3, translate(-0.5, 0, 0, sphere(0.45)), "
                           "translate(0.5, 0.1, 0, rotate(0, 0, 1, 30, box(0.4, 0.3, 0.35))))"),
                   ShapeExample{"grid_sphere", {}, fieldWords(gridOfSphere())}};
  info.read = [](const ConfigTable& table, const ShapeFiles& files, ShapeGeometry& shape) {
    if (!table.has("tree"))
      table.fail("",
                 "an sdf [[shape]] has no 'tree', as \"difference(box(1, 1, 1), sphere(1.2))\"");
    const auto box = readFieldBox(table);
    const std::string text = table.getString("tree", "");
    const auto grid = [&](const std::string& name) {
      return FieldGrid(readGrid(files(name, "grid", kMostGridBytes).bytes, name));
    };
    readField(table, "tree", shape, [&] { return readSolid(text, box, grid); });
  };
  return info;
}

}  // namespace restlab
