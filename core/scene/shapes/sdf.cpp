#include "core/base/config.h"
#include "core/scene/field/shape.h"
#include "core/scene/field/solid.h"

namespace restlab {

ShapeInfo sdfShape() {
  ShapeInfo info = fieldShape();
  info.summary = "a solid made of others by their signed distances: 'tree'";
  const auto example = [](const std::string& name, const std::string& text) {
    return ShapeExample{name, {}, fieldWords(readSolid(text))};
  };
  info.examples = {example("sdf_sphere", "sphere(1)"),
                   example("sdf_dumbbell",
                           "smooth_union(0.3, translate(-0.5, 0, 0, sphere(0.45)), "
                           "translate(0.5, 0.1, 0, rotate(0, 0, 1, 30, box(0.4, 0.3, 0.35))))")};
  info.read = [](const ConfigTable& table, ShapeGeometry& shape) {
    if (!table.has("tree"))
      table.fail("",
                 "an sdf [[shape]] has no 'tree', as \"difference(box(1, 1, 1), sphere(1.2))\"");
    const auto box = readFieldBox(table);
    const std::string text = table.getString("tree", "");
    readField(table, "tree", shape, [&] { return readSolid(text, box); });
  };
  return info;
}

}  // namespace restlab
