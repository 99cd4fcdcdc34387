// A row of pictures of one size, each with its label above.
#pragma once

#include <string>
#include <vector>

#include "experiments/report/figure.h"

namespace restlab {

struct SeriesPicture {
  std::string label;
  Image image;
};

// The images have one size, which is theirs in the figure; `title` stands below the row.
Figure layOutSeries(const std::vector<SeriesPicture>& pictures, const std::string& title,
                    float exposure);

}  // namespace restlab
