// Rasterises a figure; draws only rectangles and a bitmap font.
#include <stb_easy_font.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "experiments/report/figure.h"
#include "experiments/report/text.h"

namespace restlab {
namespace {

struct Colour {
  uint8_t r, g, b;
};

Colour parseColour(const std::string& hex) {
  const auto at = [&](size_t i) { return uint8_t(std::stoul(hex.substr(i, 2), nullptr, 16)); };
  return {at(1), at(3), at(5)};
}

class Painter {
 public:
  Painter(double width, double height) : picture_{uint32_t(width), uint32_t(height), {}} {
    picture_.bytes.assign(size_t(picture_.width) * picture_.height * 3, 255);
  }

  void fill(double x0, double y0, double x1, double y1, Colour colour) {
    const auto inside = [](double value, uint32_t end) {
      return uint32_t(std::clamp(std::round(value), 0.0, double(end)));
    };
    for (uint32_t y = inside(y0, picture_.height); y < inside(y1, picture_.height); ++y) {
      for (uint32_t x = inside(x0, picture_.width); x < inside(x1, picture_.width); ++x) {
        uint8_t* pixel = &picture_.bytes[3 * (size_t(y) * picture_.width + x)];
        pixel[0] = colour.r;
        pixel[1] = colour.g;
        pixel[2] = colour.b;
      }
    }
  }

  void draw(const FigurePicture& picture) {
    const uint32_t left = uint32_t(std::round(picture.x)), top = uint32_t(std::round(picture.y));
    const Picture& from = picture.picture;
    for (uint32_t y = 0; y < from.height && top + y < picture_.height; ++y) {
      const size_t count = std::min(from.width, picture_.width - left);
      std::memcpy(&picture_.bytes[3 * (size_t(top + y) * picture_.width + left)],
                  &from.bytes[3 * size_t(y) * from.width], 3 * count);
    }
  }

  void draw(const FigureFrame& frame) {
    const Colour colour = parseColour(frame.colour);
    const double t = frame.thickness, right = frame.x + frame.width,
                 bottom = frame.y + frame.height;
    fill(frame.x - t, frame.y - t, right + t, frame.y, colour);
    fill(frame.x - t, bottom, right + t, bottom + t, colour);
    fill(frame.x - t, frame.y, frame.x, bottom, colour);
    fill(right, frame.y, right + t, bottom, colour);
  }

  void draw(const FigureText& text) {
    std::string ascii;
    for (const char c : text.text) {
      if ((uint8_t(c) & 0xc0) != 0x80) ascii += c >= ' ' && c <= '~' ? c : '?';
    }
    // The font is 7 pixels high; scale it by whole pixels only.
    const double scale = std::max(1.0, std::round(text.size / 11.0));
    const double width = scale * stb_easy_font_width(ascii.data());
    const double left = text.anchor == "middle" ? text.x - width / 2.0
                        : text.anchor == "end"  ? text.x - width
                                                : text.x;
    struct Vertex {
      float x, y, z;
      uint8_t colour[4];
    };
    std::vector<Vertex> vertices(ascii.size() * 64 + 64);
    const int quads = stb_easy_font_print(0.0f, 0.0f, ascii.data(), nullptr, vertices.data(),
                                          int(vertices.size() * sizeof(Vertex)));
    const double top = text.y - 7.0 * scale;
    for (int i = 0; i < quads; ++i) {
      const Vertex &a = vertices[size_t(4 * i)], &b = vertices[size_t(4 * i + 2)];
      for (int copy = 0; copy <= int(text.bold); ++copy) {
        fill(left + scale * a.x + copy, top + scale * a.y, left + scale * b.x + copy,
             top + scale * b.y, {0x1a, 0x1a, 0x1a});
      }
    }
  }

  const Picture& picture() const { return picture_; }

 private:
  Picture picture_;
};

}  // namespace

std::string figurePng(const Figure& figure, const std::map<std::string, std::string>& metadata) {
  Painter painter(figure.width, figure.height);
  for (const FigurePicture& picture : figure.pictures) painter.draw(picture);
  for (const FigureFrame& frame : figure.frames) painter.draw(frame);
  for (const FigureText& text : figure.texts) painter.draw(text);
  return encodePng(painter.picture(), metadata);
}

}  // namespace restlab
