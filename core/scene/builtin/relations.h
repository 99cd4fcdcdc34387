// Changes to a scene whose effect on the image is known exactly.
#pragma once

#include "core/scene/scene.h"

namespace restlab::builtin {

// Scales everything by `factor`: geometry, cameras, lights accordingly, absorption per metre. The
// image stays the same, bit for bit if `factor` is a power of two.
void scaleScene(Scene& scene, double factor);

// Multiplies all light, and so the image, by `factor`.
void multiplyRadiance(Scene& scene, double factor);

// Moves everything along every axis by `sizes` times the longest side of the bounds. Vertices of
// meshes that stand in world space are moved themselves, as a program does that writes far
// coordinates into its vertices: the rounding of these to float is the only difference.
void moveScene(Scene& scene, double sizes);

// Sets the vertical field of view of every camera.
void setFieldOfView(Scene& scene, double degrees);

}  // namespace restlab::builtin
