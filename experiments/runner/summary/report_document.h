// The rows of blocks as the document that report.html and the plots are made of
// (experiments/report/report_model.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/runner/summary/summary.h"

namespace restlab {

// Exposure at which the block's previews and its images in the report are shown: the logarithmic
// mean of the luminance of the reference's pixels that are not black becomes mid grey.
float previewExposure(const Image& reference);
// The same of the luminances whose mean that is, and of the largest channel of each pixel that may
// be clipped.
float previewExposure(std::vector<double> luminances, std::vector<float> brightest);
// 0 of what does not count: black, and what is not finite.
double previewLuminance(const glm::vec3& pixel);

// A member of "blocks". The files are those that writeBlockImages() made.
nlohmann::ordered_json blockDocument(const Suite& suite, const std::vector<MethodSummary>& rows,
                                     float exposure);

// The whole document, without its notes. `record`: run.json.
nlohmann::ordered_json reportDocument(const Suite& suite, const nlohmann::ordered_json& record,
                                      std::vector<nlohmann::ordered_json> blocks,
                                      const std::vector<std::string>& notes);

}  // namespace restlab
