// Any moment of a run kept, come back to and gone on from: as if nothing had been between. What keeps it out.
#include <gmock/gmock.h>

#include <algorithm>
#include <drycut/simulation.hpp>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "sim/cli/run_command.hpp"
#include "sim/loop/kept_states.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/loop/state_bytes.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::loop {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const auto scenes = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes";
using Bytes = StateArchive::Bytes;

/// A simulation of a shipped scene, without pictures.
struct Line {
  explicit Line(const std::string& scene, const std::vector<scenario::Override>& set = {})
      : scenario(scenario::read_scenario(scenes / (scene + ".yaml"), set, problems)) {
    scenario.pictures = {};
    simulation = std::make_unique<Simulation>(scenario, problems);
    EXPECT_TRUE(problems.empty()) << to_string(problems.front());
    simulation->keep_nothing();
  }
  void run_to(Time time) const {
    while (simulation->time() < time && simulation->advance()) continue;
  }
  [[nodiscard]] Bytes members() const {
    Bytes bytes;
    StateArchive::save(bytes, *simulation);
    return bytes;
  }

  Problems problems;
  scenario::Scenario scenario;
  std::unique_ptr<Simulation> simulation;
};

/// "controller_.devices_.0.values_" of the first member that differs, "" = none.
std::string first_difference(const Line& a, const Line& b) {
  std::vector<StateArchive::Member> list;
  Bytes one;
  StateArchive::save(one, *a.simulation, &list);
  const auto other = b.members();
  for (const auto& [name, offset, size] : list) {
    if (name.starts_with("recording_.")) continue;  // without a journal it stays as it is
    const auto begin = one.begin() + static_cast<std::ptrdiff_t>(offset);
    if (offset + size > other.size() || !std::equal(begin, begin + static_cast<std::ptrdiff_t>(size),
                                                    other.begin() + static_cast<std::ptrdiff_t>(offset)))
      return name;
  }
  return one.size() == other.size() ? "" : "the end";
}

class AnyMoment : public testing::TestWithParam<const char*> {};

// The whole of a line is compared: members of all its parts, after two more seconds.
TEST_P(AnyMoment, GoesOnAsIfNothingHadBeenBetween) {
  const Line whole(GetParam());
  const Line again(GetParam());
  constexpr Time on = second;
  for (const Time moment : {500 * millisecond, 1537 * millisecond + 100 * microsecond, 2900 * millisecond}) {
    whole.run_to(moment);
    const auto kept = whole.simulation->save();
    const auto late = again.simulation->time();
    again.simulation->restore(kept);
    EXPECT_EQ(again.simulation->time(), moment);
    ASSERT_EQ(first_difference(whole, again), "") << "restored from " << seconds(late) << " s";
    again.run_to(moment + on);
    // This one goes on in one piece, then comes back.
    whole.run_to(moment + on);
    ASSERT_EQ(first_difference(whole, again), "") << "from " << seconds(moment) << " s on";
    whole.simulation->restore(kept);
    whole.run_to(moment + on);
    EXPECT_EQ(first_difference(whole, again), "") << "back at " << seconds(moment) << " s";
  }
}

INSTANTIATE_TEST_SUITE_P(Lines, AnyMoment,
                         testing::Values("rotary_knife", "rotary_knife_lx3vp", "rotary_knife_mc_camin",
                                         "flying_saw", "flying_saw_mc_camin", "press_learning", "wire_guide",
                                         "onoff_backlash", "shared_drive", "rotary_knife_fault"),
                         [](const auto& line) { return std::string(line.param); });

