// Checks of the report model: errors name the wrong field.
#include "experiments/report/report_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "tests/report/sample.h"

namespace restlab::report_test {
namespace {

struct Wrong {
  const char* name;
  const char* pointer;  // RFC 6901
  const char* value;    // JSON; "" removes the member
  const char* line;
};

class ModelTest : public testing::TestWithParam<Wrong> {
 protected:
  static ReportModel model() {
    static const TemporaryFolder folder;
    static const ReportModel sample = sampleModel(folder.path());
    return sample;
  }
};

TEST_F(ModelTest, SampleIsRight) { EXPECT_NO_THROW(checkReportModel(model())); }

TEST_F(ModelTest, SmallestIsRight) {
  EXPECT_NO_THROW(
      checkReportModel(ReportModel::parse(R"({"schema": 1, "title": "", "blocks": []})")));
}

TEST_P(ModelTest, ErrorNamesTheField) {
  const Wrong& wrong = GetParam();
  ReportModel json = model();
  const ReportModel::json_pointer at(wrong.pointer);
  if (*wrong.value) {
    json[at] = ReportModel::parse(wrong.value);
  } else {
    json[at.parent_pointer()].erase(at.back());
  }
  try {
    checkReportModel(json);
    FAIL() << "was not noticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    EXPECT_EQ(error.what(), std::string("report model: ") + wrong.line);
  }
}

const Wrong kWrong[] = {
    {"Schema", "/schema", "2", "schema: must be 1"},
    {"NoTitle", "/title", "", "title: is missing"},
    {"TitleNumber", "/title", "3", "title: must be a text"},
    {"Unknown", "/blocks/0/rowz", "[]", "blocks[0].rowz: unknown field; did you mean 'rows'?"},
    {"BlocksObject", "/blocks", "{}", "blocks: must be a list"},
    {"Note", "/notes/0", "false", "notes[0]: must be a text"},
    {"Provenance", "/provenance/1", "[\"a\"]", "provenance[1]: must be [key, value]"},
    {"IdTwice", "/blocks/1/id", "\"first\"", "blocks[1].id: 'first' is there twice"},
    {"BlockNote", "/blocks/0/notes", "[1]", "blocks[0].notes[0]: must be a text"},
    {"PartOfItself", "/blocks/0/part_of", "\"first\"",
     "blocks[0].part_of: must be the id of an earlier block"},
    {"PartOfALaterOne", "/blocks/0/part_of", "\"second\"",
     "blocks[0].part_of: must be the id of an earlier block"},
    {"IdPath", "/blocks/0/id", "\"../x\"",
     "blocks[0].id: must be of letters, digits, '.', '_', '-' and not start with '.'"},
    {"Better", "/blocks/0/columns/0/better", "\"low\"",
     "blocks[0].columns[0].better: must be one of lower, higher, none"},
    {"KeyTwice", "/blocks/0/columns/1/key", "\"time_ms\"",
     "blocks[0].columns[1].key: is there twice"},
    {"CellOfNoColumn", "/blocks/0/rows/0/cells/x", "{\"value\": 1}",
     "blocks[0].rows[0].cells.x: no column has this key"},
    {"CellValue", "/blocks/0/rows/0/cells/mse/value", "\"0.3\"",
     "blocks[0].rows[0].cells.mse.value: must be a number, \"nan\", \"inf\" or \"-inf\""},
    {"CellNull", "/blocks/0/rows/0/cells/mse/lo", "null",
     "blocks[0].rows[0].cells.mse.lo: must be a number, \"nan\", \"inf\" or \"-inf\""},
    {"Counts", "/blocks/0/rows/1/counts", "1", "blocks[0].rows[1].counts: must be true or false"},
    {"Warnings", "/blocks/0/rows/1/warnings", "[1]",
     "blocks[0].rows[1].warnings[0]: must be a text"},
    {"Intervals", "/blocks/0/plots/0/intervals", "\"lines\"",
     "blocks[0].plots[0].intervals: must be one of bands, bars"},
    {"Point", "/blocks/0/plots/0/series/1/points/2", "[1, 2, 3]",
     "blocks[0].plots[0].series[1].points[2]: must be [x, y] or [x, y, lo, hi]"},
    {"Hollow", "/blocks/0/plots/0/series/0/hollow", "[0, 6]",
     "blocks[0].plots[0].series[0].hollow[1]: must be the place of one of 6 points, from 0"},
    {"HollowText", "/blocks/0/plots/0/series/0/hollow", "[\"0\"]",
     "blocks[0].plots[0].series[0].hollow[0]: must be the place of one of 6 points, from 0"},
    {"Fit", "/blocks/0/plots/0/series/0/fit/slope", "",
     "blocks[0].plots[0].series[0].fit.slope: is missing"},
    {"Axis", "/blocks/0/plots/0/x/log", "\"yes\"",
     "blocks[0].plots[0].x.log: must be true or false"},
    {"NegativePart", "/blocks/0/bars/rows/0/parts/0/1", "-1",
     "blocks[0].bars.rows[0].parts[0][1]: must be a finite number of at least 0"},
    {"Feature", "/blocks/0/left_out/0/features", "\"none\"",
     "blocks[0].left_out[0].features: must be a list"},
    {"HealthWidth", "/blocks/0/health/rows/1/counts", "[1, 2]",
     "blocks[0].health.rows[1].counts: has 2 counts for 3 columns"},
    {"HealthCount", "/blocks/0/health/rows/1/counts/0", "1.5",
     "blocks[0].health.rows[1].counts[0]: must be a whole number of at least 0"},
    {"AbsoluteFile", "/blocks/0/images/0/file", "\"/etc/x.exr\"",
     "blocks[0].images[0].file: must be a path relative to the report's folder"},
    {"Role", "/blocks/0/images/1/role", "\"ref\"",
     "blocks[0].images[1].role: must be one of reference, method"},
    {"TwoReferences", "/blocks/0/images/1/role", "\"reference\"",
     "blocks[0].images[1].role: a block has one reference"},
    {"OpensOnTheReference", "/blocks/0/opens_on", "\"reference\"",
     "blocks[0].opens_on: must be the name of an image whose role is method"},
    {"Exposure", "/blocks/0/exposure", "0", "blocks[0].exposure: must be finite and above 0"},
    {"ExposureNan", "/blocks/0/exposure", "\"nan\"",
     "blocks[0].exposure: must be finite and above 0"},
};
INSTANTIATE_TEST_SUITE_P(, ModelTest, testing::ValuesIn(kWrong),
                         [](const auto& test) { return test.param.name; });

TEST(ReportNumber, KnowsWhatJsonLacks) {
  EXPECT_EQ(reportNumber(ReportModel(3)), 3.0);
  EXPECT_TRUE(std::isnan(reportNumber(ReportModel("nan"))));
  EXPECT_EQ(reportNumber(ReportModel("inf")), HUGE_VAL);
  EXPECT_EQ(reportNumber(ReportModel("-inf")), -HUGE_VAL);
}

}  // namespace
}  // namespace restlab::report_test
