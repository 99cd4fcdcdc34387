// Crop strips: pictures and frames at their places, pixels unblurred, text as text.
#include "experiments/report/figure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/image/io/srgb.h"
#include "experiments/report/series.h"
#include "tests/report/sample.h"
#include "tests/report/xml.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace restlab::report_test {
namespace {

// Decodes a PNG by another library.
Picture decodePng(const std::string& bytes) {
  int width = 0, height = 0, channels = 0;
  unsigned char* data = stbi_load_from_memory(reinterpret_cast<const unsigned char*>(bytes.data()),
                                              int(bytes.size()), &width, &height, &channels, 0);
  EXPECT_NE(data, nullptr) << stbi_failure_reason();
  Picture picture;
  if (!data) return picture;
  EXPECT_EQ(channels, 3);
  picture = {uint32_t(width), uint32_t(height), {data, data + size_t(width) * size_t(height) * 3}};
  stbi_image_free(data);
  return picture;
}

std::vector<int> pixelOf(const Picture& picture, double x, double y) {
  const auto at =
      picture.bytes.begin() + std::ptrdiff_t(3 * (size_t(y) * picture.width + size_t(x)));
  return {at[0], at[1], at[2]};
}

std::vector<int> srgbOf(const Image& image, uint32_t x, uint32_t y, float exposure) {
  const std::vector<uint8_t> bytes = srgbBytes(Image(1, 1, image.at(x, y)), exposure);
  return {bytes.begin(), bytes.end()};
}

class FigureTest : public testing::Test {
 protected:
  FigureTest() {
    spec_.full = &reference_;
    spec_.fullLabel = "a <scene>";
    spec_.metric = "mse";
    spec_.crops = {{10, 8, 16, 12}, {40, 20, 16, 12}};
    spec_.columns = {{"path", &path_, "0.5", {}, false}, {"reference", &reference_, "", {}, false}};
    spec_.exposure = 1.5f;
    spec_.scale = 8;
  }
  Image reference_ = sampleReference(64, 36), path_ = noisy(reference_, 1.0f, 3);
  FigureSpec spec_;
};

TEST_F(FigureTest, PngOfPicturesComesBack) {
  Picture picture = pictureOf(path_, {3, 2, 20, 10}, 1.5f, 3);
  EXPECT_EQ(picture.width, 60u);
  const Picture back = decodePng(encodePng(picture));
  EXPECT_EQ(back.width, picture.width);
  EXPECT_EQ(back.height, picture.height);
  EXPECT_EQ(back.bytes, picture.bytes);
}

TEST_F(FigureTest, EnlargedPixelsAreSquares) {
  const Picture picture = pictureOf(path_, {3, 2, 20, 10}, 1.5f, 3);
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (uint32_t x = 0; x < picture.width; ++x) {
      ASSERT_EQ(pixelOf(picture, x, y), srgbOf(path_, 3 + x / 3, 2 + y / 3, 1.5f));
    }
  }
}

TEST_F(FigureTest, ResizingKeepsTheMean) {
  const auto mean = [](const Image& image) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& pixel : image.pixels) sum += glm::dvec3(pixel);
    return sum / double(image.pixels.size());
  };
  for (const auto& [width, height] :
       {std::pair(37u, 21u), std::pair(5u, 3u), std::pair(100u, 50u)}) {
    const Image other = resized(path_, width, height);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean(other)[c], mean(path_)[c], 1e-5);
  }
  EXPECT_EQ(resized(path_, 64, 36).pixels, path_.pixels) << "the same size is the same image";
}

TEST_F(FigureTest, SvgHasTheCropsOfEachImage) {
  const XmlElement svg = parseXml(figureSvg(layOutFigure(spec_)));
  const auto images = findAll(svg, "image");
  ASSERT_EQ(images.size(), 5u) << "the whole image, two crops of two images";
  const std::string prefix = "data:image/png;base64,";
  const auto picture = [&](size_t i) {
    return decodePng(decodeBase64(images[i]->attributes.at("href").substr(prefix.size())));
  };
  // Pictures come column by column, with 8 output pixels per pixel.
  EXPECT_EQ(picture(2).width, 16u * 8u);
  EXPECT_EQ(pixelOf(picture(2), 8 * 5 + 3, 8 * 7 + 1), srgbOf(path_, 45, 27, 1.5f));
  EXPECT_EQ(pixelOf(picture(3), 8 * 5 + 3, 8 * 7 + 1), srgbOf(reference_, 15, 15, 1.5f));
  EXPECT_EQ(images[1]->number("y"), images[3]->number("y")) << "crops of one place are one row";
  EXPECT_EQ(images[1]->number("x"), images[2]->number("x")) << "crops of one image are one column";
}

