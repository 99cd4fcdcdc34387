// Runs the C++ compiler that built the program, bounded in time.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace restlab {

struct UnitCompiler {
  std::string program;             // absolute path
  std::string version;             // __VERSION__ of the compiler that built this program
  std::vector<std::string> flags;  // all but names of files
  std::chrono::milliseconds limit = std::chrono::seconds(120);  // for one unit
};

// The compiler that built this program. RESTLAB_CXX names another place of the compiler.
UnitCompiler unitCompiler();

// Returns why the compiler cannot be run, in the words of the system; "" if it can.
std::string whyNotThere(const UnitCompiler& compiler);

// Compiles `source`, whose includes lie below `includes`, into the shared object `output`. The
// compiler's messages go to `output` with ".log" at its end, its temporary files into the folder of
// `output`. Returns one line on why there is no object; "" if there is one. Ends the compiler when
// its limit is reached, or when `isStopped` returns true.
std::string compileUnit(const UnitCompiler& compiler, const std::filesystem::path& includes,
                        const std::filesystem::path& source, const std::filesystem::path& output,
                        const std::function<bool()>& isStopped);

}  // namespace restlab
