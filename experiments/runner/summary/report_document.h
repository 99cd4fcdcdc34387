// Converts the rows of blocks to the document that report.html and the plots are made from
// (experiments/report/report_model.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/runner/summary/summary.h"

namespace restlab {

// Returns the exposure of the block's previews and images in the report: maps the logarithmic mean
// of the luminance of the reference's non-black pixels to mid grey.
float previewExposure(const Image& reference);
// The same from luminances, and from the largest channel of each pixel that may be clipped.
float previewExposure(std::vector<double> luminances, std::vector<float> brightest);
// Returns 0 for pixels that do not count: black or not finite.
double previewLuminance(const glm::vec3& pixel);

// Returns a member of "blocks". Refers to the files that writeBlockImages() wrote.
nlohmann::ordered_json blockDocument(const Suite& suite, const std::vector<MethodSummary>& rows,
                                     float exposure);

// Returns the whole document. `record`: run.json.
nlohmann::ordered_json reportDocument(const Suite& suite, const nlohmann::ordered_json& record,
                                      std::vector<nlohmann::ordered_json> blocks,
                                      const std::vector<std::string>& notes);

}  // namespace restlab
