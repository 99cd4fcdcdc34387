// Style sheet and scripts of the report, files of html/ that the build embeds into the program.
#pragma once

#include <string_view>

namespace restlab {

std::string_view reportStyle();
std::string_view reportScript();  // all scripts, concatenated

}  // namespace restlab