// What a state needs, member by member: restored without it, a line goes on to something else, or the member
// is of those that nothing reads before it is set anew.
struct Unread {
  const char* part;  ///< of the member's name
  const char* why;
};
constexpr auto* in_step = "the next step makes it anew before anything reads it";
constexpr auto* in_sample = "the next sample of the device makes it anew before anything reads it";
constexpr auto* at_instant = "the next record instant makes it anew before anything reads it";
constexpr Unread unread[] = {
    {"_before", in_step},
    {"pulses.port.", in_step},
    {"pulses.last_", in_step},
    {"pulses.forward_", in_step},
    {"wheel_.travel_", in_step},
    {"wheel_.revolutions_", in_step},
    {"web.drive_.force_", in_step},
    {"cutter_.theta_", in_step},
    {"gear_.rate_", in_step},
    {"gear_.torque_", in_step},
    {"home_.distance_", in_step},
    {"amplifier_.converted_", in_step},
    {"amplifier_.reference.volts", in_step},
    {"power_.loss_", in_step},
    {"power_.speed_", in_step},
    {"power_.torque_", in_step},
    {"link_.mains_power_", in_step},
    {"controller_.now", in_step},
    {"bus_.cutting.level", in_step},
    {"bus_.in_sync.level", in_step},
    {"cards_.analogue_outputs", in_sample},
    {"cards_.outputs", in_sample},
    {"AxisX.axis_.actions_", in_sample},
    {"AxisX.axis_.counted_", in_sample},
    {"bits_per_second_", in_sample},
    {"AxisX.axis_.output_.word", in_sample},
    {"regulator_.last_error_", in_sample},
    {"AxisX.axis_.speed_", in_sample},
    {"AxisX.encoder", in_sample},
    {"AxisX.ffwdreg", in_sample},
    {"AxisX.propreg", in_sample},
    {"AxisX.follerr", in_sample},
    {"AxisX.frq", in_sample},
    {"AxisX.posit", in_sample},
    {"AxisX.st_sync", in_sample},
    {"AxisX.st_vconst", in_sample},
    {"AxisX.vel", in_sample},
    {"AxisX.vout", in_sample},
    {"rotary_knife.reached", "the next cycle of the task begins at its first line"},
    {"rotary_knife.turned", "the next cycle of the task begins at its first line"},
    {"state.last_at", at_instant},
    {"compiled_->values", at_instant},
    {"watch_.numbers", at_instant},
    {"cycles.seen_.", at_instant},
    {"cycles.turned_", at_instant},
    {"axis.stood", "an axis that runs on has not stood: every instant sets it anew"},
    {"extreme.", "an axis that runs on: every instant is its extreme"},
    {"power_.sum_.torque", "the largest of half a millisecond: there were larger ones before"},
    {"power_.sum_.speed_then", "with it"},
    {"amplifier_.wanted_", "every step sets it anew before it is read"},
    {"totals_.from_mains", "of cycles alone the difference counts, and of these none ends between"},
};

bool may_be_skipped(const std::string& name) {
  return std::any_of(std::begin(unread), std::end(unread),
                     [&](const Unread& of) { return name.find(of.part) != std::string::npos; });
}

/// A line that is restored to a moment again and again, from another one.
struct Restored {
  explicit Restored(const std::string& scene, Time moment, Time other) : line(scene) {
    line.run_to(std::min(moment, other));
    (moment < other ? target : before) = line.members();
    line.run_to(std::max(moment, other));
    (moment < other ? before : target) = line.members();
    StateArchive::save(scratch, *line.simulation, &list);
    restore(target);
    scratch.clear();
    list.clear();
    StateArchive::save(scratch, *line.simulation, &list);
  }
  void restore(const Bytes& to, std::optional<std::size_t> skip = {}) {
    auto archive = StateArchive::restoring(to.data(), to.size(), skip);
    line.simulation->visit(archive);
  }
  /// All that it has come to after a while.
  Bytes gone_on(std::optional<std::size_t> skip) {
    restore(before);
    try {
      restore(target, skip);
    } catch (const BadState& bad) {
      EXPECT_TRUE(skip) << bad.what();
      return {};  // noticed: lengths do not fit
    }
    line.run_to(line.simulation->time() + 300 * millisecond);
    return line.members();
  }
  Line line;
  Bytes target;
  Bytes before;
  Bytes scratch;
  std::vector<StateArchive::Member> list;
};

class EveryMember : public testing::TestWithParam<const char*> {};

/// Members without which it goes on the same, though they had another value.
std::set<std::string> unneeded(const std::string& scene, Time moment, Time other) {
  Restored of(scene, moment, other);
  const auto whole = of.gone_on({});
  EXPECT_EQ(of.gone_on({}), whole);
  std::set<std::string> names;
  for (std::size_t n = 0; n < of.list.size(); ++n) {
    if (of.gone_on(n) != whole) continue;
    of.restore(of.before);
    of.restore(of.target, n);
    if (of.line.members() != of.target) names.insert(of.list[n].name);
  }
  return names;
}

