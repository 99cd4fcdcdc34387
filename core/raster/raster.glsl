// Both stages of the raster pipeline: the place of a corner on the film, and whether a fragment is
// part of a surface.

RL_FN bool rasterIsParallel() { return gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC; }

// Point of a pixel that is looked at.
RL_FN vec2 rasterFilmPoint(RL_IN(uvec2) pixel) {
  if (gParams.raster.isAtCentre != 0u) return vec2(float(pixel.x) + 0.5f, float(pixel.y) + 0.5f);
  return cameraFilmPoint(pixel, cameraFilmBits(pixel));
}

// Clip depth over w. Perspective: the inverse distance, whose floats are as fine far away as near.
RL_FN float rasterDepth(float along) {
  if (!rasterIsParallel()) return gParams.raster.nearest / along;
  vec3 camera = gFrame.camera.posW;
  return 1.0f - along / ((length(camera) + gParams.raster.reach) * 1.01f);
}

// Projects a point. The film moves by the frame's film sample, the same in all pixels: samplers of
// pixels look at their centres.
RL_FN vec4 rasterClip(RL_IN(vec3) posW) {
  Camera camera = gFrame.camera;
  vec3 d = posW - camera.posW;
  float along = dot(d, camera.forwardW);
  float w = rasterIsParallel() ? 1.0f : along;
  vec2 offset = rasterFilmPoint(uvec2(0u, 0u));
  float x = (dot(d, camera.rightW) - camera.shiftX * w) / camera.halfWidth;
  float y = (camera.shiftY * w - dot(d, camera.upW)) / camera.halfHeight;
  x += w * (1.0f - 2.0f * offset.x) / float(gFrame.width);
  y += w * (1.0f - 2.0f * offset.y) / float(gFrame.height);
  float z = rasterIsParallel() ? rasterDepth(along) : gParams.raster.nearest;
  return vec4(x, y, z, w);
}

// Corner of the box of a shape: two triangles a side. Sides that face the camera are left out, so
// that each pixel asks the shape once, also from inside the box.
RL_FN vec3 rasterBoxCorner(uint instance, uint primitive, uint corner) {
  vec3 low = recordVec3(RL_EARLIER_UVEC4(gBuffers.raster.boxes, instance * 2u));
  vec3 high = recordVec3(RL_EARLIER_UVEC4(gBuffers.raster.boxes, instance * 2u + 1u));
  uint axis = primitive >> 2u;
  bool isHigh = (primitive & 2u) != 0u;
  Camera camera = gFrame.camera;
  vec3 beyond = isHigh ? high - camera.posW : camera.posW - low;
  if (rasterIsParallel()) beyond = isHigh ? camera.forwardW : -camera.forwardW;
  float isBehind = axis == 0u ? beyond.x : (axis == 1u ? beyond.y : beyond.z);
  if (!(isBehind > 0.0f)) return low;
  bool isSecond = (primitive & 1u) != 0u;
  bool a = isSecond ? corner != 0u : corner == 1u;
  bool b = isSecond ? corner != 1u : corner == 2u;
  if (axis == 0u) return vec3(isHigh ? high.x : low.x, a ? high.y : low.y, b ? high.z : low.z);
  if (axis == 1u) return vec3(a ? high.x : low.x, isHigh ? high.y : low.y, b ? high.z : low.z);
  return vec3(a ? high.x : low.x, b ? high.y : low.y, isHigh ? high.z : low.z);
}

// Weights of the second and third corner at a corner of one of the edge x edge parts of a triangle.
// Part (i, j) begins i parts along the first side and j along the second one; those beyond the
// third side stand for the triangles that point the other way.
RL_FN vec2 rasterPartCorner(uint part, uint corner, uint edge) {
  uint i = part % edge;
  uint j = part / edge;
  bool isTurned = i + j >= edge;
  if (isTurned) {
    i = edge - 1u - i;
    j = edge - 1u - j;
  }
  bool isAlong = isTurned ? corner != 1u : corner == 1u;
  bool isAcross = isTurned ? corner != 2u : corner == 2u;
  return vec2(float(i + (isAlong ? 1u : 0u)), float(j + (isAcross ? 1u : 0u))) / float(edge);
}

RL_FN RasterCorner rasterPlace(uint instance, uint part, uint corner) {
  Instance inst = recordInstance(instance);
  Geometry geometry = recordGeometry(inst.geometry);
  RasterCorner place;
  place.primitive = part;
  place.bary = vec2(0.0f, 0.0f);
  place.diffuse = vec3(0.0f, 0.0f, 0.0f);
  place.highlight = vec3(0.0f, 0.0f, 0.0f);
  vec3 posW;
  if (RL_HAS_SHAPES && shapeIs(geometry)) {
    posW = rasterBoxCorner(instance, part, corner);
  } else {
    uint edge = 1u << gParams.raster.divisions;
    place.primitive = part / (edge * edge);
    place.bary = rasterPartCorner(part % (edge * edge), corner, edge);
    uvec3 corners = RL_SCENE_UVEC3(gScene.triangles, geometry.firstTriangle + place.primitive);
    // Weights of 0 and 1 leave a corner as it is, and both triangles of an edge have the same
    // points.
    posW = RL_SCENE_VEC3(gScene.positions, geometry.firstVertex + corners.x) *
               (1.0f - place.bary.x - place.bary.y) +
           RL_SCENE_VEC3(gScene.positions, geometry.firstVertex + corners.y) * place.bary.x +
           RL_SCENE_VEC3(gScene.positions, geometry.firstVertex + corners.z) * place.bary.y;
    if (RL_HAS(RL_FEATURE_INSTANCES) && (inst.flags & RL_INSTANCE_IDENTITY) == 0u)
      posW = surfaceToWorldPoint(inst, posW);
  }
  place.clip = rasterClip(posW);
  return place;
}

// Returns whether the pixel shows the surface. Alpha is decided as for the pixel's ray. A fragment
// of a shape's box becomes the point where that ray meets the shape.
RL_FN bool rasterFragment(RL_IN(uvec2) pixel, RL_INOUT(Hit) hit, RL_INOUT(float) depth) {
  Instance inst = recordInstance(hit.instance);
  uint key = pixel.y * gFrame.width + pixel.x;
  if (gParams.raster.isAtCentre == 0u) key = cameraAlphaKey(cameraFilmBits(pixel));
  bool asks = RL_HAS(RL_FEATURE_ALPHA) && (inst.flags & RL_INSTANCE_ALPHA) != 0u;
  if (!RL_HAS_SHAPES || !shapeIs(recordGeometry(inst.geometry))) {
    if (!asks) return true;
    float alpha = surfaceAlpha(hit);
    return !(alpha < 1.0f) || traceAlphaAccepts(key, hit, alpha);
  }
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  Ray ray = cameraRay(gFrame.camera, rasterFilmPoint(pixel), resolution);
  for (;;) {
    Hit met = hit;
    if (!shapeTrace(inst, recordGeometry(inst.geometry), ray, met)) return false;
    float alpha = 1.0f;
    if (asks) alpha = surfaceAlpha(met);
    ray.tMin = met.t;
    if (alpha < 1.0f && !traceAlphaAccepts(key, met, alpha)) continue;
    hit = met;
    break;
  }
  vec3 posW = ray.origin + ray.dir * hit.t;
  depth = rasterDepth(dot(posW - gFrame.camera.posW, gFrame.camera.forwardW));
  return depth > 0.0f && depth <= 1.0f;
}
