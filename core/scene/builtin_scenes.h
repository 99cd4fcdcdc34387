// The makers of the built-in scenes, one file each; builtin.cpp names them.
#pragma once

#include <optional>

#include "core/scene/scene.h"

namespace restlab::builtin {

Scene makeCornellBox();
Scene makeDoorAjar();
Scene makeManyLights();
Scene makeGlossyGallery();
Scene makeGlass();
Scene makeCourtyard();
struct FurnaceShape {
  double albedo = 0.5;
  double height = 1.0;         // factor on all heights
  double gap = 0.8;            // between the block and the floor, m (before that factor)
  std::optional<double> wall;  // thickness of the wall to a room 10^6 times as bright, m
};
Scene makeFurnace(const FurnaceShape& shape);
// Lambert without a roughness, else metal that reflects everything.
Scene makeSphereFurnace(std::optional<double> roughness);
struct FloorShape {
  double viewDegrees = 45.0;  // between the view and the floor's normal
  double slopeDegrees = 0.0;  // of its normal map
  double triangles = 2.0;     // about so many; 0: no floor
  double needle = 1.0;        // length of a triangle over its width
  uint32_t copies = 1;        // of the floor, in one plane
  double sun = 1.0;           // radiance of one pixel of the sky
  uint32_t spots = 0;         // instead of the sky
  std::optional<double> ior;  // of a slab of smooth glass, in the floor's place
};
Scene makeFloor(const FloorShape& shape);
struct QuadLightShape {
  double edge = 1.0;       // factor on the light's edges, at constant power
  double triangles = 2.0;  // of the light, about so many
  double ratio = 1.0;      // radiance of one of them over that of the others, at constant power
  // Half the side of a black ground under the floor, which a sun below it lights, m.
  std::optional<double> ground = std::nullopt;
  std::optional<double> stray = std::nullopt;  // distance of a small black triangle, m
};
Scene makeQuadLight(const QuadLightShape& shape);

struct MediaShape {
  double overlap = 0.001;  // of two bodies, m
  int priority = 0;        // of the farther one; the nearer has 0, and is the smaller one
};
Scene makeMedia(const MediaShape& shape);

}  // namespace restlab::builtin
