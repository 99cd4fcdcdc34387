// The makers of the built-in scenes, one file each; builtin.cpp registers them.
#pragma once

#include <optional>

#include "core/scene/scene.h"
#include "core/scene/splines/bezier.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab::builtin {

Scene makeCornellBox();
Scene makeDoorAjar();
// `lamps`: about so many squares, 1 to 500,000.
Scene makeManyLights(int lamps);
Scene makeGlossyGallery();
Scene makeGlass();
Scene makeCourse();
Scene makeCourtyard();
struct FurnaceShape {
  double albedo = 0.5;
  double height = 1.0;         // factor on all heights
  double gap = 0.8;            // between the block and the floor, m (before `height`)
  std::optional<double> wall;  // thickness of the wall to a room 10^6 times as bright, m
};
Scene makeFurnace(const FurnaceShape& shape);
// Lambert if `roughness` is not given, else metal of reflectance 1.
Scene makeSphereFurnace(std::optional<double> roughness);
struct FloorShape {
  double viewDegrees = 45.0;  // between the view and the floor's normal
  double slopeDegrees = 0.0;  // slope of its normal map
  double triangles = 2.0;     // approximate number; 0: no floor
  double needle = 1.0;        // length of a triangle over its width
  uint32_t copies = 1;        // number of floors in one plane
  double sun = 1.0;           // radiance of one pixel of the sky
  uint32_t spots = 0;         // number of spots, which replace the sky
  std::optional<double> ior;  // index of a slab of smooth glass in place of the floor
};
Scene makeFloor(const FloorShape& shape);
struct QuadLightShape {
  double edge = 1.0;       // factor on the light's edges, at constant power
  double triangles = 2.0;  // approximate number of the light's triangles
  double ratio = 1.0;      // radiance of one triangle over the others', at constant power
  // Half side of a black ground under the floor, lit by a sun from below, m.
  std::optional<double> ground = std::nullopt;
  std::optional<double> stray = std::nullopt;  // distance of a small black triangle, m
};
Scene makeQuadLight(const QuadLightShape& shape);

// One of each shape (core/scene/shapes/shape_info.h, namedShapes()).
Scene makeShapes();
// A shape, or a fine mesh of it, that emits 1/2 and reflects 1/2, in a uniform environment of
// radiance 1.
Scene makeShapeFurnace(const NamedShape& shape, bool isMesh);
// A ball on a floor; `representation` is an index into sphereRepresentations().
Scene makeBall(size_t representation);
// "sphere", then others: examples of kinds, a mesh.
const std::vector<std::string>& sphereRepresentations();

// A surface on which a function is 0, and a solid made of others; indices into the names.
Scene makeImplicit(size_t surface);
const std::vector<std::string>& implicitSurfaces();
Scene makeSdf(size_t solid);
const std::vector<std::string>& solids();

struct HairShape {
  uint32_t count = 2000;  // strands
  bool isMesh = false;    // tubes of triangles
};
Scene makeHair(const HairShape& hair);

struct MediaShape {
  double overlap = 0.001;  // overlap of the two bodies, m
  int priority = 0;        // priority of the farther body; the nearer, smaller one has 0
};
Scene makeMedia(const MediaShape& shape);

struct TeapotShape {
  bool isExact = false;         // rays meet the surface, and not triangles
  std::optional<double> chord;  // chord error of the triangles, m; a quarter of a pixel without it
};
Scene makeTeapot(const TeapotShape& shape);
// Its 32 pieces in Newell's units, z up, normals to the outside.
std::vector<BezierGrid> teapotPieces();
// Its triangles in Newell's units; `chordError` holds under the transform, or as close as
// kMostTrianglesOfPiece triangles a piece come.
MeshGeometry teapotMesh(const glm::dmat4& toWorld, double chordError);

}  // namespace restlab::builtin
