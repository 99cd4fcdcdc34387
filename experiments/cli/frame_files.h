// Files of a numbered sequence.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace restlab {

struct FrameFiles {
  std::filesystem::path input, output;
};

// Of patterns with a run of # each, "a/frame-####.exr": the inputs that are there, by number, and
// the outputs with the same numbers. Without a # in either it is one file. Throws Error (badUsage)
// where only one has #, or one is no *.exr, or an output is an input; (badInput) where no input is
// there or a number is missing between two.
std::vector<FrameFiles> frameFiles(const std::string& input, const std::string& output);

}  // namespace restlab
