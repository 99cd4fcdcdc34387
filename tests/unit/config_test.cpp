// core/base/config.h: typed values, places in messages, unknown keys.
#include "core/base/config.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace restlab {

namespace {

// Returns the message of the Error that `action` throws, which must be badUsage.
template <class Action>
std::string messageOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badUsage);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

ConfigTable parse(const std::string& text) { return ConfigTable::parseText(text, "a.toml"); }

TEST(Config, TypedValuesAndFallbacks) {
  const ConfigTable table = parse(
      "s = \"text\"\ni = -3\nd = 2.5\nwhole = 4\nb = true\nlist = [\"x\", \"y\"]\none = \"z\"\n"
      "numbers = [1, 2]\n");
  EXPECT_EQ(table.getString("s", ""), "text");
  EXPECT_EQ(table.getInteger("i", 0, -10, 10), -3);
  EXPECT_EQ(table.getNumber("d", 0.0), 2.5);
  EXPECT_EQ(table.getNumber("whole", 0.0), 4.0) << "an integer where a number is meant";
  EXPECT_TRUE(table.getBool("b", false));
  EXPECT_EQ(table.getStrings("list"), (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(table.getStrings("one"), std::vector<std::string>{"z"});
  EXPECT_EQ(table.getIntegers("numbers", {}, 0, 9), (std::vector<int64_t>{1, 2}));
  EXPECT_EQ(table.getNumbers("numbers", {}, 2, 0.0, 9.0), (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(table.getNumbers("absent", {0.5}, 3, 1.0, 9.0), std::vector<double>{0.5});
  EXPECT_EQ(table.getString("absent", "fallback"), "fallback");
  EXPECT_EQ(table.getInteger("absent", 0, 1, 2), 0) << "a fallback may lie outside the range";
  EXPECT_NO_THROW(table.finish());
}

TEST(Config, UnknownKeyNamesPlaceAndNearest) {
  const ConfigTable table = parse("name = \"n\"\n\n  sceen = \"x\"\nzzz = 1\n");
  table.getString("name", "");
  table.getString("scene", "");
  EXPECT_EQ(messageOf([&] { table.finish(); }),
            "a.toml:3:3: unknown key 'sceen', did you mean 'scene'?");
}

TEST(Config, FirstUnknownKeyInFileOrder) {
  // toml++ iterates alphabetically; the user reads from the top.
  const ConfigTable table = parse("zebra = 1\napple = 2\n");
  EXPECT_EQ(messageOf([&] { table.finish(); }).rfind("a.toml:1:1: unknown key 'zebra'", 0), 0u);
}

TEST(Config, WrongTypesAndRanges) {
  const ConfigTable table = parse(
      "s = 3\ni = 2.0\nb = 1\nbig = 11\nnan = nan\nlist = [\"a\", 3]\nchoice = \"rde\"\ndate = "
      "2020-01-01\n");
  EXPECT_EQ(messageOf([&] { table.getString("s", ""); }),
            "a.toml:1:5: 's' must be a string, not an integer");
  EXPECT_EQ(messageOf([&] { table.getInteger("i", 0, 0, 9); }),
            "a.toml:2:5: 'i' must be an integer, not a number");
  EXPECT_EQ(messageOf([&] { table.getBool("b", false); }),
            "a.toml:3:5: 'b' must be true or false, not an integer");
  EXPECT_EQ(messageOf([&] { table.getInteger("big", 0, 0, 10); }),
            "a.toml:4:7: 'big' must be in 0..10, not 11");
  EXPECT_EQ(messageOf([&] { table.getNumber("nan", 0.0, 0.0, 1.0); }),
            "a.toml:5:7: 'nan' must be in 0..1, not nan");
  EXPECT_EQ(messageOf([&] { table.getStrings("list"); }),
            "a.toml:6:14: 'list' must hold strings, not an integer");
  EXPECT_EQ(messageOf([&] {
              table.getChoice("choice", "", {"red", "green"});
            }),
            "a.toml:7:10: unknown choice 'rde', did you mean 'red'?");
  EXPECT_EQ(messageOf([&] { table.getNumber("date", 0.0); }),
            "a.toml:8:8: 'date' must be a number, not a date or time");
}

TEST(Config, SyntaxErrorNamesPlace) {
  const std::string message = messageOf([] { parse("a = 1\nb = [1,\n"); });
  EXPECT_EQ(message.rfind("a.toml:", 0), 0u) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_EQ(messageOf([] { parse("a = 1\na = 2\n"); }).rfind("a.toml:2:", 0), 0u);
  messageOf([] { ConfigTable::parseFile("/nonexistent/a.toml"); });
  messageOf([] { ConfigTable::parseFile("/"); });
}

TEST(Config, TablesInFileOrder) {
  const ConfigTable table =
      parse("[settings]\nruns = 2\n[[method]]\nname = \"z\"\n[[method]]\nname = \"a\"\ntypo = 1\n");
  EXPECT_EQ(table.getTable("settings").getInteger("runs", 0, 0, 9), 2);
  EXPECT_EQ(table.getTable("absent").getInteger("runs", 7, 0, 9), 7);
  const std::vector<ConfigTable> methods = table.getTables("method");
  ASSERT_EQ(methods.size(), 2u);
  EXPECT_EQ(methods[0].getString("name", ""), "z");
  EXPECT_EQ(methods[1].getString("name", ""), "a");
  EXPECT_NO_THROW(methods[0].finish());
  EXPECT_EQ(messageOf([&] { methods[1].finish(); }).rfind("a.toml:7:1: unknown key 'typo'", 0), 0u);
  messageOf([&] { table.getTables("settings"); });
}

TEST(Config, AssignedValuesNameTheirOption) {
  ConfigTable table = parse("runs = 2\n");
  table.assign("runs", "5", "--set runs");
  EXPECT_EQ(table.getInteger("runs", 0, 0, 9), 5);
  table.assign("runs", "50", "--set runs");
  EXPECT_EQ(messageOf([&] { table.getInteger("runs", 0, 0, 9); }),
            "--set runs: 'runs' must be in 0..9, not 50");
  table.assign("mode", "unbiased", "--set mode");  // a bare word
  EXPECT_EQ(table.getString("mode", ""), "unbiased");
  table.assign("list", "[\"a\", \"b\"]", "--set list");
  EXPECT_EQ(table.getStrings("list").size(), 2u);
  table.assign("rnus", "5", "--set rnus");
  EXPECT_EQ(messageOf([&] { table.finish(); }),
            "--set rnus: unknown key 'rnus', did you mean 'runs'?");
  // Another handle of the same table sees the value as well.
  ConfigTable inner = table.getTable("settings");
  inner.assign("width", "wide", "--set width");
  EXPECT_EQ(messageOf([&] { table.getTable("settings").getInteger("width", 0, 0, 9); }),
            "--set width: 'width' must be an integer, not a string");
}

TEST(Config, ParametersByTheirDeclaration) {
  ParameterInfo cap;
  cap.name = "cap";
  cap.defaultValue = 20.0;
  cap.minValue = 1.0;
  cap.maxValue = 100.0;
  ParameterInfo count;
  count.name = "count";
  count.defaultValue = int64_t(3);
  count.minValue = 0;
  count.maxValue = 8;
  ParameterInfo shade;
  shade.name = "shade";
  shade.defaultValue = std::string("winner");
  shade.choices = {"winner", "decoupled"};
  const ConfigTable table = parse("cap = 40\ncount = 9\nshade = \"decupled\"\n");
  EXPECT_EQ(std::get<double>(*table.getParameter(cap)), 40.0);
  EXPECT_EQ(messageOf([&] { table.getParameter(count); }),
            "a.toml:2:9: 'count' must be in 0..8, not 9");
  EXPECT_EQ(messageOf([&] { table.getParameter(shade); }),
            "a.toml:3:9: unknown shade 'decupled', did you mean 'decoupled'?");
  cap.name = "absent";
  EXPECT_FALSE(table.getParameter(cap).has_value());

  EXPECT_EQ(std::get<int64_t>(parseParameter(count, "4", "--set")), 4);
  EXPECT_EQ(std::get<std::string>(parseParameter(shade, "decoupled", "--set")), "decoupled");
  EXPECT_EQ(messageOf([&] { parseParameter(count, "4.5", "--set count=4.5"); }),
            "--set count=4.5: 'count' must be an integer, not a number");
  EXPECT_EQ(messageOf([&] { parseParameter(cap, "inf", "--set"); }),
            "--set: 'absent' must be in 1..100, not inf");
}

TEST(Config, Assignments) {
  EXPECT_EQ(splitAssignment("a=b=c"), (std::pair<std::string, std::string>("a", "b=c")));
  EXPECT_EQ(splitAssignment("a=").second, "");
  messageOf([] { splitAssignment("a"); });
  messageOf([] { splitAssignment("=a"); });
}

}  // namespace

}  // namespace restlab
