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
  block["rows"][1]["method"] = block["rows"][1]["warnings"][0] = hostile;
  block["rows"][2]["flags"] = {hostile, hostile + "2"};
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

// Adds a column whose cells are those numbers.
void addColumn(ReportModel& block, const std::string& key, bool isDetail,
               const std::vector<double>& values) {
  block["columns"].push_back({{"key", key}, {"title", key}, {"unit", "u"}, {"detail", isDetail}});
  for (size_t i = 0; i < values.size(); ++i)
    block["rows"][i]["cells"][key] = {{"value", values[i]}};
}

TEST_F(HtmlTest, EqualColumnsAreSaidOnce) {
  ReportModel& block = model_["blocks"][0];
  addColumn(block, "frames", true, {64, 64, 64, 64});
  addColumn(block, "bias", false, {0, 0, 0, 0});
  addColumn(block, "bytes", true, {8, 8, 8, 12});
  addColumn(block, "rays", true, {8, 8, 8});  // unknown in the last row
  const std::string html = report(model_);
  EXPECT_EQ(between(html, "<p class=\"once\">", "</p>"),
            "In all rows: <span>frames</span> 64 u. Zero in all rows: <span>bias</span>.");
  const std::string details = between(html, "<details class=\"more\">", "</details>");
  for (const char* key : {">bytes", ">rays"})
    EXPECT_NE(details.find(key), std::string::npos) << details;
  EXPECT_EQ(html.find("<button type=\"button\">frames"), std::string::npos);
  EXPECT_EQ(html.find("<button type=\"button\">bias"), std::string::npos);

  ReportModel one = model_;
  ReportModel& rows = one["blocks"][0]["rows"];
  rows = ReportModel::array({ReportModel(rows[3])});
  EXPECT_NE(report(one).find("<button type=\"button\">bias"), std::string::npos)
      << "a single row is a table";
}

TEST_F(HtmlTest, ATableKeepsItsColumnsWhereAllAreEqual) {
  ReportModel& block = model_["blocks"][1];
  block["columns"].erase(2);  // a ratio, which the first row does not have
  for (ReportModel& row : block["rows"]) row["cells"] = block["rows"][0]["cells"];
  const std::string table = between(report(model_), "id=\"b-second\"", "</table>");
  EXPECT_NE(table.find(">MSE</button>"), std::string::npos) << table;
}

TEST_F(HtmlTest, HealthAndFeaturesAreSaidOnce) {
  ReportModel& block = model_["blocks"][0];
  block["health"]["columns"] = {{{"name", "fault"}, {"bad", true}}, "quiet", "same", "differs"};
  block["health"]["rows"][0]["counts"] = {7, 0, 1234, 1};
  block["health"]["rows"][1]["counts"] = {7, 0, 1234, 2};
  block["left_out"][1]["features"] = {"environment", "textures", "volumes"};
  const std::string html = report(model_);
  const std::string health = between(html, "<h3>Numerical health</h3>", "</section>");
  EXPECT_EQ(between(health, "<p class=\"once\">", "</p>"),
            "In all rows: <span>same</span> 1,234. Zero in all rows: <span>quiet</span>.");
  EXPECT_EQ(occurrences(health, "num bad\" data-value=\"7\""), 2u)
      << "a fault stands beside its method";
  EXPECT_EQ(occurrences(health, "<button"), 3u) << "method, fault, differs";
  const std::string left = between(html, "<h3>Left out of the kernels</h3>", "<h3>");
  for (const char* feature : {"<li>textures</li>", "<li>environment</li>", "<li>volumes</li>"})
    EXPECT_EQ(occurrences(left, feature), 1u) << left;
  EXPECT_LT(left.find("environment"), left.find("<table")) << left;
  EXPECT_LT(left.find("gi unbiased"), left.find("volumes")) << left;

  block["health"]["rows"][0]["counts"] = block["health"]["rows"][1]["counts"] = {0, 0, 0, 0};
  block["left_out"][1]["features"] = block["left_out"][0]["features"];
  const std::string equal = report(model_);
  EXPECT_EQ(equal.find("<table class=\"health\">"), std::string::npos);
  EXPECT_EQ(equal.find("<table class=\"left-out\">"), std::string::npos);
}

TEST_F(HtmlTest, PicturesStandBeforeDetails) {
  addColumn(model_["blocks"][0], "detail", true, {1, 2, 3, 4});
  const std::string html = report(model_);
  size_t last = 0;
  for (const char* part :
       {"<table class=\"results\">", "<div class=\"viewer\"", "<div class=\"figures\">",
        "<details class=\"more\">", "Left out of the kernels", "Numerical health"}) {
    const size_t at = html.find(part);
    ASSERT_NE(at, std::string::npos) << part;
    EXPECT_GT(at, last) << part;
    last = at;
  }
}

TEST_F(HtmlTest, SeveralNotesAreALineThatOpens) {
  model_["blocks"][0]["rows"][2]["flags"] = {"first remark", "second remark"};
  model_["blocks"][0]["rows"][3]["flags"] = {"second remark"};
  const std::string html = report(model_);
  const std::string notes = between(html, "<details class=\"notes\">", "</details>");
  EXPECT_NE(notes.find("<summary><strong>2 notes</strong>"), std::string::npos) << notes;
  EXPECT_EQ(occurrences(notes, "first remark"), 2u) << "in the line and in the list";
  EXPECT_EQ(occurrences(notes, "second remark"), 1u) << "of two rows";
  EXPECT_EQ(notes.find("energy ratio 0.93"), std::string::npos) << "a warning is always shown";
  EXPECT_NE(html.find("<li class=\"no\"><span class=\"method\">gi biased</span>: energy ratio"),
            std::string::npos);
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