TEST_F(FigureTest, ASeriesIsARowOfWholePictures) {
  const std::vector<SeriesPicture> pictures = {{"one", reference_}, {"two", path_}};
  const Figure figure = layOutSeries(pictures, "title", 1.5f);
  ASSERT_EQ(figure.pictures.size(), 2u);
  EXPECT_EQ(figure.pictures[0].y, figure.pictures[1].y);
  EXPECT_GT(figure.pictures[1].x, figure.pictures[0].x + 64.0);
  EXPECT_GT(figure.width, figure.pictures[1].x + 64.0);
  EXPECT_EQ(pixelOf(figure.pictures[1].picture, 5, 7), srgbOf(path_, 5, 7, 1.5f));
  ASSERT_EQ(figure.texts.size(), 3u);
  EXPECT_EQ(figure.texts[1].text, "two");
  EXPECT_EQ(figure.texts[1].x, figure.pictures[1].x + 32.0);
  EXPECT_LT(figure.texts[1].y, figure.pictures[1].y);
  EXPECT_GT(figure.texts[2].y, figure.pictures[1].y + 36.0) << "the title stands below";
  const XmlElement svg = parseXml(figureSvg(figure));
  EXPECT_EQ(findAll(svg, "image").size(), 2u);
  EXPECT_EQ(layOutSeries({{"a label that is far too long", path_}}, "", 1.0f).cutLabels.size(), 1u);
}

TEST_F(FigureTest, FramesAreWhereTheCropsAre) {
  const Figure figure = layOutFigure(spec_);
  const FigurePicture& full = figure.pictures[0];
  // Each crop has a white frame with a coloured one inside.
  const FigureFrame& frame = figure.frames[3];
  const double scale = full.height / 36.0;
  EXPECT_NEAR(frame.x - full.x, 40.0 * scale, 1e-9);
  EXPECT_NEAR(frame.y - full.y, 20.0 * scale, 1e-9);
  EXPECT_NEAR(frame.width, 16.0 * scale, 1e-9);
  EXPECT_EQ(frame.colour, figure.frames[5].colour) << "the same colour about its second row";
  EXPECT_NE(frame.colour, figure.frames[4].colour);
}

TEST_F(FigureTest, NothingOverlapsAndAllIsInside) {
  spec_.columns[0].cropErrors = {"0.1", "0.2"};
  spec_.columns[1].cropErrors = {"", ""};
  const Figure figure = layOutFigure(spec_);
  for (size_t i = 0; i < figure.pictures.size(); ++i) {
    const FigurePicture& a = figure.pictures[i];
    EXPECT_LE(a.x + a.width, figure.width);
    EXPECT_LE(a.y + a.height, figure.height);
    for (size_t k = i + 1; k < figure.pictures.size(); ++k) {
      const FigurePicture& b = figure.pictures[k];
      const bool apart = a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y ||
                         b.y + b.height <= a.y;
      EXPECT_TRUE(apart) << i << " and " << k;
    }
  }
  for (const FigureText& text : figure.texts) EXPECT_LT(text.y, figure.height);
}

TEST_F(FigureTest, TextIsTextAndHarmless) {
  spec_.columns[0].label = "<b>&\"";
  const XmlElement svg = parseXml(figureSvg(layOutFigure(spec_)));
  std::vector<std::string> texts;
  for (const XmlElement* text : findAll(svg, "text")) texts.push_back(text->text);
  const std::vector<std::string> expected = {"a <scene>", "<b>&\"", "0.5", "reference", "mse"};
  EXPECT_EQ(texts, expected);
}

TEST_F(FigureTest, LabelsThatDoNotFitAreNamed) {
  EXPECT_TRUE(layOutFigure(spec_).cutLabels.empty());
  spec_.columns[0].label = "a label that is much longer than any column of this figure is wide";
  const Figure figure = layOutFigure(spec_);
  ASSERT_EQ(figure.cutLabels.size(), 1u);
  EXPECT_EQ(figure.cutLabels[0], spec_.columns[0].label);
}

TEST_F(FigureTest, PngIsTheSamePicture) {
  const Figure figure = layOutFigure(spec_);
  const Picture png = decodePng(figurePng(figure));
  EXPECT_EQ(png.width, uint32_t(figure.width));
  EXPECT_EQ(png.height, uint32_t(figure.height));
  const FigurePicture& crop = figure.pictures[2];
  EXPECT_EQ(pixelOf(png, crop.x + 8 * 5 + 3, crop.y + 8 * 7 + 1), srgbOf(path_, 45, 27, 1.5f));
  EXPECT_EQ(pixelOf(png, crop.x - 1, crop.y + 20), (std::vector<int>{0x56, 0xb4, 0xe9})) << "frame";
  // The label has some dark pixels.
  const FigureText& label = figure.texts[1];
  size_t dark = 0;
  for (double x = label.x - 20; x < label.x + 20; x += 1.0) {
    for (double y = label.y - 12; y < label.y; y += 1.0) dark += pixelOf(png, x, y)[0] < 128;
  }
  EXPECT_GT(dark, 20u);
}

}  // namespace
}  // namespace restlab::report_test
