// Rows of images: what other programs rendered, measured like the runs of our own methods.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "experiments/runner/run/job.h"

namespace restlab {

// Reads every image of the block's rows. `configuration`: what the suite's own images would say of
// their scene and settings. Throws Error that starts with the place in the suite: a file that is
// absent, is no EXR, has another size or says that it is of another scene or setting, one file for
// several scenes or components.
void checkImageRows(const Suite& suite, const std::string& scene, uint32_t component,
                    uint32_t width, uint32_t height,
                    const std::map<std::string, std::string>& configuration);

// All files of the rows.
std::vector<std::filesystem::path> imageFiles(const Suite& suite);

// How many images the longest row has.
uint32_t imageRuns(const Suite& suite);

// Errors of image `run` of every row that has so many, as a job: of the images' bytes, the
// reference's pixels and what the suite says of them.
struct ImageJob {
  JobIdentity identity;
  JobData data;
};
ImageJob measureImages(const Suite& suite, const BlockResult& block, uint32_t run,
                       const std::string& referenceHash, const std::string& startedUtc);

}  // namespace restlab
