// Tests of the commands that a page may send, and of the replies to anything else.
#include "experiments/view/command.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace restlab {
namespace {

template <class Command>
Command read(const std::string& text) {
  return std::get<Command>(parseViewCommand(text));
}

TEST(ViewCommands, AreReadWithTheirValues) {
  const auto setting = read<SetSetting>(R"({"do":"set","pane":1,"key":"mode","value":"biased"})");
  EXPECT_EQ(setting.pane, 1u);
  EXPECT_EQ(setting.key, "mode");
  EXPECT_EQ(setting.value, "biased");
  const auto valueOf = [](const std::string& value) {
    return read<SetParameter>(R"({"do":"parameter","pane":0,"name":"x","value":)" + value + "}")
        .value;
  };
  EXPECT_EQ(valueOf("true"), std::optional<ParameterValue>(true));
  EXPECT_EQ(valueOf("3"), std::optional<ParameterValue>(int64_t{3}));
  EXPECT_EQ(valueOf("-3"), std::optional<ParameterValue>(int64_t{-3}));
  EXPECT_EQ(valueOf("3.5"), std::optional<ParameterValue>(3.5));
  EXPECT_EQ(valueOf("\"a\""), std::optional<ParameterValue>(std::string("a")));
  EXPECT_EQ(valueOf("null"), std::nullopt);
  const auto camera = read<MoveCamera>(
      R"({"do":"camera","to_world":[0,0,-1,0, 0,1,0,0, 1,0,0,0, 4,5,6,1],"yfov":0.5})");
  EXPECT_EQ(camera.toWorld[2], -1.0);
  EXPECT_EQ(camera.toWorld[13], 5.0);
  EXPECT_EQ(camera.yfov, 0.5);
  EXPECT_EQ(read<Resize>(R"({"do":"resolution","width":640,"height":360})").height, 360u);
  EXPECT_EQ(read<SetLight>(R"({"do":"light","name":"lamp","factor":0.25})").factor, 0.25);
  EXPECT_EQ(read<SetMaterial>(R"({"do":"material","name":"a","key":"b","value":"0.5"})").value,
            "0.5");
  EXPECT_FALSE(read<SetMaterial>(R"({"do":"material","name":"a","key":"b","value":null})").value);
  EXPECT_EQ(
      read<SetMaterial>(R"({"do":"material","name":"a","key":"b","value":null,"bases":2})").bases,
      2u);
  EXPECT_EQ(read<ShowLayer>(R"({"do":"layer","pane":0,"name":"age"})").name, "age");
  EXPECT_EQ(read<Probe>(R"({"do":"probe","pane":0,"x":3,"y":4})").y, 4u);
  EXPECT_FALSE(read<Pause>(R"({"do":"pause","on":false})").on);
  EXPECT_EQ(read<Look>(R"({"do":"look","on":true})").panes, ~uint64_t(0));
  EXPECT_EQ(read<Look>(R"({"do":"look","on":true,"panes":[0,2,63]})").panes,
            uint64_t(5) | uint64_t(1) << 63);
  EXPECT_EQ(read<Look>(R"({"do":"look","on":true,"panes":[]})").panes, 0u);
  EXPECT_FALSE(read<AdaptMotion>(R"({"do":"adaptive","on":false})").on);
  read<Restart>(R"({"do":"restart"})");
  const auto copy = read<CopyMethod>(R"({"do":"copy","from":1,"to":0})");
  EXPECT_EQ(copy.from, 1u);
  EXPECT_EQ(copy.to, 0u);
  read<Undo>(R"({"do":"undo"})");
  read<Redo>(R"({"do":"redo"})");
  EXPECT_EQ(read<SaveSession>(R"({"do":"save"})").name, "");
  EXPECT_EQ(read<SaveSession>(R"({"do":"save","name":"mine"})").name, "mine");
  EXPECT_EQ(read<Measure>(R"({"do":"measure","name":"mine"})").name, "mine");
  read<CancelMeasure>(R"({"do":"cancel"})");
  EXPECT_EQ(read<SavePicture>(R"({"do":"picture","image":64})").image, 64u);
  EXPECT_EQ(read<ShowTable>(R"({"do":"table","name":"a"})").name, "a");
}

TEST(ViewCommands, ThatAreWrongAreSaidInOneLine) {
  const std::pair<std::string, const char*> cases[] = {
      {R"({"do":"look","on":true,"panes":[64]})", "whole numbers from 0 to 63"},
      {R"({"do":"look","on":true,"panes":[-1]})", "whole numbers from 0 to 63"},
      {R"({"do":"look","on":true,"panes":2})", "must be a list"},
      {"", "must be a JSON object"},
      {"[]", "must be a JSON object"},
      {"{\"do\":\"pause\"", "must be a JSON object"},
      {"{}", "command: 'do' is missing"},
      {R"({"do":7})", "'do' must be a text"},
      {R"({"do":"pase"})", "did you mean 'pause'?"},
      {R"({"do":"pause"})", "command: pause: 'on' is missing"},
      {R"({"do":"pause","on":1})", "'on' must be true or false"},
      {R"({"do":"pause","on":true,"of":1})", "'of' is unknown; did you mean 'on'?"},
      {R"({"do":"set","pane":2,"key":"mode","value":""})",
       "'pane' must be a whole number from 0 to 1"},
      {R"({"do":"set","pane":0.5,"key":"mode","value":""})", "'pane' must be a whole number"},
      {R"({"do":"set","pane":0,"key":"mode","value":3})", "'value' must be a text"},
      {R"({"do":"parameter","pane":0,"name":"x","value":[1]})", "'value' must be a number"},
      {R"({"do":"parameter","pane":0,"name":"x","value":1e400})", "must be a JSON object"},
      {R"({"do":"parameter","pane":0,"name":"x","value":18446744073709551615})", "too large"},
      {R"({"do":"camera","to_world":[1,0,0,0]})", "'to_world' must be 16 numbers"},
      {R"({"do":"camera","to_world":[2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]})", "turn and move"},
      {R"({"do":"camera","to_world":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]})", "turn and move"},
      {R"({"do":"camera","to_world":[1,0,0,0, 0,1,0,0, 0,0,1,0, 1e10,0,0,1]})", "'to_world'[12]"},
      {R"({"do":"resolution","width":0,"height":4})",
       "'width' must be a whole number from 1 to 16384"},
      {R"({"do":"copy","from":0})", "copy: 'to' is missing"},
      {R"({"do":"copy","from":0,"to":2})", "'to' must be a whole number from 0 to 1"},
      {R"({"do":"undo","steps":2})", "undo: 'steps' is unknown"},
      {R"({"do":"picture","image":65})", "'image' must be a whole number from 0 to 64"},
      {R"({"do":"table"})", "table: 'name' is missing"},
      {R"({"do":"light","name":"a","factor":-1})", "'factor' must be a number from 0"},
      {R"({"do":"layer","pane":0,"name":")" + std::string(300, 'x') + "\"}", "at most 256 bytes"},
  };
  for (const auto& [text, says] : cases) {
    SCOPED_TRACE(text);
    try {
      parseViewCommand(text);
      ADD_FAILURE() << "was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badUsage);
      const std::string line = error.what();
      EXPECT_NE(line.find(says), std::string::npos) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
  }
}

// Deep nesting must not end the program.
TEST(ViewCommands, MayBeNestedDeeply) {
  EXPECT_THROW(parseViewCommand(std::string(60000, '[')), Error);
  EXPECT_THROW(parseViewCommand(std::string(30000, '[') + std::string(30000, ']')), Error);
}

}  // namespace
}  // namespace restlab
