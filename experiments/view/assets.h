// The style sheet and the scripts of the live page, files of the build: those of the report's
// viewer, then its own.
#pragma once

#include <string_view>

namespace restlab {

std::string_view viewStyle();
std::string_view viewScript();  // all scripts, one after the other

}  // namespace restlab