// From a later and from an earlier moment: what is due by time alone is late in one of them.
TEST_P(EveryMember, IsNeededOrListed) {
  const auto later = unneeded(GetParam(), 400 * millisecond, 2900 * millisecond);
  std::string lines;
  for (const auto& name : unneeded(GetParam(), 2900 * millisecond, 400 * millisecond))
    if (later.contains(name) && !may_be_skipped(name)) lines += name + '\n';
  EXPECT_EQ(lines, "");
}

INSTANTIATE_TEST_SUITE_P(Lines, EveryMember, testing::Values("rotary_knife"),
                         [](const auto& line) { return std::string(line.param); });

TEST(AnyMoment, IsItself) {
  const Line line("rotary_knife");
  line.run_to(3 * second);
  const auto kept = line.simulation->save();
  EXPECT_LT(kept.size(), std::size_t{64} << 10U);
  line.simulation->restore(kept);
  EXPECT_EQ(line.simulation->save(), kept);
  drycut::Simulation program(scenes / "rotary_knife.yaml");
  program.advance(3);
  drycut::Simulation other(scenes / "rotary_knife.yaml");
  other.restore(program.save());
  EXPECT_EQ(other.save(), program.save());
}

std::string refusal(Simulation& simulation, const Bytes& state) {
  try {
    simulation.restore(state);
  } catch (const BadState& bad) {
    return bad.what();
  }
  return "";
}

TEST(AnyMoment, NoByteMayBeAnother) {
  const Line line("commissioning_counter");
  line.run_to(20 * millisecond);
  const auto kept = line.simulation->save();
  const auto before = line.members();
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (const auto bit : {std::byte{0x10}, std::byte{0x01}}) {
      auto bad = kept;
      bad[i] ^= bit;
      ASSERT_NE(refusal(*line.simulation, bad), "") << "byte " << i;
    }
  }
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{7}, std::size_t{31}, std::size_t{32}, kept.size() - 1})
    EXPECT_NE(
        refusal(*line.simulation, Bytes(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(size))), "");
  auto longer = kept;
  longer.push_back({});
  EXPECT_NE(refusal(*line.simulation, longer), "");
  EXPECT_EQ(line.members(), before);
}

TEST(AnyMoment, OfAnotherScenarioIsRefusedWithWhatDiffers) {
  const Line line("rotary_knife");
  line.run_to(100 * millisecond);
  const auto kept = line.simulation->save();
  const Line other("rotary_knife", {{"plants.knife.drum_inertia", "0.5 kg m2"}});
  EXPECT_THAT(refusal(*other.simulation, kept), AllOf(HasSubstr("plants"), HasSubstr("differ")));
  const Line program("rotary_knife_short");
  EXPECT_NE(refusal(*program.simulation, kept), "");
  // Whoever branches wants just that.
  other.simulation->restore(kept, {}, true);
  EXPECT_EQ(other.simulation->time(), 100 * millisecond);
}

TEST(AnyMoment, OfAnotherBuildIsRefused) {
  const Line line("commissioning_counter");
  const auto kept = line.simulation->save();
  auto [head, members] = open_state(kept);
  head.origin.build = "another";
  auto other = begun_state(head.origin);
  other.insert(other.end(), members.begin(), members.end());
  seal(other, head);
  EXPECT_THAT(refusal(*line.simulation, other), HasSubstr("another"));
}

TEST(AnyMoment, ForPrograms) {
  drycut::Simulation line(scenes / "rotary_knife.yaml");
  line.advance(2);
  std::ignore = line.take_events();
  const auto kept = line.save();
  line.advance(3);
  const auto events = line.take_events();
  const double angle = line.read("knife.angle.total");
  ASSERT_FALSE(events.empty());

  drycut::Simulation other(scenes / "rotary_knife.yaml");
  for (auto* again : {&line, &other}) {
    again->restore(kept);
    EXPECT_EQ(again->time(), 2);
    again->advance(3);
    EXPECT_EQ(again->read("knife.angle.total"), angle);
    const auto same = again->take_events();
    ASSERT_EQ(same.size(), events.size());
    for (std::size_t i = 0; i < same.size(); ++i) EXPECT_EQ(same[i].time, events[i].time);
  }
  auto bad = kept;
  bad.back() ^= std::byte{1};
  EXPECT_THROW(line.restore(bad), BadInput);
}

