// A measured or computed BRDF: a table of values between whose centres it is interpolated
// (core/scene/closure_table/closure_table.h).
//   p0: colour, angles (0: half, 1: directions); p1: probability of drawing by the cosine, first
//   parameter
#ifdef RL_CLOSURE_DECLARED
info.is("values of a table: measured (MERL), written by restlab bsdf, or simulated",
        "Rusinkiewicz 1998; Matusik et al. 2003");
info.table("file", ".binary of the MERL database, or .exr of restlab bsdf --tabulate");
info.color("color", 1.0, "factor");
#else

// First record and sizes of the table that a surface has.
RL_FN uvec4 tableShape(RL_IN(Bsdf) b) {
  uvec4 q = RL_SCENE_UVEC4(gScene.closureParameters, unpackHalves(vec2(b.p1.y, b.p1.z)));
  return uvec4(q.x, q.y & 0xffffu, q.y >> 16u, q.z & 0xffffu);
}
RL_FN vec4 tableRecord(uint record) {
  return recordVec4(RL_SCENE_UVEC4(gScene.closureParameters, record));
}
RL_FN uint tableCell(RL_IN(uvec4) shape, uint i, uint j, uint k) {
  return shape.x + 2u + (i * shape.z + j) * shape.w + k;
}

RL_FN void tableLoad(RL_INOUT(Bsdf) b, RL_IN(MaterialPoint) at) {
  uvec4 q = RL_SCENE_UVEC4(gScene.closureParameters, at.firstParameter);
  vec3 color = closureColor(at, 1u);
  vec4 diffuse = tableRecord(q.x);
  vec4 specular = tableRecord(q.x + 1u);
  b.p0 = vec4(color, float(q.z >> 16u));
  vec2 ofParameter = packHalves(at.firstParameter);
  b.p1 = vec4(specular.w, ofParameter.x, ofParameter.y, 0.0f);
  b.diffuse = color * vec3(diffuse);
  b.f0 = color * vec3(specular);
  b.f90 = 1.0f;
  b.alpha = diffuse.w;
  if (rlIsBlack(color)) return;
  b.lobes = RL_LOBE_DIFFUSE | RL_LOBE_ROUGH_DIFFUSE;
  if (b.alpha < 0.9f) b.lobes = b.lobes | RL_LOBE_SPECULAR;
}

// Angle from the normal, which float32 resolves near 0.
RL_FN float tableTheta(RL_IN(vec3) wL) { return atan(sqrt(wL.x * wL.x + wL.y * wL.y), wL.z); }

// Coordinates in a table of half vectors, in cells.
RL_FN vec3 tableHalfCells(RL_IN(uvec4) shape, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_IN(vec3) hL) {
  float r = sqrt(hL.x * hL.x + hL.y * hL.y);
  float cosPhi = r > 0.0f ? hL.x / r : 1.0f;
  float sinPhi = r > 0.0f ? hL.y / r : 0.0f;
  float along = (wiL.x * cosPhi + wiL.y * sinPhi) * hL.z - wiL.z * r;
  float across = wiL.y * cosPhi - wiL.x * sinPhi;
  float thetaD = atan(length(wiL - woL), length(wiL + woL));
  float phiD = along == 0.0f && across == 0.0f ? 0.0f : atan(across, along);
  if (phiD < 0.0f) phiD += RL_PI;
  return vec3(sqrt(tableTheta(hL) * (2.0f * RL_INV_PI)) * float(shape.y),
              thetaD * (2.0f * RL_INV_PI) * float(shape.z), phiD * RL_INV_PI * float(shape.w));
}

// Cosine and sine of the azimuth of wo.
RL_FN vec2 tableAzimuth(RL_IN(vec3) woL) {
  float r = sqrt(woL.x * woL.x + woL.y * woL.y);
  return r > 0.0f ? vec2(woL.x / r, woL.y / r) : vec2(1.0f, 0.0f);
}

// Coordinates in a table of directions, in cells.
RL_FN vec3 tableDirectionCells(RL_IN(uvec4) shape, RL_IN(vec3) woL, RL_IN(vec3) wiL) {
  vec2 to = tableAzimuth(woL);
  float across = to.x * wiL.y - to.y * wiL.x;
  float along = to.x * wiL.x + to.y * wiL.y;
  float phi = along == 0.0f && across == 0.0f ? 0.0f : atan(abs(across), along);
  return vec3(tableTheta(woL) * (2.0f * RL_INV_PI) * float(shape.y),
              tableTheta(wiL) * (2.0f * RL_INV_PI) * float(shape.z),
              phi * RL_INV_PI * float(shape.w));
}

