#pragma once

namespace restlab {

// Stage of a pipeline that runs a kernel. The raster stages call rasterCorner() and
// rasterFragment() instead of kernelMain() (core/raster/raster.h).
enum class GlslStage { compute, vertex, fragment };

}  // namespace restlab
