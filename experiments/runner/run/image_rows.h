// Image rows: images of other programs, measured like runs of methods rendered here.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "experiments/runner/run/job.h"

namespace restlab {

// Reads every image of the block's rows. `configuration`: scene and settings as the suite's own
// images state them. Throws Error that starts with the place in the suite: a file that is absent,
// is no EXR, has another size or states another scene or setting; one file for several scenes or
// components.
void checkImageRows(const Suite& suite, const std::string& scene, uint32_t component,
                    uint32_t width, uint32_t height,
                    const std::map<std::string, std::string>& configuration);

// Returns all files of the rows.
std::vector<std::filesystem::path> imageFiles(const Suite& suite);

// Returns the number of images of the longest row.
uint32_t imageRuns(const Suite& suite);

// Errors of image `run` of every row that has one, as a job. Identified by the images' bytes, the
// reference's pixels and the suite's settings for them.
struct ImageJob {
  JobIdentity identity;
  JobData data;
};
ImageJob measureImages(const Suite& suite, const BlockResult& block, uint32_t run,
                       const std::string& referenceHash, const std::string& startedUtc);

}  // namespace restlab
