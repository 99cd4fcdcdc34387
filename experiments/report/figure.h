// A paper's crop strip: one image whole with its crops marked, and each crop of every method and of
// the reference, enlarged, with labels above and errors below.
#pragma once

#include <string>
#include <vector>

#include "experiments/report/picture.h"

namespace restlab {

struct FigureColumn {
  std::string label;
  const Image* image = nullptr;
  std::string error;                    // of the whole image; "" for none
  std::vector<std::string> cropErrors;  // of each crop, or empty
  bool best = false;                    // its error is set in bold
};

// `full` and the columns' images have one size, which holds the crops; the crops have one size.
struct FigureSpec {
  const Image* full = nullptr;
  std::string fullLabel, metric;  // the metric's name stands left of the errors
  std::vector<Crop> crops;
  std::vector<FigureColumn> columns;
  float exposure = 1.0f;
  uint32_t scale = 1;  // output pixels a pixel of a crop
};

struct FigurePicture {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  Picture picture;
};

// A rectangle of lines `thickness` wide around its inside.
struct FigureFrame {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0, thickness = 2.0;
  std::string colour;  // "#rrggbb"
};

struct FigureText {
  double x = 0.0, y = 0.0;   // of the baseline
  std::string anchor, text;  // start, middle, end
  double size = 12.0;
  bool bold = false;
};

// What stands where, in pixels.
struct Figure {
  double width = 0.0, height = 0.0;
  std::vector<FigurePicture> pictures;
  std::vector<FigureFrame> frames;
  std::vector<FigureText> texts;
  std::vector<std::string> cutLabels;  // labels that had to be cut to fit
};

Figure layOutFigure(const FigureSpec& spec);

// A whole SVG document: pictures as lossless PNGs inside, text as text.
std::string figureSvg(const Figure& figure);

// A PNG with a bitmap font of ASCII; other characters become '?'.
std::string figurePng(const Figure& figure,
                      const std::map<std::string, std::string>& metadata = {});

}  // namespace restlab
