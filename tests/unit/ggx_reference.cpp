#include "tests/unit/ggx_reference.h"
#include "tests/unit/constants.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace restlab::unit::reference {
namespace {

// Integral of g(h) over the microfacet normals h weighted by D(h) cos_h, which integrates to 1.
// With tan^2 = alpha^2 u / (1 - u) the weight is uniform in u and azimuth. The midpoint rule in
// azimuth is exact to rounding for smooth periodic functions; u = 3 t^2 - 2 t^3 crowds points at
// both ends.
double overNormals(double alpha, const std::function<double(const glm::dvec3&)>& g) {
  constexpr int nT = 1500, nPhi = 256;
  double sum = 0.0;
  for (int i = 0; i < nT; ++i) {
    const double t = (i + 0.5) / nT, u = t * t * (3.0 - 2.0 * t);
    const double tangent = alpha * std::sqrt(u / (1.0 - u)),
                 cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    double row = 0.0;
    for (int j = 0; j < nPhi; ++j) {
      const double phi =
          kPi * (j + 0.5) / nPhi;  // wo lies in the plane phi = 0: half the circle is enough
      row += g({tangent * cosine * std::cos(phi), tangent * cosine * std::sin(phi), cosine});
    }
    sum += row / nPhi * 6.0 * t * (1.0 - t) / nT;
  }
  return sum;
}

glm::dvec3 inPlane(double cosO) { return {std::sqrt(1.0 - cosO * cosO), 0.0, cosO}; }

double maskingShadowing(double cosO, double cosI, double alpha) {
  return 1.0 / (1.0 + ggxLambda(cosO, alpha) + ggxLambda(cosI, alpha));
}

}  // namespace

double ggxD(double cosH, double alpha) {
  const double cos2 = cosH * cosH, tan2 = (1.0 - cos2) / cos2, s = alpha * alpha + tan2;
  return alpha * alpha / (kPi * cos2 * cos2 * s * s);
}

double ggxLambda(double cosW, double alpha) {
  const double tan2 = (1.0 - cosW * cosW) / (cosW * cosW);
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

double fresnel(double cosI, double eta) {
  using Complex = std::complex<double>;
  // Under total internal reflection the cosine is imaginary and both ratios have modulus 1.
  const Complex cosT = std::sqrt(Complex(1.0 - (1.0 - cosI * cosI) / (eta * eta)));
  const Complex s = (cosI - eta * cosT) / (cosI + eta * cosT),
                p = (eta * cosI - cosT) / (eta * cosI + cosT);
  return 0.5 * (std::norm(s) + std::norm(p));
}

double fresnelSchlick(double cosI, double f0, double f90) {
  return f0 + (f90 - f0) * std::pow(1.0 - cosI, 5.0);
}

double reflection(const glm::dvec3& wo, const glm::dvec3& wi, double alpha,
                  const FresnelFunction& f) {
  const glm::dvec3 h = glm::normalize(wo + wi);
  return f(glm::dot(wo, h)) * ggxD(h.z, alpha) * maskingShadowing(wo.z, wi.z, alpha) / (4.0 * wo.z);
}

double reflectedAlbedo(double cosO, double alpha, const FresnelFunction& f) {
  const glm::dvec3 wo = inPlane(cosO);
  return overNormals(alpha, [&](const glm::dvec3& h) {
    const double d = glm::dot(wo, h);
    const double cosI = 2.0 * d * h.z - wo.z;
    if (d <= 0.0 || cosI <= 0.0) return 0.0;
    return f(d) * maskingShadowing(wo.z, cosI, alpha) * d / (wo.z * h.z);
  });
}

double transmittedAlbedo(double cosO, double alpha, double eta, const FresnelFunction& f) {
  const glm::dvec3 wo = inPlane(cosO);
  return overNormals(alpha, [&](const glm::dvec3& h) {
    const double d = glm::dot(wo, h);
    const double sin2T = (1.0 - d * d) / (eta * eta);
    if (d <= 0.0 || sin2T >= 1.0) return 0.0;
    const double cosI = -(-wo.z / eta + h.z * (d / eta - std::sqrt(1.0 - sin2T)));
    if (cosI <= 0.0) return 0.0;
    return (1.0 - f(d)) * maskingShadowing(wo.z, cosI, alpha) * d / (wo.z * h.z) / (eta * eta);
  });
}

}  // namespace restlab::unit::reference
