// Crop strip of a paper: one whole image with its crops marked, and each crop of every method and
// of the reference, enlarged, with labels above and errors below.
#pragma once

#include <string>
#include <vector>

#include "experiments/report/picture.h"

namespace restlab {

struct FigureColumn {
  std::string label;
  const Image* image = nullptr;
  std::string error;                    // error of the whole image; "": none
  std::vector<std::string> cropErrors;  // error of each crop, or empty
  bool best = false;                    // sets the error in bold
};

// `full` and the columns' images have one size and contain the crops; the crops have one size.
struct FigureSpec {
  const Image* full = nullptr;
  std::string fullLabel, metric;  // name of the metric, left of the errors
  std::vector<Crop> crops;
  std::vector<FigureColumn> columns;
  float exposure = 1.0f;
  uint32_t scale = 1;  // output pixels per pixel of a crop
};

struct FigurePicture {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  Picture picture;
};

// Rectangle drawn with lines of `thickness` inside its bounds.
struct FigureFrame {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0, thickness = 2.0;
  std::string colour;  // "#rrggbb"
};

struct FigureText {
  double x = 0.0, y = 0.0;   // position of the baseline
  std::string anchor, text;  // start, middle, end
  double size = 12.0;
  bool bold = false;
};

// Layout of a figure, in pixels.
struct Figure {
  double width = 0.0, height = 0.0;
  std::string description = "Crops of images";  // the SVG's title
  std::vector<FigurePicture> pictures;
  std::vector<FigureFrame> frames;
  std::vector<FigureText> texts;
  std::vector<std::string> cutLabels;  // labels that were shortened to fit
};

Figure layOutFigure(const FigureSpec& spec);

// Returns a complete SVG document: pictures as embedded lossless PNGs, text as text.
std::string figureSvg(const Figure& figure);

// Returns a PNG with an ASCII bitmap font; other characters become '?'.
std::string figurePng(const Figure& figure,
                      const std::map<std::string, std::string>& metadata = {});

}  // namespace restlab
