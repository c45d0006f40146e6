// Odd files and slips in the YAML: each is told at its place, by its code.
#include "tests/loop/recordings/bench.hpp"

namespace drycut::sim::recordings {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct OddFiles : RecordingTest {
  /// Channel a of column v over time t in seconds.
  Recording read(const std::string& text) {
    return loaded(text, "time: {column: t, unit: s}\nchannels: {a: {column: v, unit: V}}\n");
  }
};

TEST_F(OddFiles, ACommaBetweenCellsAndInNumbers) {
  for (const auto* text : {"t,v\n0,0,1,5\n0,1,1,6\n", "t,v\n0,1\n1,2,5\n"}) {
    EXPECT_EQ(guessed(text), "");
    EXPECT_THAT(codes(problems), ElementsAre("recording.ambiguous-comma")) << text;
    read(text);
    EXPECT_THAT(codes(problems), ElementsAre("recording.ambiguous-comma")) << text;
  }
  auto twincat_with_commas = separated(twincat, ',');
  twincat_with_commas.replace(twincat_with_commas.find("1.5"), 3, "1,5");
  EXPECT_EQ(guessed(twincat_with_commas), "");
  EXPECT_THAT(places(), ElementsAre("x.csv:17:1 recording.ambiguous-comma"));
}

TEST_F(OddFiles, ARowBehindTheBeginningWithMoreCells) {
  std::string text = "t,v\n";
  for (int i = 0; i < 600; ++i) text += std::to_string(i) + ",1\n";
  read(text + "600,1,5\n");
  EXPECT_THAT(places(), ElementsAre("x.csv:602:1 recording.cells"));
}

TEST_F(OddFiles, TwoRates) {
  // The header says 0.5 s, the column 1 s.
  loaded("Record Length,3\nSample Interval,0.5\nSecond,Volt\n0,1\n1,2\n2,3\n",
         "format: siglent\nchannels: {a: {column: 2, unit: V}}\n");
  EXPECT_THAT(doubts(), ElementsAre("4 recording.two-rates"));
  std::string text = "t,v\n";
  for (int i = 0; i < 50; ++i) text += std::to_string(i) + ",1\n";
  for (int i = 0; i < 50; ++i) text += std::to_string(50 + 4 * i) + ",1\n";
  read(text);
  EXPECT_THAT(doubts(), ElementsAre("53 recording.two-rates"));
}

TEST_F(OddFiles, EmptyCellsNanAndShortRowsAreNoSamples) {
  const auto made = read("t,v\n0,1\n1,\n2\n3,NaN\n4,5\n");
  EXPECT_THAT(made.series.at(0).value, ElementsAre(1, 5));
  EXPECT_THAT(doubts(), ElementsAre("5 recording.nan", "3 recording.empty-cells"));
  EXPECT_THAT(findings[1].text, HasSubstr("2 cells empty"));
}

TEST_F(OddFiles, SignsOfTheYamlThatLeaveNoData) {
  const std::string text = "t;v\n0,0;1,5\n0,1;1,6\n";
  const std::string channel = "time: {column: t, unit: s}\nchannels: {a: {column: v, unit: V}}\n";
  loaded(text, "separator: semicolon\ndecimal: point\n" + channel);
  EXPECT_THAT(places(), ElementsAre("3:10 recording.no-rows"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("decimal: comma"));
  loaded(text, "separator: tab\ndecimal: comma\n" + channel);
  EXPECT_THAT(places(), ElementsAre("2:12 recording.no-rows"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("separator: semicolon"));
  loaded(text, "separator: tab\ndecimal: point\n" + channel);
  EXPECT_THAT(places(), ElementsAre("2:12 recording.no-rows", "3:10 recording.no-rows"));
  loaded("t;v\nx;y\n", "separator: tab\n" + channel);
  EXPECT_THAT(places(), ElementsAre("x.csv:2:1 recording.no-rows")) << "no sign would help";
}

TEST_F(OddFiles, NumbersWithASignBetweenThousands) {
  for (const auto* text : {"Time [ms];Torque [%]\n0;1.234,5\n1;1.200,5\n2;999,5\n", "t;v\n0;1,234.5\n1;2\n",
                           "t;v\n0;-1'234.5\n1;2\n", "t;v\n0;1.234.567\n1;2,5\n"}) {
    EXPECT_EQ(guessed(text), "");
    EXPECT_THAT(places(), ElementsAre("x.csv:2:3 recording.not-a-number")) << text;
  }
  std::string text = "t;v\n";
  for (int i = 0; i < 600; ++i) text += std::to_string(i) + ";1,5\n";
  read(text + "600;1.234,5\n");
  EXPECT_THAT(places(), ElementsAre("x.csv:602:5 recording.not-a-number"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("1234,5"));
  EXPECT_THAT(guessed("t;v\n0;1,234\n1;1,235\n"), HasSubstr("decimal: comma")) << "decimals, no thousands";
}

TEST_F(OddFiles, RowsThatAreNotAllThere) {
  const std::string text = "t,v\n0,1\n1,2\n2,3\n";
  const std::string channel = "time: {column: t, unit: s}\nchannels: {a: {column: v, unit: V}}\n";
  loaded(text, "rows: [2, 9]\n" + channel);
  EXPECT_THAT(codes(findings), ElementsAre("recording.too-few-rows"));
  EXPECT_THAT(findings[0].text, HasSubstr("x.yaml:2:7: rows go to 9, the file has 3: 2 rows taken"));
  loaded(text, "rows: [2, 3]\n" + channel);
  EXPECT_THAT(findings, IsEmpty());
  loaded(text, "rows: [3, 2]\n" + channel);
  EXPECT_THAT(places(), ElementsAre("2:7 scenario.order"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("[2, 3]"));
}

TEST_F(OddFiles, AChannelThatIsNearlyOneOfTheMachines) {
  const std::string text = "t,v\n0,1\n1,2\n";
  const auto told = [&](const std::string& name) {
    loaded(text, "time: {column: t, unit: s}\nchannels: {" + name + ": {column: v, unit: V}}\n");
    EXPECT_THAT(problems, IsEmpty());
    return codes(findings);
  };
  EXPECT_THAT(told("axis.motor.torqe"), ElementsAre("recording.unknown-channel"));
  EXPECT_THAT(findings[0].text, HasSubstr("x.yaml:3:12: "));
  EXPECT_THAT(findings[0].text, HasSubstr("did you mean axis.motor.torque?"));
  EXPECT_THAT(told("AxisX.posit"), IsEmpty()) << "a device has it";
  EXPECT_THAT(told("hall.temperature_outside"), IsEmpty());
  EXPECT_THAT(told("torqe"), IsEmpty()) << "of no plant";
}

TEST_F(OddFiles, LostSamples) {
  read("t,v\n0,1\n1,1\n2,1\n\n5,1\n6,1\n7,1\n10,1\n11,1\n");
  EXPECT_THAT(doubts(), ElementsAre("6 recording.gap"));
  EXPECT_THAT(findings[0].text, HasSubstr("and 1 more"));
}

TEST_F(OddFiles, ATimeThatRepeats) {
  const auto made = read("t,v\n0,1\n1,2\n1,3\n2,4\n");
  EXPECT_THAT(made.series.at(0).value, ElementsAre(1, 2, 4));
  EXPECT_THAT(doubts(), ElementsAre("4 recording.time-repeats"));
}

TEST_F(OddFiles, ATimeThatGoesBack) {
  read("t,v\n0,1\n1,2\n0.5,3\n2,4\n");
  EXPECT_THAT(places(), ElementsAre("x.csv:4:1 recording.time-goes-back"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("rows: [1, 2]"));
}

TEST_F(OddFiles, ACellThatIsNoNumber) {
  read("t,v\n0,1\n1,2\n2,ERR\n3,4\n");
  EXPECT_THAT(places(), ElementsAre("x.csv:4:3 recording.not-a-number"));
  std::string text = "t,v\n0,1\n1,2\n";
  for (int i = 0; i < 1000; ++i) text += "2,x\n";
  read(text);
  EXPECT_EQ(problems.size(), 21u);
  EXPECT_EQ(problems.back().code, "text.too-many-problems");
}

TEST_F(OddFiles, NoRowsAndNoFile) {
  for (const auto* text : {"t,v\n", "\n\n", "t;v\nx;y\n"}) {
    read(text);
    EXPECT_THAT(codes(problems), ElementsAre("recording.no-rows")) << text;
  }
  read("");
  EXPECT_THAT(places(), ElementsAre("x.csv:1:1 recording.no-rows"));
  loaded("t,v\n0,1\n1,2\n",
         "time: {column: t, unit: s}\nrows: [7, 9]\nchannels: {a: {column: v, unit: V}}\n");
  EXPECT_THAT(codes(problems), ElementsAre("recording.no-rows"));
  read("t,v\n0,\n1,\n");
  EXPECT_THAT(places(), ElementsAre("3:24 recording.no-rows"));
  std::filesystem::remove(folder / "x.csv");
  Problems missing;
  load(read_recording_file(folder / "x.yaml", missing), missing, findings);
  EXPECT_THAT(codes(missing), ElementsAre("file.missing"));
  EXPECT_EQ(missing[0].file, (folder / "x.yaml").string());
  EXPECT_EQ(missing[0].column, 7);
}

TEST_F(OddFiles, WhatIsNoText) {
  read(
      std::string("\x7F"
                  "ELF\x01\0\0\n0,1\n",
                  12));
  EXPECT_THAT(places(), ElementsAre("x.csv:1:5 file.not-text"));
  read(std::string("\xFF\xFEt\0,\0v\0\n\0", 10));
  EXPECT_THAT(places(), ElementsAre("x.csv:1:1 file.not-text"));
}

TEST_F(OddFiles, ColumnsThatAreNotThere) {
  const std::string text = "t,Torque,Torque,Speed\n0,1,2,3\n1,1,2,3\n";
  loaded(text,
         "time: {column: t, unit: s}\n"
         "channels:\n"
         "  a: {column: Sped, unit: V}\n"
         "  b: {column: Torque, unit: V}\n"
         "  c: {column: 9, unit: V}\n"
         "  d: {column: 3, unit: V}\n");
  EXPECT_THAT(places(), ElementsAre("4:15 recording.unknown-column", "5:15 recording.column-twice",
                                    "6:15 recording.unknown-column"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("Speed"));
  EXPECT_THAT(problems[1].remedy, HasSubstr("2, 3"));
  EXPECT_THAT(guessed(text), HasSubstr("  Torque: {column: 2}"));
  EXPECT_THAT(guessed(text), HasSubstr("  Torque_2: {column: 3}"));
}

TEST_F(OddFiles, AColumnIsNamedWithoutItsUnitWhereThatIsUnique) {
  const auto made =
      loaded("time [s],axis.motor.torque [N m],M / Nm,v [mm],v [V]\n0,1,2,3,4\n1,1,2,3,4\n",
             "time: {column: time, unit: s}\n"
             "channels: {a: {column: axis.motor.torque, unit: N m}, b: {column: M, unit: N m}}\n");
  EXPECT_THAT(lines_of(problems), IsEmpty());
  ASSERT_EQ(made.series.size(), 2u);
  EXPECT_THAT(made.series[1].value, ElementsAre(2, 2));
  loaded("t [s],v [mm],v [V]\n0,3,4\n1,3,4\n",
         "time: {column: t, unit: s}\nchannels: {a: {column: v, unit: V}}\n");
  EXPECT_THAT(places(), ElementsAre("3:24 recording.column-twice"));
  loaded("v,v [V]\n0,3\n1,4\n", "time: {column: v, unit: s}\nchannels: {a: {column: \"v [V]\", unit: V}}\n");
  EXPECT_THAT(lines_of(problems), IsEmpty()) << "the whole name goes first";
}

TEST_F(OddFiles, ACountOfAnEncoderNeedsNothingMore) {
  const std::string begin = "time: {column: t, unit: s}\nchannels:\n  axis.encoder.count: {column: v, unit: ";
  loaded("t,v\n0,1\n1,2\n", begin + "counts}\n");
  EXPECT_THAT(lines_of(problems), IsEmpty());
  loaded("t,v\n0,1\n1,2\n", begin + "counts, of: 1 rev, full: 8192}\n");
  EXPECT_THAT(codes(problems), ElementsAre("scenario.wrong-unit"));
  EXPECT_THAT(problems[0].remedy, HasSubstr("leave of and full out"));
  loaded("t,v\n0,1\n1,2\n", begin + "mm}\n");
  EXPECT_THAT(problems[0].remedy, HasSubstr("in counts"));
}

TEST_F(OddFiles, NoTime) {
  loaded("a,b\n5,1\n4,2\n", "channels: {x: {column: b, unit: V}}\n");
  EXPECT_THAT(places(), ElementsAre("2:12 recording.no-time"));
  EXPECT_THAT(guessed("a,b\n5,1\n4,2\n6,2\n"), HasSubstr("THE FILE HAS NO TIME"));
  loaded("a,b\n5,1\n4,2\n", "time: {column: a}\nchannels: {x: {column: b, unit: V}}\n");
  EXPECT_THAT(places(), ElementsAre("2:8 recording.no-time"));
  loaded("time,b\n0,1\n1,2\n", "channels: {x: {column: b, unit: V}}\n");
  EXPECT_THAT(places(), ElementsAre("2:12 recording.no-time"));
}

TEST_F(OddFiles, UnitsOfAnotherDimension) {
  loaded("t,v\n0,1\n1,2\n",
         "time: {column: t, unit: mm}\n"
         "channels:\n"
         "  knife.motor.torque: {column: v, unit: \"%\"}\n"
         "  knife.motor.speed: {column: v, unit: 1/min}\n"
         "  knife.angle: {column: v, unit: counts, of: 3 mm}\n"
         "  a: {column: v}\n"
         "  b: {column: v, unit: furlongs_}\n"
         "  c: {column: v, unit: V, of: 3 mm}\n"
         "  d: {column: v, unit: counts, full: 100}\n"
         "  e: {column: v, unit: V, sign: 0.5}\n"
         "  f: {column: v, unit: V, colum: 3}\n");
  EXPECT_THAT(places(), ElementsAre("2:25 scenario.wrong-unit", "4:42 scenario.wrong-unit",
                                    "5:40 scenario.wrong-unit", "6:46 scenario.wrong-unit",
                                    "7:6 scenario.missing-key", "8:24 scenario.unknown-unit",
                                    "9:27 scenario.does-not-go-together", "10:32 scenario.needs-another",
                                    "11:33 scenario.out-of-range", "12:27 scenario.unknown-key"));
}

TEST_F(OddFiles, SlipsInTheYamlAreToldTogether) {
  loaded("t,v\n0,1\n",
         "format: twincut\n"
         "separator: comma\ndecimal: comma\n"
         "rows: [0, 3]\n"
         "time: {column: t, unit: s, rate: 1 kHz}\n");
  EXPECT_THAT(places(), ElementsAre("1:1 scenario.missing-key", "2:9 scenario.unknown-choice",
                                    "4:1 recording.ambiguous-comma", "5:7 scenario.out-of-range",
                                    "6:28 scenario.does-not-go-together"));
}

}  // namespace
}  // namespace drycut::sim::recordings
