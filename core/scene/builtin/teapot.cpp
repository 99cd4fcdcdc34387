// The teapot that Martin Newell drew in 1975, on a floor under one lamp: 32 bicubic Bezier pieces,
// met exactly or as triangles. Bodies of revolution are given by their profiles, handle and spout
// by the half on one side. The bottom was added later, by Frank Crow (1987).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/shapes/shape_info.h"
#include "core/scene/splines/mesh_of_surface.h"
#include "core/scene/splines/surface_words.h"

namespace restlab::builtin {
namespace {

using Profile = std::array<glm::dvec2, 4>;  // distance from the axis, height
using Net = std::array<glm::dvec3, 16>;     // u fastest

constexpr std::array<Profile, 6> kProfiles{{
    {{{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}},  // rim
    {{{1.5, 2.4}, {1.75, 1.875}, {2.0, 1.35}, {2.0, 0.9}}},            // body
    {{{2.0, 0.9}, {2.0, 0.45}, {1.5, 0.225}, {1.5, 0.15}}},
    {{{0.0, 3.15}, {0.8, 3.15}, {0.0, 2.85}, {0.2, 2.7}}},  // lid
    {{{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}},
    {{{1.5, 0.15}, {1.5, 0.075}, {1.425, 0.0}, {0.0, 0.0}}},  // bottom
}};
constexpr size_t kLid = 3;

// A tube along x: the lines in its plane, and half its width.
struct TubeRow {
  glm::dvec2 from, to;  // x and height; seen from -y, the outside is at the left of from -> to
  double width;
};
constexpr std::array<std::array<TubeRow, 4>, 4> kTubes{{
    // handle
    {{{{-1.6, 2.025}, {-1.5, 2.25}, 0.3},
      {{-2.3, 2.025}, {-2.5, 2.25}, 0.3},
      {{-2.7, 2.025}, {-3.0, 2.25}, 0.3},
      {{-2.7, 1.8}, {-3.0, 1.8}, 0.3}}},
    {{{{-2.7, 1.8}, {-3.0, 1.8}, 0.3},
      {{-2.7, 1.575}, {-3.0, 1.35}, 0.3},
      {{-2.5, 1.125}, {-2.65, 0.9375}, 0.3},
      {{-2.0, 0.9}, {-1.9, 0.6}, 0.3}}},
    // spout
    {{{{1.7, 1.425}, {1.7, 0.6}, 0.66},
      {{2.6, 1.425}, {3.1, 0.825}, 0.66},
      {{2.3, 2.1}, {2.4, 2.025}, 0.25},
      {{2.7, 2.4}, {3.3, 2.4}, 0.25}}},
    {{{{2.7, 2.4}, {3.3, 2.4}, 0.25},
      {{2.8, 2.475}, {3.525, 2.49375}, 0.25},
      {{2.9, 2.475}, {3.45, 2.5125}, 0.15},
      {{2.8, 2.4}, {3.2, 2.4}, 0.15}}},
}};

std::vector<Net> teapotNets() {
  std::vector<Net> nets;
  constexpr std::array<glm::dvec2, 5> kTurns{{{1, 0}, {0, -1}, {-1, 0}, {0, 1}, {1, 0}}};
  for (size_t profile = 0; profile < kProfiles.size(); ++profile) {
    for (size_t quarter = 0; quarter < 4; ++quarter) {
      const glm::dvec2 a = kTurns[quarter], b = kTurns[quarter + 1];
      Net& net = nets.emplace_back();
      for (size_t j = 0; j < 4; ++j) {
        const glm::dvec2 p = kProfiles[profile][j];
        // Newell's circles; one row of the lid's knob is rounder.
        const double c = profile == kLid && j == 1 ? 0.5625 : 0.56;
        const std::array<glm::dvec2, 4> around{a, a + c * b, c * a + b, b};
        for (size_t i = 0; i < 4; ++i) net[4 * j + i] = {p.x * around[i], p.y};
      }
    }
  }
  for (const auto& rows : kTubes) {
    for (const double side : {-1.0, 1.0}) {
      Net& net = nets.emplace_back();
      for (size_t j = 0; j < 4; ++j) {
        const glm::dvec2 from = side < 0.0 ? rows[j].from : rows[j].to,
                         to = side < 0.0 ? rows[j].to : rows[j].from;
        const double y = side * rows[j].width;
        net[4 * j] = {from.x, 0.0, from.y};
        net[4 * j + 1] = {from.x, y, from.y};
        net[4 * j + 2] = {to.x, y, to.y};
        net[4 * j + 3] = {to.x, 0.0, to.y};
      }
    }
  }
  return nets;
}

}  // namespace

std::vector<BezierGrid> teapotPieces() {
  std::vector<BezierGrid> pieces;
  for (const Net& net : teapotNets())
    pieces.push_back(bezierGrid({{3, 4, clampedKnots(3, 4)},
                                 {3, 4, clampedKnots(3, 4)},
                                 {net.begin(), net.end()},
                                 std::vector<double>(net.size(), 1.0)}));
  return pieces;
}

MeshGeometry teapotMesh(const glm::dmat4& toWorld, double chordError) {
  // One grid for all pieces, so that the edges that they share have the same vertices.
  PieceCells cells;
  const std::vector<BezierGrid> pieces = teapotPieces();
  for (const BezierGrid& piece : pieces) {
    const BezierPiece inScene = transformed(piece.pieces[0], toWorld);
    const auto own = cellsFor(inScene, chordError);
    if (!own) {
      failInput(
          fmt::format("scene 'teapot': 'chord' takes more than {} triangles a piece; {:.2g} "
                      "or more would do",
                      kMostTrianglesOfPiece, 1.1 * leastChordError(inScene)));
    }
    cells = {std::max(cells.u, own->u), std::max(cells.v, own->v)};
  }
  MeshGeometry mesh;
  for (const BezierGrid& piece : pieces) {
    const MeshGeometry part = tessellate(piece, {{cells.u}, {cells.v}});
    append(mesh, part);
    mesh.uvs[0].insert(mesh.uvs[0].end(), part.uvs[0].begin(), part.uvs[0].end());
  }
  mesh.name = "teapot";
  return mesh;
}

Scene makeTeapot(const TeapotShape& shape) {
  if (shape.isExact && shape.chord)
    failInput("scene 'teapot': 'chord' is of triangles; leave it out beside 'as=exact'");
  SceneBuilder scene("teapot");
  const uint32_t floor = scene.addMaterial("floor", lambert({0.55f, 0.52f, 0.48f}));
  scene.add(grid("floor", {-3.0, 0.0, 3.0}, {6.0, 0.0, 0.0}, {0.0, 0.0, -6.0}, 1, 1), floor);
  scene.add(quad("lamp", {-0.9, 2.2, 0.2}, {0.6, 0.0, 0.0}, {0.0, 0.0, 0.6}),
            scene.addMaterial("lamp", lamp({26.0f, 25.0f, 23.0f})));
  scene.addCamera("guest", {0.25, 0.55, 1.15}, {0.02, 0.14, 0.0}, 36.0);
  rl::Material glaze = plastic({0.58f, 0.66f, 0.72f}, 0.12f);
  glaze.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
  const uint32_t china = scene.addMaterial("china", glaze);
  // Newell's units are about a decimetre here; his z points up. The floor is a millimetre below.
  glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.001, 0.0));
  place = glm::rotate(place, glm::radians(25.0), glm::dvec3(0.0, 1.0, 0.0));
  place = glm::rotate(place, glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
  place = glm::scale(place, glm::dvec3(0.1));
  const std::vector<BezierGrid> pieces = teapotPieces();
  if (shape.isExact) {
    for (size_t i = 0; i < pieces.size(); ++i) {
      const std::string name = "piece " + std::to_string(i);
      scene.place(
          name,
          scene.addGeometry(makeShape({findShape("nurbs"), {}, surfaceWords(pieces[i])}, name)),
          china, place);
    }
    return scene.finish();
  }
  SceneCamera camera;
  camera.cameraToWorld[3] = {0.25, 0.55, 1.15, 1.0};
  camera.yfov = glm::radians(36.0);
  double chordError = shape.chord.value_or(1.0);
  if (!shape.chord) {
    for (const BezierGrid& piece : pieces)
      chordError = std::min(chordError, quarterOfPixel(piece, place, {camera}));
  }
  scene.place("teapot", scene.addGeometry(teapotMesh(place, chordError)), china, place);
  return scene.finish();
}

}  // namespace restlab::builtin
