// Form factors from a point to an element: the share of the irradiance at the point that the
// element would send, were its radiosity everywhere the same.

// Lambert's formula for a triangle as a point with normal n sees it (Lambert 1760; Baum et al.
// 1989, equation 12), clipped at the horizon. Corners are relative to the point.
RL_FN float formFactorEdge(RL_IN(vec3) n, RL_IN(vec3) a, RL_IN(vec3) b) {
  vec3 across = cross(a, b);
  float sine = sqrt(dot(across, across));
  if (!(sine > 0.0f)) return 0.0f;
  return dot(n, across) * (atan(sine, dot(a, b)) / sine);
}

// Where the edge from a (above) to b (below) crosses the horizon.
RL_FN vec3 formFactorCut(RL_IN(vec3) a, RL_IN(vec3) b, float heightA, float heightB) {
  return a + (b - a) * (heightA / (heightA - heightB));
}

// Unsigned, for either side of the element.
RL_FN float formFactorOfTriangle(RL_IN(vec3) n, RL_IN(vec3) a, RL_IN(vec3) b, RL_IN(vec3) c) {
  vec3 heights = vec3(dot(n, a), dot(n, b), dot(n, c));
  vec3 corner = a;
  vec3 next = b;
  vec3 last = c;
  vec3 h = heights;
  uint above = (h.x > 0.0f ? 1u : 0u) + (h.y > 0.0f ? 1u : 0u) + (h.z > 0.0f ? 1u : 0u);
  if (above == 0u) return 0.0f;
  // Turns the corners until the first is the only one above, or the only one below.
  bool wanted = above == 1u;
  if (above != 3u && (h.x > 0.0f) != wanted) {
    if ((h.y > 0.0f) == wanted) {
      corner = b;
      next = c;
      last = a;
      h = vec3(heights.y, heights.z, heights.x);
    } else {
      corner = c;
      next = a;
      last = b;
      h = vec3(heights.z, heights.x, heights.y);
    }
  }
  float sum = 0.0f;
  if (above == 3u) {
    sum = formFactorEdge(n, corner, next) + formFactorEdge(n, next, last) +
          formFactorEdge(n, last, corner);
  } else if (above == 1u) {
    vec3 p = formFactorCut(corner, next, h.x, h.y);
    vec3 q = formFactorCut(corner, last, h.x, h.z);
    sum = formFactorEdge(n, corner, p) + formFactorEdge(n, p, q) + formFactorEdge(n, q, corner);
  } else {
    vec3 p = formFactorCut(next, corner, h.y, h.x);
    vec3 q = formFactorCut(last, corner, h.z, h.x);
    sum = formFactorEdge(n, p, next) + formFactorEdge(n, next, last) + formFactorEdge(n, last, q) +
          formFactorEdge(n, q, p);
  }
  return abs(sum) * (0.5f * RL_INV_PI);
}
