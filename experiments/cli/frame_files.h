// Files of a numbered sequence.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace restlab {

struct FrameFiles {
  std::filesystem::path input, output;
};

// Finds the inputs of a pattern with a run of #, "a/frame-####.exr", by number, and the outputs
// with the same numbers. Without # in both it is one file. Throws Error: badUsage if only one has
// #, one is no *.exr, or an output is an input; badInput if no input exists or a number is missing
// in between.
std::vector<FrameFiles> frameFiles(const std::string& input, const std::string& output);

}  // namespace restlab
