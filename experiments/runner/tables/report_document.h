// Converts the rows of blocks to the document that report.html and the plots are made from
// (experiments/report/report_model.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/runner/tables/summary.h"

namespace restlab {

// Returns a member of "blocks". Refers to the files that writeBlockImages() wrote.
nlohmann::ordered_json blockDocument(const Suite& suite, const std::vector<MethodSummary>& rows,
                                     float exposure);

// Returns the whole document. `record`: run.json.
nlohmann::ordered_json reportDocument(const Suite& suite, const nlohmann::ordered_json& record,
                                      std::vector<nlohmann::ordered_json> blocks,
                                      const std::vector<std::string>& notes);

}  // namespace restlab
