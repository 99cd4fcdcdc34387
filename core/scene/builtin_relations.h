// What can be done to any scene so that its image changes by a known relation.
#pragma once

#include "core/scene/scene.h"

namespace restlab::builtin {

// Everything larger by `factor`: geometry, cameras, lights with it, absorption per metre. The image
// stays the same; with a power of two to the last bit.
void scaleScene(Scene& scene, double factor);

// All light times `factor`: so is the image.
void multiplyRadiance(Scene& scene, double factor);

// Everything elsewhere, along every axis by `sizes` times the longest side of the bounds. Vertices
// of meshes that stand in world space are moved themselves, as by a program that writes a far place
// into its vertices: they are rounded to float there, and that is the only difference.
void moveScene(Scene& scene, double sizes);

// The vertical field of view of every camera.
void setFieldOfView(Scene& scene, double degrees);

}  // namespace restlab::builtin
