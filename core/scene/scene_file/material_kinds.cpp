#include <algorithm>

#include "core/scene/scene_file/scene_file.h"

namespace restlab {
namespace {

using Kind = ClosureParameter::Kind;

ClosureParameter color(const char* name, double fallback, const char* help) {
  return {name, Kind::color, fallback, 0.0, 1.0, {}, help};
}
ClosureParameter number(const char* name, double fallback, double lo, double hi, const char* help) {
  return {name, Kind::number, fallback, lo, hi, {}, help};
}

const ClosureParameter kAlpha =
    number("alpha", 0.0, 0.0, 1.0, "GGX roughness of the facets; below 0.001: smooth");

ClosureParameter absorption() {
  ClosureParameter p = color("absorption", 0.0, "per metre inside the body, of each channel");
  p.hi = 1.0e6;
  return p;
}

ClosureParameter meanFreePath() {
  ClosureParameter p = color("mean_free_path", 0.01, "metres between collisions, of each channel");
  p.lo = 1.0e-6;
  p.hi = 1.0e6;
  return p;
}

std::vector<ClosureParameter> gltfParameters() {
  return {
      color("color", 0.8, "base colour"),
      number("metallic", 0.0, 0.0, 1.0, "0: dielectric, 1: metal"),
      number("roughness", 0.5, 0.0, 1.0, "square root of alpha"),
      number("ior", 1.5, 1.0, 4.0, "index of refraction"),
      number("specular", 1.0, 0.0, 1.0, "strength of a dielectric's reflection"),
      number("transmission", 0.0, 0.0, 1.0,
             "share of the base that refracts; around a closed body"),
      number("clearcoat", 0.0, 0.0, 1.0, "factor of the coat"),
      number("clearcoat_roughness", 0.0, 0.0, 1.0, "of the coat"),
      color("sheen", 0.0, "colour of the sheen"),
      number("sheen_roughness", 0.5, 0.0, 1.0, "of the sheen"),
      number("anisotropy", 0.0, 0.0, 1.0, "strength, along the tangent"),
      number("anisotropy_rotation", 0.0, -6.2832, 6.2832, "radians from the tangent"),
      number("iridescence", 0.0, 0.0, 1.0, "factor of the film"),
      number("film_thickness", 400.0, 0.0, 1.0e5, "nanometres"),
      number("film_ior", 1.3, 1.0, 4.0, "index of refraction of the film"),
      number("diffuse_transmission", 0.0, 0.0, 1.0, "share of the diffuse part that passes"),
      color("diffuse_transmission_color", 1.0, "its colour"),
      number("dispersion", 0.0, 0.0, 39.0, "20 over the Abbe number, of what refracts"),
  };
}

// The kinds that the lobes of core/shading/bsdf.glsl stand for.
std::vector<MaterialKind> lobeKinds() {
  const ClosureParameter ior = number("ior", 1.5, 1.0, 4.0, "index of refraction (water 1.33)");
  return {
      {"black", "scatters nothing", "", {}},
      {"diffuse", "Lambert", "Lambert 1760", {color("color", 0.5, "albedo")}},
      {"dielectric",
       "glass, water: reflects and refracts; around a closed body",
       "Walter et al. 2007",
       {ior, kAlpha, color("color", 1.0, "tint of the light that passes"), absorption()}},
      {"thin_dielectric",
       "a sheet of glass: reflects and lets through, without refraction",
       "Walter et al. 2007",
       {ior, kAlpha, color("color", 1.0, "tint of the light that passes")}},
      {"wax",
       "a body that light enters, and that scatters it inside; around a closed body",
       "Henyey and Greenstein 1941; Wrenninge, Villemin and Hery 2017; Christensen and Burley 2015",
       {number("ior", 1.4, 1.0, 4.0, "index of refraction"),
        number("alpha", 0.1, 0.0, 1.0,
               "GGX roughness of its surface; the walk loses light at rough ones"),
        color("color", 1.0, "tint of the light that passes its surface"),
        color("albedo", 0.99, "share of the light that a collision scatters"),
        meanFreePath(),
        number("g", 0.0, -0.95, 0.95, "mean cosine of the angles; 0: to all sides alike"),
        {"model",
         Kind::choice,
         0.0,
         0.0,
         1.0,
         {"walk", "diffusion"},
         "walk: random, without bias; diffusion: a profile, less noise, biased"}}},
      {"plastic",
       "Lambert below a layer that reflects",
       "glTF 2.0, appendix B",
       {color("color", 0.5, "albedo of the base"), ior, kAlpha}},
      {"gltf", "metal or dielectric of glTF, with the layers of its extensions",
       "glTF 2.0, appendix B, and the texts of its extensions", gltfParameters()},
  };
}

}  // namespace

const std::vector<MaterialKind>& materialKinds() {
  static const std::vector<MaterialKind> kAll = [] {
    std::vector<MaterialKind> all = lobeKinds();
    for (const ClosureInfo& info : closureRegistry())
      all.push_back({info.name, info.summary, info.source, info.parameters, &info});
    return all;
  }();
  return kAll;
}

}  // namespace restlab
