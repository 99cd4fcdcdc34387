// restlab figure --series: one scene as a row of pictures, each with more of the light.
#pragma once

#include <cstdint>
#include <string>

namespace restlab {

struct SeriesOptions {
  std::string name;                // of the series: "course"
  std::string scene;               // as other verbs name it
  std::string output, title;       // title "": the scene's name
  double exposure = 0.0;           // 0: by the last picture
  uint32_t width = 0, height = 0;  // of each picture; 0: 320 wide, the camera's aspect ratio
  uint32_t spp = 64;
};

// Throws Error (badUsage) for another name than "course", or another ending than .svg and .png.
void makeSeries(const SeriesOptions& options);

}  // namespace restlab
