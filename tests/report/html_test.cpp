// report.html as a file: complete or missing, escaped, limits stated.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "experiments/report/pixels.h"
#include "experiments/report/report_html.h"
#include "tests/report/sample.h"
#include "tests/report/xml.h"

namespace restlab::report_test {
namespace {

namespace fs = std::filesystem;

class HtmlTest : public testing::Test {
 protected:
  // Writes the report of a model and returns report.html.
  std::string report(const ReportModel& model) const {
    writeReport(folder_.path(), model);
    return readFile(folder_.path() / "report.html");
  }
  void expectError(const ReportModel& model, const std::vector<std::string>& fragments) const {
    try {
      writeReport(folder_.path(), model);
      FAIL() << "was not noticed";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      for (const std::string& fragment : fragments) {
        EXPECT_NE(std::string(error.what()).find(fragment), std::string::npos) << error.what();
      }
    }
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      EXPECT_EQ(entry.path().filename(), "images") << "something was left behind";
    }
  }
  // Returns the text between two marks.
  static std::string between(const std::string& text, const std::string& from,
                             const std::string& to) {
    const size_t begin = text.find(from);
    if (begin == std::string::npos) return "";
    const size_t end = text.find(to, begin + from.size());
    return text.substr(begin + from.size(), end - begin - from.size());
  }

