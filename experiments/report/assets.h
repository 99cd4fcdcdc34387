// The style sheet and the scripts of the report, files of html/ that the build puts into the
// program.
#pragma once

#include <string_view>

namespace restlab {

std::string_view reportStyle();
std::string_view reportScript();  // all scripts, one after the other

}  // namespace restlab
