// Page of a report in a browser: tables, hostile text, light and dark.
#include <algorithm>
#include <cmath>

#include "experiments/report/report_html.h"
#include "experiments/report/svg_style.h"
#include "tests/report/colour_distance.h"
#include "tests/report/page.h"

namespace restlab::report_test {
namespace {

using Names = std::vector<std::string>;

class ReportPage : public PageTest {
 protected:
  Names methods() { return texts("#b-first .results tbody .method"); }
  // Boxes whose content scrolls sideways, and the page if it does.
  Names sideways() {
    return browser_->evaluate(
        "Array.from(document.querySelectorAll('.scroll')).filter(box => box.scrollWidth > "
        "box.clientWidth).map(box => box.textContent.slice(0, 300)).concat("
        "document.documentElement.scrollWidth > innerWidth ? ['the page'] : [])");
  }
  std::string head(int column) {
    return "#b-first .results thead th:nth-child(" + std::to_string(column) + ")";
  }
};

TEST_F(ReportPage, TableSortsByNumbersAndNanStaysLast) {
  open(sampleModel(folder_.path()));
  const Names original = {"path", "gi biased", "gi unbiased", "broken"};
  EXPECT_EQ(methods(), original);

  // Time: lower is better, so the first click sorts ascending. As text, 100 would precede 70.
  click(head(2) + " button");
  EXPECT_EQ(methods(), (Names{"gi biased", "path", "gi unbiased", "broken"}));
  EXPECT_EQ(attribute(head(2), "aria-sort"), "ascending");
  click(head(2) + " button");
  EXPECT_EQ(methods(), (Names{"broken", "gi unbiased", "path", "gi biased"}));
  EXPECT_EQ(attribute(head(2), "aria-sort"), "descending");

  // MSE: NaN stays last both ways.
  click(head(3) + " button");
  EXPECT_EQ(methods(), (Names{"gi biased", "gi unbiased", "path", "broken"}));
  EXPECT_EQ(attribute(head(2), "aria-sort"), "none");
  click(head(3) + " button");
  EXPECT_EQ(methods(), (Names{"path", "gi unbiased", "gi biased", "broken"}));
  click(head(3) + " button");
  EXPECT_EQ(methods(), original) << "the third click";
  EXPECT_EQ(attribute(head(3), "aria-sort"), "none");

  // Ratio: higher is better. Missing cells stay last, in their order.
  click(head(4) + " button");
  EXPECT_EQ(methods(), (Names{"gi biased", "gi unbiased", "path", "broken"}));
  EXPECT_EQ(attribute(head(4), "aria-sort"), "descending");

  click(head(1) + " button");
  EXPECT_EQ(methods(), (Names{"broken", "gi biased", "gi unbiased", "path"}));
  EXPECT_EQ(texts("#b-second .results tbody .method"), original) << "the other table stays";
  screenshot("table");
}

TEST_F(ReportPage, TheWholeHeadingSorts) {
  open(sampleModel(folder_.path()));
  middle(head(2));
  const Json box = browser_->evaluate("(() => { const b = document.querySelector('" + head(2) +
                                      "').getBoundingClientRect(); return [b.x, b.y, b.right, "
                                      "b.bottom]; })()");
  browser_->click(double(box[0]) + 3.0, double(box[1]) + 3.0);
  settle();
  EXPECT_EQ(attribute(head(2), "aria-sort"), "ascending") << "the upper left corner";
  browser_->click(double(box[2]) - 3.0, double(box[3]) - 3.0);
  settle();
  EXPECT_EQ(attribute(head(2), "aria-sort"), "descending") << "the lower right corner";
}

TEST_F(ReportPage, OpensOnTheMethodThatIsNamed) {
  ReportModel model = sampleModel(folder_.path());
  model["blocks"][0]["opens_on"] = "gi unbiased";
  open(model);
  EXPECT_EQ(state("current"), "2");
  EXPECT_EQ(state("compare"), "0");
  EXPECT_EQ(state("mode"), "wipe");
}

// A block of long names, numbers of many digits and more columns than a window holds.
ReportModel wideBlock() {
  const std::string word = "a_word_of_many_letters_that_has_no_place_to_break";
  ReportModel block = {{"id", "wide"},
                       {"title", "wide"},
                       {"columns", ReportModel::array()},
                       {"rows", ReportModel::array()}};
  ReportModel cells = ReportModel::object(), heads = ReportModel::array();
  ReportModel counts = ReportModel::array();
  for (int i = 0; i < 30; ++i) {
    const std::string key = "c" + std::to_string(i);
    block["columns"].push_back({{"key", key},
                                {"title", i % 7 == 6 ? word : "MSE of path / MSE at equal time"},
                                {"unit", "ms"},
                                {"detail", i >= 9},
                                {"digits", i % 4 + 3}});
    cells[key] = {{"value", -1.234567e-15},
                  {"lo", -2.345678e-15},
                  {"hi", 3.456789e-15},
                  {"note", "at 12345 ms"}};
    heads.push_back("rejected_somethings");
    counts.push_back(123456789012 + i);
  }
  for (int i = 0; i < 3; ++i) {
    cells["c0"]["value"] = i;
    for (auto& [key, cell] : cells.items()) cell["value"] = double(cell["value"]) * 1.001;
    block["rows"].push_back({{"method", (i ? "a method of many words, " : "") + word},
                             {"counts", i < 2},
                             {"cells", cells}});
    for (auto& count : counts) count = count.get<uint64_t>() + 1;
    block["health"]["rows"].push_back({{"method", word}, {"counts", counts}});
    block["settings"].push_back({{"method", word}, {"text", word + word + word + word}});
    block["left_out"].push_back(
        {{"method", word}, {"features", ReportModel::array({word + std::to_string(i)})}});
  }
  block["health"]["columns"] = heads;
  return block;
}

TEST_F(ReportPage, NothingScrollsSideways) {
  ReportModel model = sampleModel(folder_.path());
  model["blocks"].push_back(wideBlock());
  model["provenance"].push_back({"device", std::string(400, 'x')});
  open(model);
  browser_->evaluate("document.querySelectorAll('details').forEach(one => { one.open = true; })");
  EXPECT_EQ(sideways(), Names{}) << "at 1280";
  screenshot("wide", true);
  browser_->resize(900, 700);
  settle();
  const Names at900 = sideways();
  EXPECT_TRUE(std::find(at900.begin(), at900.end(), "the page") == at900.end());
}

TEST_F(ReportPage, TableSortsByKeyboard) {
  open(sampleModel(folder_.path()));
  browser_->evaluate("document.querySelector('" + head(2) + " button').focus()");
  browser_->press("Enter", "Enter");
  settle();
  EXPECT_EQ(methods().front(), "gi biased");
}

TEST_F(ReportPage, TextOfOthersIsShownAsText) {
  const std::string hostile =
      "<b>&\"'</b></script><script>document.title='owned'</script><img src=x onerror=alert(1)>";
  ReportModel model = sampleModel(folder_.path());
  model["title"] = hostile;
  model["blocks"][0]["title"] = hostile;
  model["blocks"][0]["rows"][0]["method"] = hostile;
  model["blocks"][0]["plots"][0]["series"][0]["name"] = hostile;
  model["blocks"][0]["images"][1]["name"] = hostile;
  open(model);
  EXPECT_EQ(text("h1"), hostile);
  EXPECT_EQ(browser_->evaluate("document.title"), hostile);
  EXPECT_EQ(methods().front(), hostile);
  EXPECT_EQ(texts(".images .name").at(1), hostile);
  EXPECT_EQ(browser_->evaluate("document.querySelectorAll('img, b b').length"), 0);
}

TEST_F(ReportPage, DarkSchemeAndNarrowWindow) {
  open(sampleModel(folder_.path()));
  const auto ground = [&] {
    return browser_->evaluate("getComputedStyle(document.body).backgroundColor");
  };
  EXPECT_EQ(ground(), "rgb(255, 255, 255)");
  screenshot("page", true);
  browser_->setDark(true);
  EXPECT_NE(ground(), "rgb(255, 255, 255)");
  screenshot("page-dark", true);
  browser_->resize(400, 800);
  settle();
  // Only tables scroll sideways, not the page.
  EXPECT_EQ(browser_->evaluate("document.documentElement.scrollWidth"),
            browser_->evaluate("document.documentElement.clientWidth"));
  screenshot("page-narrow", true);
}

TEST_F(ReportPage, PlotsTakeTheColoursOfTheScheme) {
  open(sampleModel(folder_.path()));
  const std::string stroke = "getComputedStyle(document.querySelector('.plot .line')).stroke";
  const Json light = browser_->evaluate(stroke);
  EXPECT_EQ(light, "rgb(0, 114, 178)");
  browser_->setDark(true);
  EXPECT_NE(browser_->evaluate(stroke), light);
}

// A reader must not take the colour of a pass for that of a method, and must tell passes apart.
TEST_F(ReportPage, PassesHaveColoursOfTheirOwn) {
  open(sampleModel(folder_.path()));
  const auto expectApart = [](const Names& methods, const Names& passes) {
    for (size_t i = 0; i < passes.size(); ++i) {
      for (const std::string& method : methods)
        EXPECT_GT(colourDistance(passes[i], method), 0.09) << passes[i] << ' ' << method;
      for (size_t j = 0; j < i; ++j)
        EXPECT_GT(leastColourDistance(passes[i], passes[j]), 0.09) << passes[i] << ' ' << passes[j];
    }
  };
  Names methods, passes;
  for (size_t i = 0; i < svg::kColours; ++i) methods.emplace_back(svg::colour(i));
  for (size_t i = 0; i < svg::kPassColours; ++i) passes.emplace_back(svg::passColour(i));
  expectApart(methods, passes);
  for (const bool isDark : {false, true}) {
    browser_->setDark(isDark);
    const auto fills = [&](const std::string& letter) -> Names {
      return browser_->evaluate(
          "[0, 1, 2, 3, 4, 5, 6].map(i => getComputedStyle(document.body).getPropertyValue('--" +
          letter + "' + i).trim())");
    };
    expectApart(fills("c"), fills("p"));
    EXPECT_EQ(browser_->evaluate("(() => { const part = document.querySelector('.bars .part'); "
                                 "return getComputedStyle(part).fill; })()"),
              isDark ? "rgb(183, 148, 123)" : "rgb(122, 118, 149)");
  }
}

TEST_F(ReportPage, ReportWithoutImagesWorks) {
  ReportModel model = sampleModel(folder_.path());
  model["blocks"].erase(0);
  open(model);
  click("#b-second .results thead th:nth-child(2) button");
  EXPECT_EQ(texts("#b-second .results tbody .method").front(), "gi biased");
}

// Programs that take a screenshot do not scroll; viewers outside of the window cost nothing.
TEST_F(ReportPage, FirstImagesOpenAtOnceAndOthersWhenNear) {
  ReportModel model = sampleModel(folder_.path());
  model["blocks"][1]["images"] = model["blocks"][0]["images"];
  writeReport(folder_.path(), model);
  browser_->resize(500, 100);
  browser_->open(folder_.path() / "report.html");
  const auto isDrawn = [](int i) {
    return "document.querySelectorAll('.viewer')[" + std::to_string(i) +
           "].dataset.drawn !== undefined";
  };
  ASSERT_GT(browser_->evaluate("document.querySelector('.viewer').getBoundingClientRect().y"),
            700.0)
      << "farther away than an image that is opened because it is near";
  browser_->waitFor(isDrawn(0));
  settle();
  EXPECT_EQ(browser_->evaluate("scrollY"), 0);
  EXPECT_EQ(browser_->evaluate(isDrawn(1)), false);
  browser_->evaluate("document.querySelectorAll('.viewer')[1].scrollIntoView()");
  browser_->waitFor(isDrawn(1));
}

}  // namespace
}  // namespace restlab::report_test
