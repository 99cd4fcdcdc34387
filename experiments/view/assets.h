// The style sheet and the scripts of the viewer's page, files of the report's html/ and of its own,
// that the build puts into the program.
#pragma once

#include <string_view>

namespace restlab {

std::string_view viewStyle();
std::string_view viewScript();  // all scripts, one after the other

}  // namespace restlab
