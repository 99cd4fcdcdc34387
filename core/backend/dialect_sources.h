// Kernels and all files of the dialect as of build time, so that the program does not need its
// source tree. cmake/dialect_sources.cmake generates the tables; they are registered when the
// program starts.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace restlab {

struct DialectSource {
  std::string_view path;  // relative to the repository
  std::string_view text;
};
const std::vector<DialectSource>& dialectSources();

// A kernel as rl_add_kernel names it.
struct DialectKernel {
  std::string name, file, header;
};
const std::vector<DialectKernel>& dialectKernels();
// Throws Error (badUsage) if there is no kernel of that name.
const DialectKernel& dialectKernel(const std::string& name);

// Called by the generated tables alone; always true.
bool registerDialect(std::vector<DialectSource> sources, std::vector<DialectKernel> kernels);

// Text of a file; nullopt if there is none.
std::optional<std::string> dialectSource(const std::string& path);

// Paths in the #include "..." lines of a text, in order.
std::vector<std::string> includedPaths(std::string_view text);
// The files `roots` and those that they include, directly or not, sorted by path. Paths that name
// no file of the program are left out.
std::vector<DialectSource> includedSources(std::vector<std::string> roots);

}  // namespace restlab
