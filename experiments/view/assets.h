// Style sheet and scripts of the live page, embedded by the build: first those of the report's
// viewer, then the live page's own.
#pragma once

#include <string_view>

namespace restlab {

std::string_view viewStyle();
std::string_view viewScript();  // all scripts, concatenated

}  // namespace restlab
