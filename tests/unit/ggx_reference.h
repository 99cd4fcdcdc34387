// GGX microfacets in double precision, written from the papers without code of the dialect: Walter
// et al. 2007 (D, transmission), Heitz 2014 (height-correlated masking).
#pragma once

#include <functional>
#include <glm/glm.hpp>

namespace restlab::unit::reference {

// Distribution of normals at an angle with cosine `cosH` from the macronormal, 1/sr.
double ggxD(double cosH, double alpha);
// Smith's auxiliary function of a direction with cosine `cosW`.
double ggxLambda(double cosW, double alpha);

// Unpolarised reflectance of a dielectric, from the amplitude ratios of both polarisations; `eta`
// is the index beyond over the index on the side of the incident direction.
double fresnel(double cosI, double eta);
double fresnelSchlick(double cosI, double f0, double f90);

// Fresnel reflectance against the cosine between direction and microfacet.
using FresnelFunction = std::function<double(double cosH)>;

// f_r(wo, wi) cos_i of a rough reflector; directions with z along the normal.
double reflection(const glm::dvec3& wo, const glm::dvec3& wi, double alpha,
                  const FresnelFunction& fresnel);

// Fractions of light from wo, with cosine `cosO`, that leave as reflection and as refracted
// radiance (the latter with its factor 1 / eta^2): integrals over the microfacet normals, error
// below 1e-4.
double reflectedAlbedo(double cosO, double alpha, const FresnelFunction& fresnel);
double transmittedAlbedo(double cosO, double alpha, double eta, const FresnelFunction& fresnel);

}  // namespace restlab::unit::reference
