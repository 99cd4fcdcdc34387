// Tests of hostile text inside markup and scripts, and of formatted numbers.
#include "experiments/report/text.h"

#include <gtest/gtest.h>

#include <limits>

namespace restlab {
namespace {

TEST(EscapeMarkup, LeavesNoMarkup) {
  EXPECT_EQ(escapeMarkup("<b>&\"'"), "&lt;b&gt;&amp;&quot;&#39;");
  EXPECT_EQ(escapeMarkup("</script><!--"), "&lt;/script&gt;&lt;!--");
  EXPECT_EQ(escapeMarkup("a b\tc\nd"), "a b\tc\nd");
}

TEST(CleanText, KeepsUnicode) {
  const std::string text = "\xc3\xa9 \xe2\x80\xa6 \xf0\x9f\x8c\x88";  // é … and a rainbow
  EXPECT_EQ(cleanText(text), text);
}

TEST(CleanText, ReplacesWhatXmlForbids) {
  const std::string bad = "\xef\xbf\xbd";
  EXPECT_EQ(cleanText(std::string("a\0b", 3)), "a" + bad + "b");
  EXPECT_EQ(cleanText("\x01\x1b[31m\x7f"), bad + bad + "[31m" + bad);
  EXPECT_EQ(cleanText("\xff\xfe"), bad + bad);
  EXPECT_EQ(cleanText("\xc3"), bad) << "cut off";
  EXPECT_EQ(cleanText("\xc0\xaf"), bad + bad) << "an overlong '/'";
  EXPECT_EQ(cleanText("\xed\xa0\x80"), bad + bad + bad) << "half a surrogate pair";
  EXPECT_EQ(cleanText("\xef\xbf\xbf"), bad + bad + bad) << "U+FFFF";
  EXPECT_EQ(cleanText("\xf4\x90\x80\x80"), bad + bad + bad + bad) << "above U+10FFFF";
}

TEST(ScriptJson, CannotEndAScript) {
  const nlohmann::ordered_json json = {{"</script>", "<!-- & \xe2\x80\xa8 \xff"}};
  const std::string text = scriptJson(json);
  EXPECT_EQ(text.find_first_of("<>&"), std::string::npos) << text;
  EXPECT_EQ(text.find("\xe2\x80\xa8"), std::string::npos) << "a line end in old scripts";
  const auto back = nlohmann::ordered_json::parse(text);
  EXPECT_EQ(back["</script>"], "<!-- & \xe2\x80\xa8 \xef\xbf\xbd");
}

TEST(Numbers, AreShort) {
  EXPECT_EQ(shortNumber(0.0123456), "0.0123");
  EXPECT_EQ(shortNumber(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(shortNumber(1.2), "1.20") << "the digits that count, zeros included";
  EXPECT_EQ(shortNumber(15.06), "15.1");
  EXPECT_EQ(shortNumber(999.6), "1000");
  EXPECT_EQ(shortNumber(1234.4), "1234");
  EXPECT_EQ(shortNumber(123.4), "123");
  EXPECT_EQ(shortNumber(-0.98), "-0.980");
  EXPECT_EQ(shortNumber(0.0000123), "1.23e-05");
  EXPECT_EQ(shortNumber(12345678.0), "1.23e+07");
  EXPECT_EQ(shortNumber(0.0), "0");
  EXPECT_EQ(shortNumber(64.0), "64");
  EXPECT_EQ(shortNumber(1.00212, kEnergyDigits), "1.002");
  EXPECT_EQ(intervalText(1.0, 2.5), " [1, 2.50]");
  EXPECT_EQ(intervalText(-std::numeric_limits<double>::infinity(), 1.0), " [unbounded, 1]");
  EXPECT_EQ(intervalText(std::numeric_limits<double>::quiet_NaN(), 1.0), "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(timesText(2.5, 2.0, 4.0, "lower", "higher"), "2.50x lower [2, 4]");
  EXPECT_EQ(timesText(0.25, 0.2, 0.5, "lower", "higher"), "4x higher [2, 5]");
  EXPECT_EQ(timesText(0.25, nan, nan, "lower", "higher"), "4x higher");
  EXPECT_EQ(timesText(0.25, 0.0, 0.5, "lower", "higher"), "4x higher [2, unbounded]");
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(intervalText(-inf, inf), " [unbounded]");
  EXPECT_EQ(intervalText(2.0, inf), " [2, unbounded]");
  for (const double end : {0.0, -1.0, -inf}) {
    EXPECT_EQ(timesText(9.99, end, 13.6, "lower", "higher"), "9.99x lower [unbounded, 13.6]");
    EXPECT_EQ(timesText(0.25, end, 0.5, "lower", "higher"), "4x higher [2, unbounded]");
  }
  EXPECT_EQ(timesText(0.25, 0.125, inf, "lower", "higher"), "4x higher [unbounded, 8]");
  EXPECT_EQ(apartNumbers(0.1, 0.2), std::pair(std::string("0.100"), std::string("0.200")));
  EXPECT_EQ(apartNumbers(0.10004, 0.1, 2),
            std::pair(std::string("0.10004"), std::string("0.10000")));
  EXPECT_EQ(apartNumbers(0.1, 0.1, 2), std::pair(std::string("0.10"), std::string("0.10")));
  EXPECT_EQ(timesText(0.0026, -inf, inf, "lower", "higher"), "385x higher [unbounded]");
  EXPECT_EQ(timesText(-0.25, nan, nan, "lower", "higher"), "not known");
  EXPECT_EQ(groupedDigits(0), "0");
  EXPECT_EQ(groupedDigits(999), "999");
  EXPECT_EQ(groupedDigits(1000), "1,000");
  EXPECT_EQ(groupedDigits(12582912), "12,582,912");
}

}  // namespace
}  // namespace restlab
