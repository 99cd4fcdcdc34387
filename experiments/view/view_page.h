// Page of the viewer: one HTML file that loads nothing else.
#pragma once

#include <string>

namespace restlab {

// Returns the HTML; its content is made by the scripts.
std::string viewPage();

}  // namespace restlab