// The value at coordinates in cells, linear between centres. wraps: the last axis is a circle.
RL_FN vec3 tableValue(RL_IN(uvec4) shape, RL_IN(vec3) cells, bool wraps) {
  vec3 x = cells - vec3(0.5f, 0.5f, 0.5f);
  vec3 last = vec3(float(shape.y), float(shape.z), float(shape.w)) - vec3(1.0f, 1.0f, 1.0f);
  x.x = clamp(x.x, 0.0f, last.x);
  x.y = clamp(x.y, 0.0f, last.y);
  x.z = wraps ? (x.z < 0.0f ? x.z + last.z + 1.0f : x.z) : clamp(x.z, 0.0f, last.z);
  vec3 low = vec3(min(floor(x.x), last.x - 1.0f), min(floor(x.y), last.y - 1.0f),
                  min(floor(x.z), wraps ? last.z : last.z - 1.0f));
  vec3 share = x - low;
  uvec3 cell = uvec3(uint(low.x), uint(low.y), uint(low.z));
  uint next = cell.z + 1u < shape.w ? cell.z + 1u : 0u;
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  for (uint corner = 0u; corner < 8u; corner = corner + 1u) {
    bool isX = (corner & 1u) != 0u;
    bool isY = (corner & 2u) != 0u;
    bool isZ = (corner & 4u) != 0u;
    float weight = (isX ? share.x : 1.0f - share.x) * (isY ? share.y : 1.0f - share.y) *
                   (isZ ? share.z : 1.0f - share.z);
    sum += vec3(tableRecord(tableCell(shape, cell.x + (isX ? 1u : 0u), cell.y + (isY ? 1u : 0u),
                                      isZ ? next : cell.z))) *
           weight;
  }
  return sum;
}

// The cell that a random number falls into, of `count` cells `stride` records apart, and the
// number's place in the cell.
RL_FN uint tableFind(uint first, uint stride, uint count, float u, RL_OUT(float) place) {
  uint low = 0u;
  uint high = count - 1u;
  while (low < high) {
    uint middle = (low + high) >> 1u;
    if (tableRecord(first + middle * stride).w > u) {
      high = middle;
    } else {
      low = middle + 1u;
    }
  }
  float below = low > 0u ? tableRecord(first + (low - 1u) * stride).w : 0.0f;
  float mass = tableRecord(first + low * stride).w - below;
  place = clamp(rlSafeDivide(u - below, mass), 0.0f, 1.0f);
  return low;
}

// Probability of a cell.
RL_FN float tableMass(uint first, uint stride, uint cell) {
  float below = cell > 0u ? tableRecord(first + (cell - 1u) * stride).w : 0.0f;
  return max(tableRecord(first + cell * stride).w - below, 0.0f);
}

// Squared sine of half the angle at which cell i of theta_h begins: a solid angle over 4 pi.
RL_FN float tableHalfEdge(RL_IN(uvec4) shape, uint i) {
  float share = float(i) / float(shape.y);
  float s = sin(share * share * (0.25f * RL_PI));
  return s * s;
}

// Density of half vectors per solid angle.
RL_FN float tableHalfPdf(RL_IN(uvec4) shape, float cells) {
  uint i = min(uint(cells), shape.y - 1u);
  float width = tableHalfEdge(shape, i + 1u) - tableHalfEdge(shape, i);
  return tableMass(tableCell(shape, 0u, 0u, 0u), shape.z * shape.w, i) / (4.0f * RL_PI * width);
}

// Squared sine at which cell j of theta begins.
RL_FN float tableThetaEdge(RL_IN(uvec4) shape, uint j) {
  float s = sin(float(j) / float(shape.z) * (0.5f * RL_PI));
  return s * s;
}

// The row of a table of directions that lies below a theta of wo, and the share of the next.
RL_FN uint tableRow(RL_IN(uvec4) shape, float cells, RL_OUT(float) share) {
  float x = clamp(cells - 0.5f, 0.0f, float(shape.y) - 1.0f);
  float low = min(floor(x), float(shape.y) - 2.0f);
  share = x - low;
  return uint(low);
}

