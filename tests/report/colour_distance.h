// How far apart readers see two colours.
#pragma once

#include <string>

namespace restlab::report_test {

// Returns the distance of two colours "#rrggbb" in Oklab (Ottosson 2020): black and white are 1
// apart.
double colourDistance(const std::string& a, const std::string& b);

// Returns the least of it over readers who lack one kind of cones or none (Machado et al. 2009).
double leastColourDistance(const std::string& a, const std::string& b);

}  // namespace restlab::report_test
