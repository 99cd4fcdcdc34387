// Restricts a page to the scripts that it is made with, by their hashes. A script that is injected
// later, such as by an unescaped name, does not run.
#pragma once

#include <string>
#include <string_view>

namespace restlab {

// Returns a source of a Content-Security-Policy: 'sha256-...' of the text between <script> and
// </script>.
std::string scriptHash(std::string_view script);

// Returns the hashes of all scripts of a page that browsers run, as the value of script-src; 'none'
// if there are none. A script with a type is data. Expects a page made by this program: lines end
// with \n, tags are lower case.
std::string scriptHashes(std::string_view page);

}  // namespace restlab
