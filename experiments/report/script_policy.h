// Which scripts a page may run: those that stand in it when it is made, by their hashes. A script
// that gets into it later, by a name that was not escaped, say, runs nowhere.
#pragma once

#include <string>
#include <string_view>

namespace restlab {

// A source of a Content-Security-Policy: 'sha256-...' of what stands between <script> and
// </script>.
std::string scriptHash(std::string_view script);

// Hashes of all scripts of a page that browsers run, as the value of script-src; 'none' where it
// has none. A script with a type is data. Pages are of this program: lines end with \n, tags are
// lower case.
std::string scriptHashes(std::string_view page);

}  // namespace restlab
