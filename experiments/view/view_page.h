// The page of the viewer: one file that loads nothing else.
#pragma once

#include <string>

namespace restlab {

// HTML. What stands on it the scripts make.
std::string viewPage();

}  // namespace restlab
