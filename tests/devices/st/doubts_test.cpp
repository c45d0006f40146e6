// What a text says that is no fault and hardly meant.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include "devices/plcopen/st/code.hpp"

namespace drycut::devices::plcopen::st {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> told(const std::string& text) {
  Problems problems;
  const Program program = compile(text, "p.st", problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  std::vector<std::string> texts;
  for (const auto& doubt : program.compiled().doubts)
    texts.push_back(fmt::format("{}:{}: {}", doubt.line, doubt.column, doubt.text));
  return texts;
}

const std::string head = "PROGRAM Main VAR_EXTERNAL Web : AXIS_REF; Knife : AXIS_REF; END_VAR VAR ";

TEST(StDoubts, ABlockThatNothingCalls) {
  EXPECT_THAT(told(head + "Power : MC_Power; ok : BOOL; END_VAR\nok := Power.Status;\nEND_PROGRAM\n"),
              ElementsAre("2:7: nothing calls Power (MC_Power): its outputs stay as they are at power-up"));
  EXPECT_THAT(told(head + "Power : MC_Power; ok : BOOL; END_VAR\nok := Power.Status;\n"
                          "Power(Axis := Knife, Enable := TRUE);\nEND_PROGRAM\n"),
              IsEmpty());
  EXPECT_THAT(
      told(head + "Pause : TON; ok : BOOL; END_VAR\nPause.IN := TRUE;\nok := Pause.Q;\nEND_PROGRAM\n"),
      ElementsAre("2:1: nothing calls Pause (TON): its outputs stay as they are at power-up"));
}

TEST(StDoubts, ABlockMayBeItsMethodsOnly) {
  EXPECT_THAT(
      told("FUNCTION_BLOCK Queue VAR_OUTPUT waiting : INT; END_VAR METHOD Put waiting := waiting + 1; "
           "END_METHOD "
           "END_FUNCTION_BLOCK " +
           head + "Orders : Queue; n : INT; END_VAR\nOrders.Put();\nn := Orders.waiting;\nEND_PROGRAM\n"),
      IsEmpty());
}

TEST(StDoubts, AVariableThatNothingSets) {
  EXPECT_THAT(told(head + "go, done : BOOL; END_VAR\ndone := go;\nEND_PROGRAM\n"),
              ElementsAre("2:9: go is read, and nothing sets it: it stays as it is at power-up"));
  // What a call takes by the pin's own name is not set by it.
  EXPECT_THAT(told(head + "Enable : BOOL; Power : MC_Power; END_VAR\n"
                          "Power(Axis := Knife, Enable := Enable);\nEND_PROGRAM\n"),
              ElementsAre("2:32: Enable is read, and nothing sets it: it stays as it is at power-up"));
  for (const auto* set : {"go := TRUE;", "Power(Axis := Knife, Enable := TRUE, Status => go);",
                          "FOR i := 0 TO 3 DO go := i = 2; END_FOR"})
    EXPECT_THAT(told(head + "go, done : BOOL; i : INT; Power : MC_Power; END_VAR\ndone := go;\n" + set +
                     "\nEND_PROGRAM\n"),
                IsEmpty())
        << set;
}

TEST(StDoubts, WhatHasAnInitialValueIsMeantToKeepIt) {
  EXPECT_THAT(told(head + "go : BOOL := FALSE; done : BOOL; END_VAR\ndone := go;\nEND_PROGRAM\n"), IsEmpty());
}

TEST(StDoubts, AVariableThatABlockMayChange) {
  EXPECT_THAT(told("FUNCTION_BLOCK Count VAR_IN_OUT n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK\n" +
                   head + "sum, all : INT; C : Count; END_VAR\nC(n := sum);\nall := sum;\nEND_PROGRAM\n"),
              IsEmpty());
}

TEST(StDoubts, ACamThatIsSelectedTheOtherWayRound) {
  const auto with = [&](const char* master, const char* slave) {
    return told(head + fmt::format("Select : MC_CamTableSelect; In : MC_CamIn; cam : MC_CAM_REF; END_VAR\n"
                                   "Select(Master := {}, Slave := {}, Execute := TRUE, CamTable := cam);\n"
                                   "In(Master := Web, Slave := Knife, Execute := Select.Done, CamTableID := "
                                   "Select.CamTableID);\nEND_PROGRAM\n",
                                   master, slave));
  };
  EXPECT_THAT(with("Web", "Knife"), IsEmpty());
  EXPECT_THAT(
      with("Knife", "Web"),
      ElementsAre("2:1: MC_CamTableSelect has the Master and the Slave of MC_CamIn the other way round"));
}

TEST(StDoubts, ABlockThatAssignsItsInput) {
  EXPECT_THAT(told("FUNCTION_BLOCK B VAR_INPUT n : INT; END_VAR\nn := n + 1;\nn := 0;\nEND_FUNCTION_BLOCK\n" +
                   head + "b : B; END_VAR\nb(n := 1);\nEND_PROGRAM\n"),
              ElementsAre("2:1: n is an input of B and is assigned here: what the caller gave is lost"));
}

}  // namespace
}  // namespace drycut::devices::plcopen::st
