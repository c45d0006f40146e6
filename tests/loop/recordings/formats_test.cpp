// What each tool's export is taken for, and what comes of its numbers.
#include <numbers>

#include "tests/loop/recordings/bench.hpp"

namespace drycut::sim::recordings {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Pointwise;

struct Formats : RecordingTest {};

MATCHER(IsNearly, "") { return std::abs(std::get<0>(arg) - std::get<1>(arg)) < 1e-9; }
auto near(const std::vector<double>& wanted) { return Pointwise(IsNearly(), wanted); }

constexpr const char* of_twincat =
    "format: twincat\n"
    "channels:\n"
    "  knife.motor.torque: {column: ActTorque, unit: \"%\", of: 20 N m, sign: -1}\n"
    "  web.speed: {column: ActVelo, unit: mm/s, delay: 1 ms}\n"
    "  other: {column: 5, unit: counts}\n";

TEST_F(Formats, TwincatHasTheTimeOfEachChannelBesideIt) {
  const auto read = loaded(twincat, of_twincat);
  EXPECT_THAT(lines_of(problems), IsEmpty());
  ASSERT_EQ(read.series.size(), 3u);
  EXPECT_EQ(read.rows, 4u);
  EXPECT_EQ(read.series[0].unit, "N m");
  EXPECT_THAT(read.series[0].time_s, near({0, 0.001, 0.002, 0.003}));
  EXPECT_THAT(read.series[0].value, near({-2, -2.2, 2.4, -2.6}));
  EXPECT_EQ(read.series[1].unit, "m/s");
  EXPECT_THAT(read.series[1].time_s, near({-0.001, 0, 0.001, 0.002}));
  EXPECT_THAT(read.series[1].value, near({0.0015, 0.0025, 0.0035, 0.0045}));
  EXPECT_THAT(read.series[2].time_s, near({-0.003, 0.002, 0.007}));
  EXPECT_THAT(read.series[2].value, near({100, 101, 102}));
}

TEST_F(Formats, TwincatIsReadWithEverySeparator) {
  for (const char separator : {'\t', ';', ',', ' ', ':'}) {
    SCOPED_TRACE(separator);
    // A name with a blank would tear with blanks between cells, the time of day with colons.
    const auto text = separated(twincat, separator);
    EXPECT_THAT(guessed(text), HasSubstr("format: twincat\n"));
    EXPECT_THAT(lines_of(problems), IsEmpty());
    const auto read = loaded(text, of_twincat);
    EXPECT_THAT(lines_of(problems), IsEmpty());
    ASSERT_EQ(read.series.size(), 3u);
    EXPECT_THAT(read.series[0].value, near({-2, -2.2, 2.4, -2.6}));
    EXPECT_THAT(read.series[1].value, near({0.0015, 0.0025, 0.0035, 0.0045}));
  }
}

TEST_F(Formats, TwincatGuessSaysWhatIsOpen) {
  const auto yaml = guessed(twincat);
  EXPECT_THAT(yaml, HasSubstr("separator: tab\ndecimal: point\n"));
  EXPECT_THAT(yaml, HasSubstr("  ActTorque: {column: ActTorque, unit: \"%\"}  # of what is not in the file"));
  EXPECT_THAT(yaml, HasSubstr("  ActVelo: {column: ActVelo, unit: mm/s}\n"));
  EXPECT_THAT(yaml, HasSubstr("# ADD unit:, which is not in the file"));
  EXPECT_THAT(yaml, HasSubstr("Unit ScaleFactor -10: the file does not say whether that was applied"));
}

TEST_F(Formats, TwincatEndsWithTheLineEofOrWithout) {
  loaded(twincat + "EOF\n", of_twincat);
  EXPECT_THAT(lines_of(problems), IsEmpty());
}

TEST_F(Formats, DecimalCommaBesideDecimalPointsOfTheHeader) {
  auto text = twincat;
  for (const auto* number : {"1.5\t", "2.5\t", "3.5\t", "4.5\t"}) text[text.find(number) + 1] = ',';
  EXPECT_THAT(guessed(text), HasSubstr("decimal: comma\n"));
  EXPECT_THAT(loaded(text, of_twincat).series.at(1).value, near({0.0015, 0.0025, 0.0035, 0.0045}));
}

TEST_F(Formats, MrConfigurator2HasItsNamesInTheRowOfUnits) {
  const auto yaml = guessed(mr_configurator2);
  EXPECT_THAT(yaml, HasSubstr("format: mr_configurator2\n"));
  EXPECT_THAT(
      yaml,
      HasSubstr(
          "time: {column: Time, unit: ms}  # the header says 0.000667 s a sample; the column is taken"));
  EXPECT_THAT(yaml,
              HasSubstr("  Servo_motor_speed: {column: Servo motor speed, unit: rpm, clipped: -32768}"));
  EXPECT_THAT(yaml, HasSubstr("  Torque: {column: Torque, unit: \"%\", clipped: -32768}  # of what"));
  EXPECT_THAT(yaml, HasSubstr("unit: counts, clipped: -32768}  # an encoder's count"));
  EXPECT_THAT(yaml, Not(HasSubstr("Digital")));
}

TEST_F(Formats, MrConfigurator2MarksWhatIsClipped) {
  const auto read =
      loaded(mr_configurator2,
             "format: mr_configurator2\n"
             "channels:\n"
             "  knife.motor.speed: {column: Servo motor speed, unit: rpm}\n"
             "  knife.droop: {column: 4, unit: counts, of: 1 rev, full: 8192, clipped: -32768}\n");
  EXPECT_THAT(lines_of(problems), IsEmpty());
  ASSERT_EQ(read.series.size(), 2u);
  EXPECT_EQ(read.series[0].unit, "rad/s");
  EXPECT_THAT(read.series[0].time_s, near({0, 0.000666666, 0.001333333, 0.002}));
  EXPECT_NEAR(read.series[0].value[0], 2 * std::numbers::pi, 1e-12);
  EXPECT_EQ(read.series[1].unit, "rad");
  EXPECT_NEAR(read.series[1].value[0], 100 * 2 * std::numbers::pi / 8192, 1e-12);
  EXPECT_THAT(read.series[1].clipped, ElementsAre(1u));
  EXPECT_THAT(doubts(), ElementsAre("7 recording.clipped"));
}

TEST_F(Formats, RigolsTimeIsComputed) {
  const std::string text =
      "X,CH1,Start,Increment,\nSequence,Volt,-1.2e-04,2e-07\n0,0.12,\n1,0.14,\n2,0.16,\n";
  const auto yaml = guessed(text);
  EXPECT_THAT(yaml, HasSubstr("format: rigol\n"));
  EXPECT_THAT(yaml, HasSubstr("time: {column: X, rate: 5000000 Hz, start: -0.00012 s}"));
  EXPECT_THAT(yaml, HasSubstr("  CH1: {column: CH1, unit: V}\n"));
  const auto read = loaded(text, yaml.substr(yaml.find("format:")));
  EXPECT_THAT(read.series.at(0).time_s, near({-1.2e-4, -1.198e-4, -1.196e-4}));
  EXPECT_THAT(read.series.at(0).value, near({0.12, 0.14, 0.16}));
  // Without an index.
  const auto bare = loaded("CH1,Start,Increment,\nVolt,1,0.5\n0.12,\n0.14,\n",
                           "format: rigol\nchannels: {a: {column: CH1, unit: V}}\n");
  EXPECT_THAT(bare.series.at(0).time_s, near({1, 1.5}));
}

TEST_F(Formats, SiglentsHeaderIsOfAnyLength) {
  for (const auto* rate :
       {"Sample Rate,1000.0\n", "Sample Interval,Analog:0.001\nModel Number,SDS1104X-E\n"}) {
    const auto text = std::string("Record Length,Analog:14000\n") + rate +
                      "Vertical Scale,CH1: 0.05\nHorizontal Scale, 0.00001\nSecond,Volt\n"
                      "-0.001,-0.194\n0,-0.192\n0.001,-0.196\n";
    const auto yaml = guessed(text);
    EXPECT_THAT(yaml, HasSubstr("format: siglent\n"));
    EXPECT_THAT(yaml, HasSubstr("time: {column: Second, unit: s}"));
    EXPECT_THAT(yaml, HasSubstr("  CH1: {column: CH1, unit: V}\n"));
    EXPECT_THAT(loaded(text, yaml.substr(yaml.find("format:"))).series.at(0).time_s,
                near({-0.001, 0, 0.001}));
    EXPECT_THAT(findings, IsEmpty());
  }
}

TEST_F(Formats, HalsamplerHasNeitherHeaderNorTime) {
  const std::string text = "0 1.5 -2\n1  2.5 -3 \n2 3.5 -4\n4 4.5 -5\n";
  const auto yaml = guessed(text);
  EXPECT_THAT(yaml, HasSubstr("format: halsampler\n"));
  EXPECT_THAT(yaml, HasSubstr("time: {column: 1}  # it counts samples; ADD THEIR RATE"));
  EXPECT_THAT(yaml, HasSubstr("  column_2: {column: 2}  # ADD unit:"));
  const auto read = loaded(text,
                           "format: halsampler\ntime: {column: 1, rate: 1 kHz}\n"
                           "channels: {x: {column: 2, unit: mm}}\n");
  EXPECT_THAT(read.series.at(0).time_s, near({0, 0.001, 0.002, 0.004}));
  EXPECT_THAT(doubts(), ElementsAre("4 recording.gap"));
}

TEST_F(Formats, PlainTextWithUnitsBehindOrBelowItsNames) {
  EXPECT_THAT(guessed("Time [ms];Torque (N m);pos (5)\n0,5;1,5;7\n1,5;2,5;8\n"),
              testing::AllOf(HasSubstr("format: csv\nseparator: semicolon\ndecimal: comma\n"),
                             HasSubstr("time: {column: \"Time [ms]\", unit: ms}"),
                             HasSubstr("  Torque: {column: \"Torque (N m)\", unit: N m}\n"),
                             HasSubstr("  pos: {column: \"pos (5)\"}  # ADD unit:")));
  EXPECT_THAT(guessed("t [s];speed [1/min]\n0;1\n1;2\n"),
              HasSubstr("  speed: {column: \"speed [1/min]\", unit: rpm}\n"));
  EXPECT_THAT(guessed("t,speed\ns,1/min\n0,1\n1,2\n"),
              testing::AllOf(HasSubstr("time: {column: t, unit: s}"),
                             HasSubstr("  speed: {column: speed, unit: rpm}\n")));
}

TEST_F(Formats, UnitsInBracketsBelowTheNamesOrBehindASlash) {
  for (const auto* text :
       {"Time;Torque;Speed;Pos\n[s];[Nm];[min-1];[Inkr.]\n0.000;1.25;60;1\n0.001;1.35;61;2\n",
        "Time / s;Torque / Nm;Speed / 1/min;Pos / Inc\n0.000;1.25;60;1\n0.001;1.35;61;2\n"}) {
    const auto yaml = guessed(text);
    EXPECT_THAT(yaml, testing::ContainsRegex("time: .column: .*Time.*, unit: s."));
    EXPECT_THAT(yaml, testing::ContainsRegex("  Torque: .column: .*Torque.*, unit: Nm."));
    EXPECT_THAT(yaml, testing::ContainsRegex("  Speed: .column: .*Speed.*, unit: rpm."));
    EXPECT_THAT(yaml, testing::ContainsRegex("  Pos: .column: .*Pos.*, unit: counts.")) << text;
    EXPECT_THAT(yaml, Not(HasSubstr("ADD")));
  }
}

TEST_F(Formats, TimesOfDayNeedNoUnit) {
  for (const auto* name : {"Timestamp", "A"}) {
    const auto text =
        std::string(name) + ";v [mm/s]\n2026-11-20 10:12:33.000;60\n2026-11-20 10:12:33.500;61\n";
    const auto yaml = guessed(text);
    EXPECT_THAT(yaml, HasSubstr(std::string("time: {column: ") + name + ", unit: s}  # times of day\n"));
    EXPECT_THAT(yaml, Not(HasSubstr("ADD")));
    // They say their unit themselves.
    const auto read = loaded(text, std::string("time: {column: ") + name +
                                       ", unit: ms}\nchannels: {a: {column: 2, unit: mm/s}}\n");
    ASSERT_EQ(read.series.size(), 1u);
    EXPECT_THAT(read.series[0].time_s, near({0, 0.5}));
  }
}

TEST_F(Formats, EposStudioHasTimesInWholeMilliseconds) {
  const std::string text = "13\t100\n26\t101\n38\t102\n52\t103\n";
  EXPECT_THAT(guessed(text), HasSubstr("time: {column: 1}  # it rises all the time; ADD ITS UNIT"));
  const auto read = loaded(text, "time: {column: 1, unit: ms}\nchannels: {a: {column: 2, unit: mA}}\n");
  EXPECT_THAT(read.series.at(0).value, near({0.1, 0.101, 0.102, 0.103}));
  EXPECT_THAT(findings, IsEmpty()) << "jitter is no gap";
}

TEST_F(Formats, NumbersOfSixteenBits) {
  // 33068 = -300 with the sign in bit 15; 65236 = -300 as a two's complement.
  EXPECT_THAT(guessed("t,v\n0,300\n1,33068\n2,200\n"), HasSubstr("numbers: sign_magnitude"));
  EXPECT_THAT(guessed("t,v\n0,300\n1,65236\n2,200\n"), HasSubstr("numbers: twos_complement"));
  for (const auto* form : {"sign_magnitude", "twos_complement"}) {
    const auto* number = std::string_view(form) == "sign_magnitude" ? "33068" : "65236";
    const auto read = loaded(std::string("t,v\n0,300\n1,") + number + "\n",
                             std::string("time: {column: t, unit: s}\n"
                                         "channels: {a: {column: v, unit: rpm, scale: 0.1, numbers: ") +
                                 form + "}}\n");
    EXPECT_THAT(read.series.at(0).value, near({std::numbers::pi, -std::numbers::pi})) << form;
  }
}

TEST_F(Formats, TimesOfDayAndEmptyCells) {
  const auto read =
      loaded("time,pos (5)\n2024-02-28T23:59:59.500,1\n2024-02-29 00:00:00.000,\n2024-02-29 00:00:00.5,3\n",
             "time: {column: time, unit: s}\nchannels: {a: {column: pos (5), unit: inch}}\n");
  EXPECT_THAT(lines_of(problems), IsEmpty());
  EXPECT_THAT(read.series.at(0).time_s, near({0, 1}));
  EXPECT_THAT(read.series.at(0).value, near({0.0254, 0.0762}));
  EXPECT_THAT(doubts(), ElementsAre("3 recording.empty-cells"));
}

TEST_F(Formats, AChannelMayHaveATimeOfItsOwn) {
  const auto read = loaded("t1,a,t2,b\n0,1,0.5,10\n1,2,2.5,20\n",
                           "time: {column: t1, unit: s}\n"
                           "channels: {a: {column: a, unit: V}, b: {column: b, time: t2, unit: V}}\n");
  EXPECT_THAT(read.series.at(0).time_s, near({0, 1}));
  EXPECT_THAT(read.series.at(1).time_s, near({0.5, 2.5}));
}

TEST_F(Formats, RowsAreOfTheData) {
  const auto read = loaded("t,a\n0,1\n1,2\n2,3\n3,4\n",
                           "time: {column: t, unit: s}\nrows: [2, 3]\n"
                           "channels: {a: {column: a, unit: V}}\n");
  EXPECT_THAT(read.series.at(0).value, near({2, 3}));
  EXPECT_EQ(read.rows, 2u);
}

TEST_F(Formats, MarksOfEditorsDoNoHarm) {
  const auto read = loaded(
      "\xEF\xBB\xBF\"t\",\"Stra\xDF"
      "e\",\r\n0,1,\r\n1,2,\r\n",
      "time: {column: t, unit: s}\nchannels: {a: {column: Stra\xC3\x9F"
      "e, unit: V}}\n");
  EXPECT_THAT(lines_of(problems), IsEmpty());
  EXPECT_THAT(read.series.at(0).value, near({1, 2}));
}

TEST_F(Formats, PerMilleAndThePlainWorth) {
  const auto read = loaded("t,a\n0,500\n1,250\n",
                           "time: {column: t, unit: s}\n"
                           "channels: {a: {column: a, unit: counts, of: 2 N m, full: 1000}}\n");
  EXPECT_THAT(read.series.at(0).value, near({1, 0.5}));
}

TEST_F(Formats, TheChecksumIsOfTheWholeFile) {
  const std::string yaml = "time: {column: t, unit: s}\nrows: [1, 2]\nchannels: {a: {column: a, unit: V}}\n";
  const auto one = loaded("t,a\n0,1\n1,2\n2,3\n", yaml).checksum;
  EXPECT_EQ(one, loaded("t,a\n0,1\n1,2\n2,3\n", yaml).checksum);
  EXPECT_NE(one, loaded("t,a\n0,1\n1,2\n2,4\n", yaml).checksum);
}

TEST_F(Formats, AGuessThatIsWholeIsARecording) {
  const auto yaml = guessed("Time [ms];Torque (N m)\n0,5;1,5\n1,5;2,5\n");
  const auto file = folder.file("guess.yaml", yaml);
  const auto recording = read_recording_file(file, problems);
  EXPECT_THAT(load(recording, problems, findings).series.at(0).time_s, near({0.0005, 0.0015}));
  EXPECT_THAT(lines_of(problems), IsEmpty());
}

}  // namespace
}  // namespace drycut::sim::recordings
