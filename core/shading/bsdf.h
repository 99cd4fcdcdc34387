// The BSDF of a shading point: a sum of lobes, each in core/shading/bsdf/.
#ifndef RL_BSDF_H
#define RL_BSDF_H

#ifdef __cplusplus
#include "core/dialect/dialect.h"
#endif

RL_NAMESPACE_BEGIN

const uint RL_LOBE_DIFFUSE = 1u;         // Lambert under the Fresnel layer
const uint RL_LOBE_SPECULAR = 2u;        // GGX reflection
const uint RL_LOBE_SPECULAR_DELTA = 4u;  // mirror reflection (alpha below the floor)
const uint RL_LOBE_TRANSMISSION = 8u;    // GGX transmission
const uint RL_LOBE_TRANSMISSION_DELTA = 16u;
const uint RL_LOBE_THIN = 32u;           // transmission without refraction
const uint RL_LOBE_ROUGH_DIFFUSE = 64u;  // diffuse, but not Lambert: depends on the directions
const uint RL_LOBE_EXIT = 128u;  // the diffuse lobe is light from inside, through the surface
const uint RL_LOBE_ANY_DELTA = 20u;
const uint RL_LOBE_ANY_TRANSMISSION = 24u;
const uint RL_LOBE_ANY_GLOSSY = 30u;

// GGX alpha below this floor becomes a delta lobe, which is counted (RL_HEALTH_DELTA_LOBES).
const float RL_ALPHA_FLOOR = 1.0e-3f;
// An index of refraction, or a ratio of two, within this of 1 is taken as 1: light is bent by less
// than 1e-5 rad at 45 degrees, and float32 cannot resolve the half vector.
const float RL_CLEAR_CONTRAST = 1.0e-5f;

// Parts of a microfacet lobe (core/shading/bsdf/facets.glsl).
const uint RL_FACETS_BECKMANN = 0u;  // distribution of normals
const uint RL_FACETS_GGX = 1u;
const uint RL_FACETS_BLINN = 2u;
const uint RL_MASKING_SMITH = 0u;  // masking and shadowing
const uint RL_MASKING_CORRELATED = 1u;
const uint RL_MASKING_V_CAVITIES = 2u;
const uint RL_FRESNEL_SCHLICK = 0u;
const uint RL_FRESNEL_DIELECTRIC = 1u;
const uint RL_FRESNEL_CONDUCTOR = 2u;

// Materials of a mixture (core/shading/closures/mixture.glsl).
const uint RL_MIXTURE_COUNT = 4u;

// Nodes of sqrt(cos) and of sqrt(alpha) in the table of GGX albedos
// (core/scene/compiled/ggx_albedo.h).
const uint RL_GGX_NODES = 64u;

struct Bsdf {
  vec3 diffuse;       // albedo of the Lambert lobe, before the Fresnel layer takes its share
  uint lobes;         // RL_LOBE_*
  vec3 f0;            // specular reflectance at normal incidence
  float f90;          // specular reflectance at grazing incidence
  vec3 transmission;  // tint of the transmitted part
  float alpha;        // GGX roughness, linear
  float eta;          // index of refraction beyond the surface over that on the side of wo
  // A closure (core/shading/closures) in place of glTF's lobes. It says above, for whoever asks how
  // a surface scatters on the whole: lobes, albedo (diffuse, f0), alpha of its narrowest lobe.
  uint closure;  // RL_CLOSURE_*
  vec2 tangent;  // cosine and sine of the angle from the normal's frame to the tangent
  vec4 p0;       // values that the closure's file gives a meaning
  vec4 p1;
  vec4 p2;
  vec4 p3;
};

struct BsdfSample {
  vec3 wi;              // world, unit
  float pdfSolidAngle;  // over all non-delta lobes; for a delta lobe, of the lobe choice alone
  vec3 weight;          // f |cos| / pdf
  uint lobe;            // the lobe that was drawn; 0: no direction (absorbed)
};

RL_NAMESPACE_END

#endif
