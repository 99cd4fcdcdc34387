// Page of a report in a browser: tables, hostile text, light and dark.
#include "experiments/report/report_html.h"
#include "tests/report/page.h"

namespace restlab::report_test {
namespace {

using Names = std::vector<std::string>;

class ReportPage : public PageTest {
 protected:
  Names methods() { return texts("#b-first .results tbody .method"); }
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