  TemporaryFolder folder_;
  ReportModel model_ = sampleModel(folder_.path());
};

size_t occurrences(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST_F(HtmlTest, HasEveryPart) {
  const std::string html = report(model_);
  for (const char* part :
       {"A sample", "Does every part", "2026-01-02T03:04:05Z", "restlab run sample.toml",
        "<li>interrupted</li>", "href=\"#b-second\"", "does not count", "energy ratio 0.93",
        "MSE over time", "Time of each pass", "environment", "12,345", "Provenance", "two cores",
        "Whole images, 64x36 pixels"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(html, report(model_)) << "the same model gives the same bytes";
}

TEST_F(HtmlTest, PixelsAreThoseOfTheFiles) {
  const std::string html = report(model_);
  const std::string packed = between(html, "id=\"pixels-0-2\">", "</script>");
  const Image held = unpackPixels(packed, kSampleWidth, kSampleHeight);
  const LayeredImage file = readExr(folder_.path() / "images/gi.exr");
  EXPECT_EQ(std::memcmp(held.pixels.data(), file.layers.at("").pixels.data(),
                        held.pixels.size() * sizeof(glm::vec3)),
            0);
}

TEST_F(HtmlTest, FetchesNothing) {
  const std::string html = report(model_);
  for (const char* word :
       {"src=", "@import", "url(", "fetch(", "XMLHttpRequest", "<link", "import("}) {
    EXPECT_EQ(html.find(word), std::string::npos) << word;
  }
  // The only address is the namespace of SVG, which is never requested.
  EXPECT_EQ(occurrences(html, "://"), occurrences(html, "http://www.w3.org/2000/svg"));
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
}

TEST_F(HtmlTest, TextIsHarmless) {
  const std::string hostile = "<b>&\"'</script><img onerror=alert(1)>";
  ReportModel model = model_;
  for (const char* key : {"title", "question", "generated", "command"}) model[key] = hostile;
  model["notes"][0] = model["provenance"][0][0] = model["provenance"][0][1] = hostile;
  ReportModel& block = model["blocks"][0];
  for (const char* key : {"title", "subtitle", "row_title"}) block[key] = hostile;
  block["notes"] = {hostile};
  for (const char* key : {"title", "unit", "help"}) block["columns"][1][key] = hostile;
  block["rows"][1]["method"] = block["rows"][1]["flags"][0] = hostile;
  block["rows"][1]["cells"]["mse"]["note"] = hostile;
  block["plots"][0]["title"] = block["plots"][0]["series"][0]["name"] = hostile;
  block["bars"]["title"] = block["bars"]["rows"][0]["name"] = hostile;
  block["left_out"][0]["method"] = block["left_out"][0]["features"][0] = hostile;
  block["health"]["columns"][0]["name"] = block["health"]["rows"][0]["method"] = hostile;
  for (ReportModel& image : block["images"]) image["name"] = hostile;
  const std::string html = report(model);
  EXPECT_EQ(html.find("<img"), std::string::npos);
  EXPECT_EQ(html.find("<b>"), std::string::npos);
  // Each script that begins ends once: no data ended one early.
  EXPECT_EQ(occurrences(html, "<script"), occurrences(html, "</script>"));
  EXPECT_EQ(occurrences(html, "<script"), occurrences(report(model_), "<script"));
}

TEST_F(HtmlTest, TheFirstColumnSaysWhatRowsAre) {
  const auto head = [&](const ReportModel& model) {
    return between(report(model), "<table class=\"results\">", "</button>");
  };
  EXPECT_NE(head(model_).find(">method"), std::string::npos) << head(model_);
  ReportModel other = model_;
  other["blocks"][0]["row_title"] = "quantity";
  EXPECT_NE(head(other).find(">quantity"), std::string::npos) << head(other);
}

// The contents stay short: parts are listed under their whole.
TEST_F(HtmlTest, PartsAreListedUnderTheirWhole) {
  const auto contents = [&](const ReportModel& model) {
    return between(report(model), "<nav aria-label=\"Contents\">", "</nav>");
  };
  EXPECT_EQ(contents(model_).find("<details>"), std::string::npos);
  ReportModel parts = model_;
  parts["blocks"][1]["part_of"] = "first";
  const std::string list = contents(parts);
  EXPECT_EQ(occurrences(list, "href=\"#b-second\""), 1u) << list;
  const size_t open = list.find("<details>"), close = list.find("</details>");
  ASSERT_NE(close, std::string::npos) << list;
  EXPECT_LT(list.find("href=\"#b-first\""), open);
  EXPECT_LT(open, list.find("href=\"#b-second\""));
  EXPECT_LT(list.find("href=\"#b-second\""), close);
}

TEST_F(HtmlTest, NotesStandAboveTheTable) {
  ReportModel model = model_;
  model["blocks"][0]["notes"] = {"said of all rows"};
  const std::string html = report(model);
  const size_t note = html.find("<li>said of all rows</li>");
  ASSERT_NE(note, std::string::npos);
  EXPECT_LT(html.find("id=\"b-first\""), note);
  EXPECT_LT(note, html.find("<table class=\"results\">"));
}

TEST_F(HtmlTest, BestOfThoseThatCount) {
  const std::string html = report(model_);
  // Only the times (70, 8 that does not count, 86, 100) have a best: intervals of MSE overlap, and
  // its ratio has a single value that counts.
  const std::string table = between(html, "<table class=\"results\">", "</table>");
  EXPECT_EQ(occurrences(table, "num best\""), 1u)
      << "a single value has no best, nor have values that their intervals do not tell apart";
  EXPECT_NE(table.find("num best\" data-value=\"70\""), std::string::npos) << table;
  ReportModel decided = model_;
  for (ReportModel& row : decided["blocks"][0]["rows"]) {
    for (const char* end : {"lo", "hi"}) row["cells"]["mse"].erase(end);
  }
  const std::string apart = between(report(decided), "<table class=\"results\">", "</table>");
  EXPECT_EQ(occurrences(apart, "num best\""), 2u);
  EXPECT_NE(apart.find("num best\" data-value=\"0.029999999999999999\""), std::string::npos);
}

TEST_F(HtmlTest, LargeImagesAreCropsAndSaySo) {
  const Image reference = sampleReference(1600, 900);
  Image image = reference;
  for (uint32_t y = 100; y < 868; ++y) {
    for (uint32_t x = 200; x < 1565; ++x) image.at(x, y) *= 1.2f;
  }
  writeImage(folder_.path() / "images/reference.exr", reference);
  writeImage(folder_.path() / "images/path.exr", image);
  model_["blocks"][0]["images"].erase(2);
  const std::string html = report(model_);
  const std::string hint = between(html, "<p class=\"hint\">Crop ", "</p>");
  EXPECT_NE(hint.find("1365x768 at (200, 96) of 1600x900 pixels"), std::string::npos) << hint;
  EXPECT_NE(hint.find("where the relative error is largest"), std::string::npos) << hint;
  EXPECT_NE(hint.find("at most 1,048,576 pixels"), std::string::npos) << hint;
  const Image held = unpackPixels(between(html, "id=\"pixels-0-1\">", "</script>"), 1365, 768);
  EXPECT_EQ(held.at(10, 20), image.at(210, 116));
}

TEST_F(HtmlTest, ImageOfAnotherSizeIsAnError) {
  writeImage(folder_.path() / "images/path.exr", sampleReference(8, 8));
  expectError(model_, {"images/path.exr", "8x8", "64x36"});
}

TEST_F(HtmlTest, MissingImageIsAnError) {
  fs::remove(folder_.path() / "images/gi.exr");
  expectError(model_, {"images/gi.exr"});
}

TEST_F(HtmlTest, WrongModelIsAnError) {
  model_["blocks"][0].erase("rows");
  expectError(model_, {"blocks[0].rows: is missing"});
}

TEST_F(HtmlTest, PlotsAreFilesToo) {
  writePlots(folder_.path(), model_);
  size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_.path() / "plots")) {
    EXPECT_NO_THROW(parseXml(readFile(entry.path()))) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 2u);
  EXPECT_TRUE(fs::exists(folder_.path() / "plots/first-mse-time.svg"));
  EXPECT_TRUE(fs::exists(folder_.path() / "plots/first-bars.svg"));
}

}  // namespace
}  // namespace restlab::report_test
