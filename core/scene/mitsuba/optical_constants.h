// Indices of refraction by the names that Mitsuba has for them.
#pragma once

#include <string>
#include <vector>

namespace restlab::mitsuba {

// Index at visible wavelengths; 0 if the name is unknown.
double indexOfRefraction(const std::string& name);
std::vector<std::string> indexNames();

// The metal of the closure `conductor` with that name, without what follows a '_'; "" if it has
// none.
std::string metalOf(const std::string& name);
std::vector<std::string> metalNames();

}  // namespace restlab::mitsuba