struct KeptMoments : CommandTest {
  static constexpr auto* web = R"(scene: {step: 1 ms, duration: 2 s}
plants: {web: {type: web, speed: 60 m/min}}
timeline: [{at: 1.5 s, ramp: {web.speed: 80 m/min}, over: 0.2 s}]
record: {every: 10 ms, channels: [web.speed, web.position]}
checks:
  - {name: slow enough, always: "web.speed <= 100"}
  - {name: mean, always: "mean(web.speed) >= 59"}
)";
  KeptMoments() { folder.file("web.yaml", web); }
  int run(const cli::RunOptions& asked) {
    auto options = asked;
    options.pictures = false;
    if (options.resume.empty()) options.scenarios = {folder / "web.yaml"};
    if (options.out == "out") options.out = folder / "out";
    return captured([&] { return cli::run_scenarios(options); });
  }
  [[nodiscard]] std::vector<std::string> states(const std::string& out = "out") const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / out / "web/states"))
      if (entry.path().extension() == ".state") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  TestFolder folder;
};

TEST_F(KeptMoments, LieEvenlyOverTheRunAndTheLastTwoAlways) {
  ASSERT_EQ(run({.states = "50 ms", .most_states = 8}), 0) << err;
  const auto kept = states();
  ASSERT_LE(kept.size(), 8U);
  ASSERT_GE(kept.size(), 4U);
  EXPECT_EQ(kept.back(), "0000002.000000000");
  EXPECT_EQ(kept[kept.size() - 2], "0000001.950000000");
}

// Of very many there is always one not far before any time.
TEST_F(KeptMoments, LieEvenlyHoweverManyThereWere) {
  ASSERT_EQ(run({.states = "500 us", .most_states = 8}), 0) << err;
  const auto kept = states();
  ASSERT_LE(kept.size(), 8U);
  ASSERT_GE(kept.size(), 5U);
  const auto at = [&](std::size_t n) { return std::stod(kept[n]); };
  const double stride = at(1) - at(0);
  EXPECT_LE(at(0), stride + 1e-9);
  for (std::size_t n = 2; n + 2 < kept.size(); ++n) EXPECT_NEAR(at(n) - at(n - 1), stride, 1e-9) << n;
  EXPECT_LE(at(kept.size() - 1) - at(kept.size() - 3), stride + 1e-9);
}

TEST_F(KeptMoments, GoOnToTheSameBytes) {
  ASSERT_EQ(run({.out = folder / "whole"}), 0);
  ASSERT_EQ(run({.states = "50 ms"}), 0);
  const auto kept = states();
  for (auto later = kept.begin() + 20; later != kept.end(); ++later)
    std::filesystem::remove(folder / "out/web/states" / (*later + ".state"));
  ASSERT_EQ(run({.resume = folder / "out/web"}), 0) << err;
  for (const auto* file : {"web/trace.csv", "web/events.csv", "web/checks.json"})
    EXPECT_EQ(content(folder / "out" / file), content(folder / "whole" / file)) << file;
  EXPECT_EQ(states(), kept);
}

TEST_F(KeptMoments, TakeTheNewestThatIsWhole) {
  ASSERT_EQ(run({.states = "0.5 s"}), 0);
  const auto last = folder / "out/web/states/0000002.000000000.state";
  std::filesystem::resize_file(last, std::filesystem::file_size(last) / 2);
  ASSERT_EQ(run({.resume = folder / "out/web"}), 0) << err;
  EXPECT_THAT(out + err, AllOf(HasSubstr("[state.damaged]"), HasSubstr("1.5 s")));
}

