#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <csignal>
#include <random>

#include "sim/record/hdf5/deflate.hpp"
#include "sim/record/hdf5/table.hpp"
#include "sim/record/hdf5_file.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::record {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::size_t block = 4096;

/// Two channels, not in the order of the alphabet, and what they are in each row.
struct Hdf5Test : testing::Test {
  Hdf5Test() {
    recording.add("web.speed", "m/min").slot = &speed;
    recording.add("knife.angle", "").slot = &angle;
  }
  void set(std::size_t row) {
    speed = 1.0 / static_cast<double>(row + 3);
    angle = static_cast<double>(row % 7);
  }
  static Time at(std::size_t row) { return static_cast<Time>(row) * 2 * millisecond; }
  void rows(Observer& file, std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      set(row);
      file.sample(at(row));
    }
  }
  void expect_rows(const Record& record, std::size_t count) {
    ASSERT_EQ(record.recording.times().size(), count);
    ASSERT_EQ(record.recording.columns().size(), 2U);
    for (std::size_t row = 0; row < count; ++row) {
      set(row);
      ASSERT_EQ(record.recording.times()[row], at(row)) << row;
      ASSERT_EQ(record.recording.columns()[0].values[row], speed) << row;
      ASSERT_EQ(record.recording.columns()[1].values[row], angle) << row;
    }
  }
  Record read(const fs::path& file) {
    Problems problems;
    auto record = read_hdf5(file, problems);
    EXPECT_EQ(lines_of(problems), "");
    return record;
  }
  std::string refused(const fs::path& file) {
    Problems problems;
    read_hdf5(file, problems);
    return lines_of(problems);
  }

  double speed = 0;
  double angle = 0;
  Recording recording;
  TestFolder folder;
  fs::path file = folder / "trace.h5";
};

