// The vertex stage on the CPU: a kernel over the corners of triangles. The including file defines
// rasterCorner().

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint index = pixel.y * RL_ENTRY_ROW + pixel.x;
  uint triangle = index / 3u;
  RasterCorner corner =
      rasterCorner(gBuffers.raster.triangles.data[triangle * 2u],
                   gBuffers.raster.triangles.data[triangle * 2u + 1u], index % 3u);
  if (gParams.raster.hasLight == 0u) {
    gBuffers.raster.corners.data[index] = corner.clip;
    return;
  }
  gBuffers.raster.corners.data[index * 3u] = corner.clip;
  gBuffers.raster.corners.data[index * 3u + 1u] = vec4(corner.diffuse, corner.bary.x);
  gBuffers.raster.corners.data[index * 3u + 2u] = vec4(corner.highlight, corner.bary.y);
}
