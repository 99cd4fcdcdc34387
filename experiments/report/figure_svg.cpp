#include <fmt/format.h>

#include "experiments/report/figure.h"
#include "experiments/report/svg_style.h"

namespace restlab {

std::string figureSvg(const Figure& figure) {
  std::string out = svg::open(figure.width, figure.height, figure.description, "figure");
  for (const FigurePicture& picture : figure.pictures) {
    // The PNG holds the enlarged pixels; a viewer that scales it further must not blur them.
    out += fmt::format(
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
        "style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>\n",
        svg::coordinate(picture.x), svg::coordinate(picture.y), svg::coordinate(picture.width),
        svg::coordinate(picture.height), encodeBase64(encodePng(picture.picture)));
  }
  for (const FigureFrame& frame : figure.frames) {
    const double half = frame.thickness / 2.0;
    out += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"{}\" "
        "stroke-width=\"{}\"/>\n",
        svg::coordinate(frame.x - half), svg::coordinate(frame.y - half),
        svg::coordinate(frame.width + frame.thickness),
        svg::coordinate(frame.height + frame.thickness), frame.colour,
        svg::coordinate(frame.thickness));
  }
  for (const FigureText& text : figure.texts) {
    out += svg::text(text.x, text.y, text.anchor, text.text,
                     fmt::format("font-size=\"{}\"{}", svg::coordinate(text.size),
                                 text.bold ? " font-weight=\"bold\"" : ""));
  }
  return out + "</svg>\n";
}

}  // namespace restlab
