// No export and no YAML crashes the reader; what it refuses has a place, what it takes is in order.
#include <algorithm>
#include <random>

#include "tests/loop/recordings/bench.hpp"

namespace drycut::sim::recordings {
namespace {

struct NoTextCrashes : RecordingTest {
  void expect_placed(const std::string& text) {
    for (const auto& problem : problems) {
      EXPECT_GE(problem.line, 1) << to_string(problem) << "\n" << text;
      EXPECT_GE(problem.column, 1) << to_string(problem);
      EXPECT_FALSE(problem.what.empty() || problem.remedy.empty()) << to_string(problem);
    }
  }
  /// Guesses, reads what was guessed, and reads it as `yaml` says.
  bool take(const std::string& text, const std::string& yaml) {
    const auto guess = guessed(text);
    expect_placed(text);
    if (!guess.empty()) {
      EXPECT_EQ(guess, guessed(text));
      Problems incomplete;
      const auto again = read_recording_text(guess, folder / "x.yaml", incomplete);
      if (incomplete.empty()) load(again, incomplete, findings);
    }
    const auto read = loaded(text, yaml);
    expect_placed(text);
    for (const auto& series : read.series) {
      EXPECT_EQ(series.time_s.size(), series.value.size());
      EXPECT_TRUE(std::is_sorted(series.time_s.begin(), series.time_s.end(), std::less_equal())) << text;
      for (const auto at : series.clipped) EXPECT_LT(at, series.value.size());
    }
    return problems.empty();
  }
};

const std::vector<std::pair<std::string, std::string>> exports = {
    {twincat,
     "format: twincat\nchannels: {a: {column: 2, unit: \"%\", of: 2 N m}, b: {column: 5, unit: V}}\n"},
    {mr_configurator2,
     "format: mr_configurator2\nchannels: {a: {column: Torque, unit: \"%\", of: 2 N m, clipped: -32768}}\n"},
    {"X,CH1,Start,Increment,\nSequence,Volt,-1.2e-04,2e-07\n0,0.12,\n1,0.14,\n",
     "format: rigol\nchannels: {a: {column: CH1, unit: V}}\n"},
    {"Record Length,Analog:14\nSample Rate,1000.0\nVertical Scale,CH1: 0.05\nSecond,Volt\n0,-0.1\n1e-3,2\n",
     "format: siglent\nchannels: {a: {column: CH1, unit: V}}\n"},
    {"0 1.5 -2\n1  2.5 -3 \n2 3.5 -4\n",
     "format: halsampler\ntime: {column: 1, rate: 1 kHz}\nchannels: {a: {column: 2, unit: V}}\n"},
    {"time;a\n2024-01-01 10:11:12,5;33068\n2024-01-01 10:11:12,6;\"2\"\n",
     "time: {column: time, unit: s}\nchannels: {a: {column: a, unit: V, numbers: sign_magnitude}}\n"}};

TEST_F(NoTextCrashes, AnyTruncation) {
  for (const auto& [text, yaml] : exports) {
    EXPECT_TRUE(take(text, yaml)) << text << lines_of(problems);
    for (std::size_t size = 0; size < text.size(); ++size) take(text.substr(0, size), yaml);
  }
}

TEST_F(NoTextCrashes, AnyChangedByte) {
  std::mt19937_64 random(20261128);
  const std::string characters = std::string("0123456789.,;:+-eE \t\n\r\"'[]()%/xn\xC3\xE4#NaInf") + '\0';
  int sound = 0;
  int count = 0;
  for (const auto& [text, yaml] : exports)
    for (int i = 0; i < 300; ++i, ++count) {
      auto changed = text;
      for (auto changes = 1 + random() % 3; changes > 0; --changes) {
        const auto at = random() % changed.size();
        if (random() % 3 == 0)
          changed.insert(at, 1, characters[random() % characters.size()]);
        else
          changed[at] = characters[random() % characters.size()];
      }
      sound += take(changed, yaml) ? 1 : 0;
    }
  EXPECT_GT(sound, count / 10);
  EXPECT_LT(sound, count);
}

TEST_F(NoTextCrashes, AnyChangeOfTheYaml) {
  std::mt19937_64 random(7);
  const std::string yaml =
      "file: x.csv\nformat: csv\nseparator: semicolon\ntime: {column: t, unit: ms, start: 3 s}\nrows: [1, "
      "9]\n"
      "channels:\n  knife.motor.torque: {column: v, unit: \"%\", of: 9 N m, full: 2, sign: -1, delay: 1 "
      "ms}\n";
  folder.file("x.csv", "t;v\n0;1\n1;2\n2;3\n");
  for (int i = 0; i < 2000; ++i) {
    auto changed = yaml;
    const auto at = random() % changed.size();
    switch (random() % 3) {
      case 0:
        changed.erase(at, random() % 8);
        break;
      case 1:
        changed[at] = yaml[random() % yaml.size()];
        break;
      default:
        changed.resize(at);
    }
    problems.clear();
    const auto read = read_recording_text(changed, folder / "x.yaml", problems);
    if (problems.empty()) load(read, problems, findings);
    expect_placed(changed);
  }
}

}  // namespace
}  // namespace drycut::sim::recordings
