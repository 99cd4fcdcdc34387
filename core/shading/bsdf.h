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
// Layers of glTF's extensions.
const uint RL_LOBE_COAT = 256u;  // GGX reflection of a clearcoat
const uint RL_LOBE_COAT_DELTA = 512u;
const uint RL_LOBE_COAT_BEYOND = 1024u;  // the coat lies on the far side, outside of a solid
const uint RL_LOBE_SHEEN = 2048u;
const uint RL_LOBE_ANISOTROPIC = 4096u;  // GGX lobes that differ along the tangent
const uint RL_LOBE_FILM = 8192u;         // thin-film interference; its factor is above bit 16
const uint RL_LOBE_DIFFUSE_TRANSMISSION = 16384u;
const uint RL_LOBE_DISPERSION = 32768u;  // an index of refraction for each channel
const uint RL_LOBE_FILM_SHIFT = 16u;     // factor of the film, 0 to 65535
const uint RL_LOBE_ANY_COAT = 768u;
const uint RL_LOBE_ANY_DELTA = 532u;
const uint RL_LOBE_ANY_TRANSMISSION = 24u;
const uint RL_LOBE_ANY_PASSING = 16408u;
// All that is not Lambert's reflection under a Fresnel layer of its own.
const uint RL_LOBE_ANY_GLOSSY = 19230u;

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

// Reflectance at normal incidence of a clearcoat: index of refraction 1.5.
const float RL_COAT_F0 = 0.04f;
// Greatest spread of indices by dispersion, as a share of what the middle one differs from 1: red
// light keeps an index that rough refraction can resolve.
const float RL_LARGEST_SPREAD = 0.975f;
// Least alpha of a sheen: a smoother one is nearly invisible, and rendered with this.
const float RL_SHEEN_ALPHA_FLOOR = 0.01f;
// Cells of sqrt(cos) and of sqrt(alpha) in the table of sheen albedos
// (core/scene/compiled/sheen_albedo.h). It begins at record 0 of SceneData::closureParameters.
const uint RL_SHEEN_CELLS = 32u;

// Parameters of a material with layers, by their place behind Material::firstParameter: a number or
// a colour with its texture, as closures have them, or what is said here.
const uint RL_LAYER_CLEARCOAT = 0u;
const uint RL_LAYER_CLEARCOAT_ROUGHNESS = 1u;
const uint RL_LAYER_CLEARCOAT_NORMAL = 2u;  // scale; the texture holds the normal
const uint RL_LAYER_SHEEN_COLOR = 3u;
const uint RL_LAYER_SHEEN_ROUGHNESS = 4u;
const uint RL_LAYER_ANISOTROPY = 5u;  // strength, cosine and sine of the rotation
const uint RL_LAYER_IRIDESCENCE = 6u;
const uint RL_LAYER_FILM = 7u;  // least and greatest thickness (nm), index of refraction
const uint RL_LAYER_DIFFUSE_TRANSMISSION = 8u;
const uint RL_LAYER_DIFFUSE_TRANSMISSION_COLOR = 9u;
const uint RL_LAYER_DISPERSION = 10u;  // 20 over the Abbe number
const uint RL_LAYER_COUNT = 11u;

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
  // Values that the closure's file gives a meaning. Of glTF's lobes, where the scene has layers:
  //   p0: factor and alpha of the clearcoat, x and y of its normal in the frame of the surface's
  //   p1: colour and alpha of the sheen
  //   p2: alpha of the base along the tangent and across, thickness (nm) and index of the film
  //   p3: albedo of the diffuse transmission; spread of the indices over the index itself, negative
  //       where the surface is seen from inside
  vec4 p0;
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
