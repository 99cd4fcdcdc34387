// Characters that command a terminal instead of being shown: those of ASCII, and those from U+0080
// to U+009F in UTF-8. Names inside files may hold them.
#pragma once

#include <string>

namespace restlab {

// A blank in the place of each. Line breaks and tabs may stay.
std::string withoutControls(const std::string& text, bool keepsLines);

// JSON with an escape in the place of each, which means the same to who parses it. A dump has
// escaped those below U+0020 already; its own line breaks stay.
std::string jsonWithoutControls(const std::string& dump);

}  // namespace restlab
