// Characters that command a terminal instead of being shown: those of ASCII, and U+0080 to U+009F
// in UTF-8. Names inside files may contain them.
#pragma once

#include <string>

namespace restlab {

// Replaces each control character by a blank. With `keepsLines`, line breaks and tabs stay.
std::string withoutControls(const std::string& text, bool keepsLines);

// Replaces each control character in JSON by an escape, with the same meaning to a parser. A dump
// has already escaped those below U+0020; its own line breaks stay.
std::string jsonWithoutControls(const std::string& dump);

}  // namespace restlab