// Density of wi per solid angle: in each cell it goes with the cosine.
RL_FN float tableDirectionPdf(RL_IN(uvec4) shape, RL_IN(vec3) cells, float cosI) {
  float share;
  uint row = tableRow(shape, cells.x, share);
  uint j = min(uint(cells.y), shape.z - 1u);
  uint k = min(uint(cells.z), shape.w - 1u);
  uint cell = j * shape.w + k;
  float mass = (1.0f - share) * tableMass(tableCell(shape, row, 0u, 0u), 1u, cell) +
               share * tableMass(tableCell(shape, row + 1u, 0u, 0u), 1u, cell);
  float width = tableThetaEdge(shape, j + 1u) - tableThetaEdge(shape, j);
  return mass * cosI * float(shape.w) * RL_INV_PI / max(width, 1.0e-12f);
}

RL_FN vec3 tableEval(RL_IN(Bsdf) b, RL_IN(vec3) woL, RL_IN(vec3) wiL, RL_OUT(float) pdf) {
  pdf = 0.0f;
  if (!(wiL.z > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
  uvec4 shape = tableShape(b);
  bool isHalf = b.p0.w == 0.0f;
  vec3 cells;
  if (isHalf) {
    vec3 hL = normalize(woL + wiL);
    cells = tableHalfCells(shape, woL, wiL, hL);
    pdf = tableHalfPdf(shape, cells.x) / max(4.0f * dot(woL, hL), 1.0e-12f);
  } else {
    cells = tableDirectionCells(shape, woL, wiL);
    pdf = tableDirectionPdf(shape, cells, wiL.z);
  }
  pdf = b.p1.x * lambertPdf(wiL) + (1.0f - b.p1.x) * pdf;
  return vec3(b.p0) * tableValue(shape, cells, isHalf) * wiL.z;
}

RL_FN BsdfSample tableSample(RL_IN(Bsdf) b, RL_IN(vec3) woL, float uLobe, RL_IN(vec2) u) {
  BsdfSample s = bsdfSampleNone();
  if (uLobe < b.p1.x) {
    s.wi = lambertDraw(u);
    s.lobe = RL_LOBE_DIFFUSE;
    return s;
  }
  uvec4 shape = tableShape(b);
  float place;
  if (b.p0.w == 0.0f) {
    uint i = tableFind(tableCell(shape, 0u, 0u, 0u), shape.z * shape.w, shape.y, u.x, place);
    float low = tableHalfEdge(shape, i);
    float half2 = low + place * (tableHalfEdge(shape, i + 1u) - low);
    float z = 1.0f - 2.0f * half2;
    float r = 2.0f * sqrt(half2 * (1.0f - half2));
    vec2 cs = rlCosSin2Pi(u.y);
    vec3 hL = vec3(r * cs.x, r * cs.y, z);
    float cosH = dot(woL, hL);
    s.wi = hL * (2.0f * cosH) - woL;
    if (cosH > 0.0f && s.wi.z > 0.0f) s.lobe = RL_LOBE_SPECULAR;
    return s;
  }
  float share;
  uint row = tableRow(shape, tableTheta(woL) * (2.0f * RL_INV_PI) * float(shape.y), share);
  if ((uLobe - b.p1.x) < share * (1.0f - b.p1.x)) row = row + 1u;
  uint cell = tableFind(tableCell(shape, row, 0u, 0u), 1u, shape.z * shape.w, u.x, place);
  uint j = cell / shape.w;
  uint k = cell - j * shape.w;
  float low = tableThetaEdge(shape, j);
  float sin2 = low + place * (tableThetaEdge(shape, j + 1u) - low);
  bool isLeft = u.y < 0.5f;
  float inCell = isLeft ? 2.0f * u.y : 2.0f * u.y - 1.0f;
  vec2 cs = rlCosSin2Pi(0.5f * (float(k) + inCell) / float(shape.w));
  if (!isLeft) cs.y = -cs.y;
  float r = sqrt(sin2);
  vec2 to = tableAzimuth(woL);
  s.wi = vec3(r * (to.x * cs.x - to.y * cs.y), r * (to.y * cs.x + to.x * cs.y),
              sqrt(max(1.0f - sin2, 0.0f)));
  if (s.wi.z > 0.0f) s.lobe = RL_LOBE_SPECULAR;
  return s;
}
#endif