TEST_F(KeptMoments, BranchWhereOneLikes) {
  ASSERT_EQ(run({.states = "0.5 s"}), 0);
  ASSERT_EQ(run({.out = folder / "branch",
                 .set = {"plants.web.speed=90 m/min"},
                 .from = (folder / "out/web").string() + "@1.2 s"}),
            0)
      << err;
  EXPECT_THAT(out, AllOf(HasSubstr("[state.went-on]"), HasSubstr("1.2 s"), HasSubstr("1.0 s")));
  const auto before = content(folder / "out/web/trace.csv");
  const auto after = content(folder / "branch/web/trace.csv");
  const auto place = before.find("\n1.2,");
  ASSERT_NE(place, std::string::npos);
  EXPECT_EQ(after.substr(0, place), before.substr(0, place));
  const auto faster = after.find("\n1.5,");
  ASSERT_NE(faster, std::string::npos);
  EXPECT_GT(std::stod(after.substr(faster + 5)), 75);  // on its way to 90
}

TEST_F(KeptMoments, ABranchHasTheValuesThatItsFileHas) {
  ASSERT_EQ(run({.states = "0.5 s"}), 0);
  auto slower = std::string(web);
  slower.replace(slower.find("60 m/min"), 2, "30");
  folder.file("web.yaml", slower);
  ASSERT_EQ(run({.out = folder / "branch", .from = (folder / "out/web").string() + "@1.2 s"}), 1)
      << "the mean falls: " << err;
  EXPECT_THAT(out,
              AllOf(HasSubstr("set at 1.2 s: web.speed = 30 m/min"), HasSubstr("from the state at 1.0 s")));
  const auto after = content(folder / "branch/web/trace.csv");
  const auto slowed = after.find("\n1.49,");
  ASSERT_NE(slowed, std::string::npos);
  EXPECT_LT(std::stod(after.substr(slowed + 6)), 50);  // on its way to 30
}

TEST_F(KeptMoments, WithoutStatesABranchRunsFromZero) {
  ASSERT_EQ(run({}), 0);
  ASSERT_EQ(run({.out = folder / "branch", .from = (folder / "out/web").string() + "@1.2 s"}), 0) << err;
  EXPECT_THAT(out, HasSubstr("from zero"));
  EXPECT_EQ(content(folder / "branch/web/trace.csv"), content(folder / "out/web/trace.csv"));
}

TEST_F(KeptMoments, RefuseWhatDoesNotFit) {
  ASSERT_EQ(run({}), 0);
  EXPECT_EQ(run({.resume = folder / "out/web"}), 2);
  EXPECT_THAT(err, HasSubstr("[state.none]"));
  EXPECT_EQ(run({.from = (folder / "out/web").string() + "@1.2 s"}), 2);  // its own folder
  EXPECT_THAT(err, HasSubstr("[state.refused]"));
  EXPECT_EQ(run({.out = folder / "branch", .from = (folder / "out/web").string() + "@1.2"}), 2);
  EXPECT_EQ(run({.out = folder / "branch", .from = (folder / "out/web").string()}), 2);
  EXPECT_THAT(err, HasSubstr("[state.none]"));
  EXPECT_EQ(run({.out = folder / "branch", .from = (folder / "none").string() + "@1.2 s"}), 2);
  EXPECT_THAT(err, HasSubstr("[record.no-run]"));
  EXPECT_EQ(run({.resume = folder / "none"}), 2);
  EXPECT_THAT(err, HasSubstr("[record.no-run]"));
  EXPECT_EQ(run({.states = "0 s"}), 2);
  EXPECT_EQ(run({.states = "soon"}), 2);
  ASSERT_EQ(run({.states = "0.5 s"}), 0);
  folder.file("web.yaml", std::string(web) + "panel: {push_buttons: []}\n# another\n");
  EXPECT_EQ(run({.resume = folder / "out/web"}), 0) << "a remark changes nothing: " << err;
  auto faster = std::string(web);
  faster.replace(faster.find("60 m/min"), 2, "61");
  folder.file("web.yaml", faster);
  EXPECT_EQ(run({.resume = folder / "out/web"}), 2);
  EXPECT_THAT(err, AllOf(HasSubstr("[state.refused]"), HasSubstr("plants")));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/web/trace.csv"));
}

}  // namespace
}  // namespace drycut::sim::loop