TEST_F(Hdf5Test, GivesBackWhatItTook) {
  const std::string long_text =
      "a text that is longer than its field, " + std::string(80, 'x') + " \u00b5m, to its end";
  const About about = {
      {"drycut", "0.1.0"}, {"step", "100 us"}, {"set", ""}, {"scenario", std::string(200'000, 's')}};
  {
    const auto writer = hdf5_writer(recording, file, about);
    auto& out = *writer;
    out.happened({100'000, 0.00005, "knife", "cut", {{"length", 800.0125, "mm"}, {"number", 3, ""}}, ""});
    rows(out, 0, 2 * block + 5);
    out.happened(
        {at(2 * block), 0, "a drive with a name that is longer than its field", "error", {}, long_text});
    out.happened({at(2 * block), 0, "timeline", "set", {}, ""});
    out.finish();
  }
  Outcome outcome;
  outcome.checks = {{"good", "always x < 1", true, 0.25, "mm", 3.5, "9 instants"},
                    {"bad", "never y", false, {}, "", {}, "it was"}};
  add_outcome(file, outcome);
  const auto record = read(file);
  expect_rows(record, 2 * block + 5);
  EXPECT_EQ(record.recording.columns()[0].name, "web.speed");
  EXPECT_EQ(record.recording.columns()[0].unit, "m/min");
  EXPECT_EQ(record.recording.columns()[1].name, "knife.angle");
  EXPECT_EQ(record.recording.columns()[1].unit, "");
  const auto& events = record.recording.events();
  ASSERT_EQ(events.size(), 3U);
  EXPECT_DOUBLE_EQ(events[0].at_seconds(), 0.00015);
  EXPECT_EQ(events[0].time, 150'000);
  ASSERT_EQ(events[0].values.size(), 2U);
  EXPECT_EQ(events[0].values[0].number, 800.0125);
  EXPECT_EQ(events[0].values[0].unit, "mm");
  EXPECT_EQ(events[0].values[1].name, "number");
  EXPECT_EQ(events[1].source, "a drive with a name that is longer than its field");
  EXPECT_EQ(events[1].text, long_text);
  EXPECT_TRUE(events[1].values.empty());
  EXPECT_EQ(events[2].event, "set");
  EXPECT_EQ(record.about, about);
  ASSERT_EQ(record.outcome.checks.size(), 2U);
  EXPECT_EQ(record.outcome.checks[0].name, "good");
  EXPECT_TRUE(record.outcome.checks[0].passed);
  EXPECT_EQ(record.outcome.checks[0].margin, 0.25);
  EXPECT_EQ(record.outcome.checks[0].at, 3.5);
  EXPECT_EQ(record.outcome.checks[1].expectation, "never y");
  EXPECT_FALSE(record.outcome.checks[1].passed);
  EXPECT_FALSE(record.outcome.checks[1].margin);
  EXPECT_EQ(record.outcome.checks[1].detail, "it was");
}

TEST_F(Hdf5Test, IsTheSameBytesTwice) {
  const auto write = [&](const fs::path& to) {
    {
      const auto writer = hdf5_writer(recording, to, {{"drycut", "0.1.0"}});
      auto& out = *writer;
      for (std::size_t row = 0; row < 3 * block; row += 100) {
        rows(out, row, row + 100);
        out.happened({at(row), 0, "knife", "cut", {{"length", 800, "mm"}}, ""});
      }
      out.finish();
    }
    Outcome outcome;
    outcome.checks = {{"good", "always", true, {}, "", {}, ""}};
    add_outcome(to, outcome);
    return content(to);
  };
  EXPECT_TRUE(write(file) == write(folder / "again.h5"));
}

TEST_F(Hdf5Test, CanBeReadWhileItIsWritten) {
  const auto writer = hdf5_writer(recording, file, {});
  auto& out = *writer;
  expect_rows(read(file), 0);
  rows(out, 0, block - 1);
  out.happened({at(block - 2), 0, "knife", "cut", {}, ""});
  expect_rows(read(file), 0);
  EXPECT_EQ(read(file).recording.events().size(), 1U) << "the first at once";
  out.happened({at(block - 1), 0, "knife", "cut", {}, ""});
  EXPECT_EQ(read(file).recording.events().size(), 1U) << "the others a second later";
  rows(out, block - 1, block + 10);
  EXPECT_EQ(read(file).recording.events().size(), 2U) << "or with the rows";
  expect_rows(read(file), block);
  rows(out, block + 10, 2 * block);
  expect_rows(read(file), 2 * block);
}

TEST_F(Hdf5Test, RefusesWhatIsNoRecord) {
  EXPECT_THAT(
      refused(folder.file("x.h5", "time [s],web.speed [m/min]\n")),
      HasSubstr(
          "x.h5:1:1: it is no HDF5 file; name a file that drycut wrote: trace.h5 [record.not-a-record]\n"));
  {
    const auto writer = hdf5_writer(recording, file, {});
    auto& out = *writer;
    rows(out, 0, 3 * block);
    out.finish();
  }
  const auto whole = content(file);
  EXPECT_THAT(
      refused(folder.file("cut.h5", whole.substr(0, whole.size() / 2))),
      HasSubstr("cut.h5:1:1: HDF5 cannot open it: it is cut short or damaged; run the scenario again"));
  auto broken = whole;
  std::fill(broken.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2), broken.end() - 2000, '\x55');
  EXPECT_THAT(refused(folder.file("broken.h5", broken)), HasSubstr("broken.h5:1:1: "));
  {
    const hdf5::Hdf5Turn turn;
    const hdf5::Handle empty(
        H5Fcreate((folder / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  }
  EXPECT_THAT(refused(folder / "other.h5"),
              HasSubstr("other.h5:1:1: there are no 'channels' in it; name a file"));
}

TEST_F(Hdf5Test, RefusesTimesThatAreNone) {
  const auto with_times = [&](Time first, Time then) {
    const auto writer = hdf5_writer(recording, file, {});
    auto& out = *writer;
    out.sample(first);
    out.sample(then);
    out.finish();
    return refused(file);
  };
  EXPECT_THAT(with_times(5, 5), HasSubstr("trace.h5:1:1: the time does not rise in row 2; run"));
  EXPECT_THAT(with_times(-second, 0), HasSubstr("-1 in row 1 of time is no time of a run"));
}

TEST_F(Hdf5Test, TellsAFullDisk) {
  const auto before_it = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::string told;
  {
    const auto writer = hdf5_writer(recording, file, {});
    auto& out = *writer;
    const rlimit most{100'000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &most);
    try {
      rows(out, 0, 20 * block);
    } catch (const std::runtime_error& error) {
      told = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
  }
  std::signal(SIGXFSZ, before_it);
  EXPECT_EQ(told, "cannot write " + file.string() + ": File too large");
  EXPECT_THROW(hdf5_writer(recording, folder / "nowhere/trace.h5", {}), std::runtime_error);
}

/// What HDF5's filters make of it, backwards.
std::vector<double> restored(const std::string& bytes, std::size_t count) {
  std::vector<unsigned char> planes(count * sizeof(double));
  auto size = static_cast<uLongf>(planes.size());
  EXPECT_EQ(
      uncompress(planes.data(), &size, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()),
      Z_OK);
  EXPECT_EQ(size, planes.size());
  std::vector<double> numbers(count);
  for (std::size_t i = 0; i < planes.size(); ++i)
    reinterpret_cast<unsigned char*>(numbers.data())[i % count * sizeof(double) + i / count] = planes[i];
  return numbers;
}

TEST(RecordsDeflate, MakesLessOfWhatRepeatsAndNotMoreOfNoise) {
  std::mt19937_64 random(1);
  std::vector<double> noise(block);
  std::vector<double> counts(block);
  const std::vector<double> still(block, 12.5);
  for (std::size_t i = 0; i < block; ++i) {
    noise[i] = std::uniform_real_distribution(1.0, 2.0)(random);
    counts[i] = static_cast<double>(i);
  }
  Deflate deflate;
  const std::size_t size = block * sizeof(double);
  const auto expect = [&](const std::vector<double>& numbers, std::size_t most) {
    const auto bytes = deflate(numbers.data(), block);
    EXPECT_LE(bytes.size(), most);
    EXPECT_EQ(restored(bytes, block), numbers);
  };
  expect(still, size / 100);
  expect(counts, size / 10);
  expect(noise, size * 7 / 8 + 100);  // sign and exponent are the same in all
  expect(std::vector<double>(block, std::numeric_limits<double>::infinity()), size / 100);
}

}  // namespace
}  // namespace drycut::sim::record
