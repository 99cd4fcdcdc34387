// Checks of a BSDF: the laws that it holds or breaks, and whether its draws have its density.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/backend/bsdf_probe.h"

namespace restlab {

struct AlbedoRow {
  double degrees = 0.0;    // of wo from the normal
  glm::dvec3 albedo{0.0};  // share of the light that leaves, per channel
  glm::dvec3 error{0.0};   // standard error
};

struct LawVerdict {
  std::string law;  // "non-negative", "energy", "reciprocity", "sampling"
  bool holds = false;
  double value = 0.0;   // the figure that decides
  std::string meaning;  // of the figure, with its place
};

struct BsdfLaws {
  std::vector<LawVerdict> verdicts;
  std::vector<AlbedoRow> albedo;
  double alpha = 0.0, power = 0.0;  // of the narrowest lobe: power = 2 / alpha^2 - 2
  uint64_t samples = 0;             // draws for each angle of the sampling check
};

// samples: draws for each of three angles (0, 45, 80 degrees) of the chi-squared test.
BsdfLaws checkLaws(const BsdfProbe& bsdf, uint64_t samples);

// A direction at an angle from the normal, in the azimuth of all checks.
glm::dvec3 directionAt(double degrees);

}  // namespace restlab
