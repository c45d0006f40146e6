// pictures: what lamps, overlays, live, follow and camera do to the film of a run, and what of them is
// refused.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>

#include "sim/loop/simulation.hpp"
#include "sim/report/film.hpp"
#include "sim/report/gallery.hpp"
#include "sim/report/part_meshes.hpp"
#include "tests/loop/scenario/fake_plants.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::scenario {
namespace {

using fakes::problems_of;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// The line that cuts pieces of 500 mm, with pictures of the test's own; its problems, or its run of 3.5 s.
struct KnifeLine {
  explicit KnifeLine(const std::string& pictures) {
    const auto file = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/rotary_knife.yaml";
    auto text = content(file);
    text.resize(text.find("\npictures:") + 1);
    first_line = std::count(text.begin(), text.end(), '\n') + 1;
    scenario = read_scenario_text(text + "pictures: {" + pictures + "}\n", file,
                                  {{"scene.duration", "3.5 s"}, {"variables.length", "500 mm"}}, problems);
    simulation.emplace(scenario, problems);
    report::load_part_meshes(scenario, simulation->plants(), problems);
  }
  /// "column: what; remedy" of every problem; all are in the line of `pictures`.
  std::vector<std::string> told() const {
    std::vector<std::string> list;
    const auto before = scenario.file.string() + ":" + std::to_string(first_line) + ":";
    for (const auto& problem : problems) {
      const auto text = to_string(problem);
      EXPECT_THAT(text, StartsWith(before));
      list.push_back(text.substr(std::min(before.size(), text.size())));
    }
    return list;
  }
  renders::Film film() {
    EXPECT_THAT(told(), IsEmpty());
    simulation->run();
    return report::film_of(scenario, *simulation);
  }
  /// What was recorded of a channel at a time.
  double recorded(const std::string& channel, double time) const {
    const auto& recording = simulation->recording();
    for (std::size_t row = 0; row < recording.times().size(); ++row)
      if (std::abs(seconds(recording.times()[row]) - time) < 1e-9)
        return recording.column(channel)->values[row];
    ADD_FAILURE() << "no record of " << channel << " at " << time;
    return std::nan("");
  }

  Problems problems;
  Scenario scenario;
  std::optional<loop::Simulation> simulation;
  std::ptrdiff_t first_line = 0;
};

constexpr auto* second_cut = "frames: {around: \"cut[2]\", before: 10 ms, after: 300 ms, every: 1 ms}";

/// Kinds of callouts that any frame has.
std::pair<bool, bool> lengths_and_forces(const renders::Film& film) {
  std::pair<bool, bool> found;
  for (const auto& frame : film.frames)
    for (const auto& one : frame.callouts)
      (one.kind == renders::DrawnCallout::Kind::length ? found.first : found.second) = true;
  return found;
}

double distance(const renders::Camera& camera) {
  return std::hypot(camera.eye[0] - camera.target[0], camera.eye[1] - camera.target[1],
                    camera.eye[2] - camera.target[2]);
}

TEST(PicturesFilm, LampsStandBehindTheNumbersAndAreLitWhereTheirChannelIsNotZero) {
  KnifeLine line("frames: {every: 100 ms}, caption: [web.speed], lamps: [AxisX.st_sync, AxisX.rowex]");
  const auto film = line.film();
  ASSERT_EQ(film.frames.size(), 35U);
  int lit = 0;
  for (const auto& frame : film.frames) {
    ASSERT_EQ(frame.caption.size(), 3U);
    EXPECT_EQ(frame.caption[0].label, "web.speed");
    EXPECT_EQ(frame.caption[0].value, "60.4 m/min");
    EXPECT_FALSE(frame.caption[0].lamp);
    EXPECT_EQ(frame.caption[1].label, "AxisX.st_sync");
    EXPECT_EQ(frame.caption[1].value, "");
    ASSERT_TRUE(frame.caption[1].lamp);
    EXPECT_EQ(*frame.caption[1].lamp, line.recorded("AxisX.st_sync", frame.time_s) != 0) << frame.time_s;
    EXPECT_EQ(*frame.caption[2].lamp, line.recorded("AxisX.rowex", frame.time_s) != 0) << "3 is lit too";
    lit += *frame.caption[1].lamp ? 1 : 0;
  }
  EXPECT_GT(lit, 5) << "in synchronism after the start";
  EXPECT_LT(lit, 30) << "and not before";
}

TEST(PicturesFilm, OverlaysAreThoseAskedForAndAllByDefault) {
  struct Case {
    const char* overlays;
    bool trail, lengths, forces;
  };
  for (const auto& [overlays, trail, lengths, forces] :
       {Case{"", true, true, true}, Case{", overlays: [trail]", true, false, false},
        Case{", overlays: [lengths]", false, true, false}, Case{", overlays: [forces]", false, false, true},
        Case{", overlays: []", false, false, false}}) {
    const auto film = KnifeLine(std::string(second_cut) + overlays).film();
    EXPECT_EQ(film.trails, trail) << overlays;
    EXPECT_EQ(lengths_and_forces(film), std::pair(lengths, forces)) << overlays;
  }
}

renders::Film saw_film(const std::string& overlays) {
  std::vector<Override> settings = {{"pictures.frames.until", "80 ms"}};
  if (!overlays.empty()) settings.push_back({"pictures.overlays", overlays});
  Problems problems;
  const auto scenario =
      read_scenario(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/flying_saw.yaml", settings, problems);
  loop::Simulation simulation(scenario, problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  simulation.run();
  return report::film_of(scenario, simulation);
}

TEST(PicturesFilm, SpeedsOfTubeAndCarriageAreShownUnlessOthersAreAskedFor) {
  for (const auto& [overlays, shown] :
       {std::pair("", true), std::pair("[speeds]", true), std::pair("[trail, lengths, forces]", false)}) {
    const auto film = saw_film(overlays);
    ASSERT_FALSE(film.frames.empty());
    std::vector<std::string> moving;
    for (const auto& one : film.frames[0].callouts)
      if (one.kind == renders::DrawnCallout::Kind::speed) moving.push_back(one.text);
    if (shown)
      EXPECT_THAT(moving, ElementsAre("tube", "carriage")) << overlays;
    else
      EXPECT_THAT(moving, IsEmpty()) << overlays;
  }
}

TEST(PicturesFilm, CaptionsAreInTheUnitThatTheUserGivesTheirAxisOrThem) {
  KnifeLine line(
      "frames: {every: 500 ms}, caption: [AxisX.posit, AxisX.setpos, AxisX.follerr], "
      "live: [AxisX.posit, AxisX.setpos], units: {AxisX: 0.01 mm, AxisX.setpos: 0.1 deg}");
  const auto film = line.film();
  ASSERT_FALSE(film.frames.empty());
  double largest = 0;
  for (const auto& frame : film.frames) {
    const double posit = line.recorded("AxisX.posit", frame.time_s);
    largest = std::max(largest, std::abs(posit));
    EXPECT_EQ(frame.caption.at(0).value, fmt::format("{:.2f} mm", 0.01 * posit));
    EXPECT_EQ(frame.caption.at(1).value,
              fmt::format("{:.1f} deg", 0.1 * line.recorded("AxisX.setpos", frame.time_s)))
        << "a channel's own unit goes before that of its axis";
    EXPECT_THAT(frame.caption.at(2).value, ::testing::EndsWith("bits x4")) << "no unit of the user's";
  }
  EXPECT_GT(largest, 1000) << "it moved";
  const auto plain = KnifeLine("frames: {every: 500 ms}, caption: [AxisX.posit]").film();
  EXPECT_THAT(plain.frames.back().caption.at(0).value, ::testing::EndsWith(" Um"));
}

TEST(PicturesFilm, ARateInTheUsersUnitIsScaledWithIt) {
  PicturesSection pictures;
  pictures.units = {{{"Axis", {}}, {0.01, "mm", {}}}};
  EXPECT_EQ(pictures.own_unit("Axis.vel", "Um/s").value().unit, "mm/s");
  EXPECT_EQ(pictures.own_unit("Axis.vel", "Um/s").value().number, 0.01);
  EXPECT_FALSE(pictures.own_unit("Axis.follerr", "bits x4"));
  EXPECT_FALSE(pictures.own_unit("AxisX.posit", "Um")) << "another axis";
}

TEST(PicturesFilm, ThePressShowsItsQuotaAndHowFarItIsFromIt) {
  Problems problems;
  const auto scenario = read_scenario(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/press_learning.yaml",
                                      {{"pictures.frames.until", "2 s"},
                                       {"pictures.live", "[Axis.setpos, press.position]"},
                                       {"record.every", "100 ms"}},
                                      problems);
  loop::Simulation simulation(scenario, problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  simulation.run();
  const auto film = report::film_of(scenario, simulation);
  ASSERT_EQ(film.frames.size(), 20U);
  const auto& recording = simulation.recording();
  for (std::size_t i = 0; i < film.frames.size(); ++i) {
    const auto& quota = film.frames[i].quota;
    ASSERT_TRUE(quota);
    std::size_t row = 0;
    while (std::abs(seconds(recording.times()[row]) - film.frames[i].time_s) > 1e-9) ++row;
    const double setpos = recording.column("Axis.setpos")->values[row];
    EXPECT_NEAR(quota->place, 1e-5 * setpos, 1e-12) << "it counts in 0.01 mm";
    EXPECT_NEAR(quota->miss, 1e-3 * recording.column("press.position")->values[row] - 1e-5 * setpos, 1e-9);
    EXPECT_EQ(quota->tolerance, 3e-4);
  }
  EXPECT_GT(film.frames.back().quota->place, 0.1) << "it has been given one";
  EXPECT_THAT(report::report_of(scenario, simulation, {}, {}).units,
              ::testing::IsSupersetOf({"Axis counts in 0.01 mm.", "glMiss counts in 0.01 mm."}));
  EXPECT_FALSE(KnifeLine("frames: {every: 500 ms}").film().frames.at(0).quota);
}

TEST(PicturesFilm, UnitsAndQuotasThatTheMachineDoesNotHaveAreRefusedWithTheirPlace) {
  EXPECT_THAT(KnifeLine("units: {Axs: 0.01 mm}").told(),
              ElementsAre(StartsWith("20: pictures.units: there is no axis and no channel 'Axs'; ")));
  EXPECT_THAT(KnifeLine("units: {AxisX: 3}").told(),
              ElementsAre("27: pictures.units: AxisX is no unit's size; write what 1 is of a known unit: "
                          "0.01 mm [scenario.wrong-unit]"));
  EXPECT_THAT(KnifeLine("units: {AxisX: 0 mm}").told(),
              ElementsAre(StartsWith("27: pictures.units: AxisX is no unit's size; ")));
  EXPECT_THAT(KnifeLine("quota: {plant: knife, at: web.position}").told(),
              ElementsAre("27: 'knife' is no plant that shows a quota; name one of type vertical_press "
                          "[scenario.unknown-name]"));
}

TEST(PicturesFilm, PiecesTellTheLengthOfTheirCutAndTheBladeItsForce) {
  KnifeLine line(second_cut);
  const auto film = line.film();
  const auto& events = line.simulation->recording().events();
  std::vector<record::RecordedEvent> cuts;
  for (const auto& event : events)
    if (event.event == "cut") cuts.push_back(event);
  ASSERT_GE(cuts.size(), 2U);
  // The newest piece lies nearest to the cut.
  const auto& last = film.frames.back();
  const renders::DrawnCallout* newest = nullptr;
  for (const auto& one : last.callouts)
    if (one.kind == renders::DrawnCallout::Kind::length && (newest == nullptr || one.at[0] < newest->at[0]))
      newest = &one;
  ASSERT_NE(newest, nullptr);
  char length[32];
  std::snprintf(length, sizeof length, "%.1f mm", cuts[1].find("length")->number);
  EXPECT_EQ(newest->text, length);
  double largest = 0;
  for (const auto& frame : film.frames)
    for (const auto& one : frame.callouts)
      if (one.kind == renders::DrawnCallout::Kind::force) largest = std::max(largest, one.to[1]);
  EXPECT_LE(largest, cuts[1].find("force")->number * (1 + 1e-9));
  EXPECT_GT(largest, 0.5 * cuts[1].find("force")->number);
}

TEST(PicturesFilm, LiveCurvesAreTheRecordedChannels) {
  KnifeLine line("frames: {every: 500 ms}, live: [knife.motor.torque, AxisX.follerr]");
  const auto film = line.film();
  const auto& recording = line.simulation->recording();
  ASSERT_EQ(film.live.size(), 2U);
  EXPECT_EQ(film.live[0].label, "knife.motor.torque");
  EXPECT_EQ(film.live[0].unit, "N m");
  EXPECT_EQ(film.live[0].values, recording.column("knife.motor.torque")->values);
  EXPECT_EQ(film.live[1].unit, "bits x4");
  ASSERT_EQ(film.live[1].times_s.size(), recording.times().size());
  EXPECT_EQ(film.live[1].times_s.back(), 3.5);
  EXPECT_EQ(film.live_window_s, 2);
}

TEST(PicturesFilm, SlowMotionShowsAsMuchLessOfTheLiveCurves) {
  auto line = KnifeLine("frames: {every: 100 ms, slow: 20, from: 3 s}, live: [web.speed]");
  EXPECT_DOUBLE_EQ(line.film().live_window_s, 0.1);
}

TEST(PicturesFilm, ALiveChannelIsRecordedThoughNothingElseAskedForIt) {
  KnifeLine line("frames: {every: 500 ms}, live: [knife.cut.number]");
  const auto film = line.film();
  EXPECT_EQ(film.live.at(0).values.size(), line.simulation->recording().times().size());
  EXPECT_EQ(film.live[0].values.back(), line.recorded("knife.cut.number", 3.5));
  EXPECT_GE(film.live[0].values.back(), 2);
}

TEST(PicturesFilm, FollowsThePartThatIsNamed) {
  auto line = KnifeLine("frames: {every: 500 ms, follow: web.piece 1}");
  const auto film = line.film();
  ASSERT_TRUE(film.follow);
  EXPECT_EQ(film.parts.at(*film.follow).name, "web.piece 1");
  EXPECT_FALSE(KnifeLine("frames: {every: 500 ms}").film().follow);
}

TEST(PicturesFilm, APlantsCameraIsNearerThanTheOperators) {
  const auto whole = KnifeLine("frames: {every: 500 ms, camera: operator}").film().camera;
  const auto knife = KnifeLine("frames: {every: 500 ms, camera: knife}").film().camera;
  EXPECT_LT(distance(knife), 0.8 * distance(whole));
  EXPECT_EQ(KnifeLine("frames: {every: 500 ms}").film().camera, whole) << "the default";
}

TEST(PicturesFilm, APartsCameraIsNearerStillAndLooksAtThePart) {
  const auto knife = KnifeLine("frames: {every: 500 ms, camera: knife}").film().camera;
  const auto film = KnifeLine("frames: {every: 500 ms, camera: knife.drum}").film();
  EXPECT_LT(distance(film.camera), 0.8 * distance(knife));
  for (std::size_t i = 0; i < film.parts.size(); ++i) {
    if (film.parts[i].name != "knife.drum") continue;
    const auto& drum = film.frames[0].placements[i].position;
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(film.camera.target[axis], drum[axis], 0.5 * film.parts[i].size[axis]);
  }
}

TEST(PicturesFilm, ACameraOfTheUsersOwnStandsWhereItIsPut) {
  const std::string eye =
      "frames: {every: 500 ms, camera: {eye: [-1 m, 60 cm, 1400 mm], target: [1 mm, 2 mm, 0 m]";
  const auto usual = KnifeLine(eye + "}}").film().camera;
  EXPECT_EQ(usual.eye, renders::Vec3(-1, 0.6, 1.4));
  EXPECT_EQ(usual.target, renders::Vec3(0.001, 0.002, 0));
  EXPECT_NEAR(usual.field_of_view_deg, 35, 1e-9);
  EXPECT_NEAR(KnifeLine(eye + ", field_of_view: 60 deg}}").film().camera.field_of_view_deg, 60, 1e-9);
}

TEST(PicturesFilm, SeveralCamerasShareThePictureInTheirOrder) {
  const auto film =
      KnifeLine(
          "frames: {every: 500 ms, follow: web.piece 1, cameras: [knife, {eye: [-1 m, 60 cm, 1400 mm], "
          "target: [1 mm, 2 mm, 0 m]}, operator]}")
          .film();
  ASSERT_EQ(film.beside.size(), 2U);
  EXPECT_EQ(film.camera_name, "knife");
  EXPECT_EQ(film.beside[0].name, "") << "a place of one's own has none";
  EXPECT_EQ(film.beside[0].camera.eye, renders::Vec3(-1, 0.6, 1.4));
  EXPECT_EQ(film.beside[1].name, "operator");
  EXPECT_LT(distance(film.camera), 0.8 * distance(film.beside[1].camera));
  EXPECT_TRUE(film.follow) << "the first one goes along";
  const auto alone = KnifeLine("frames: {every: 500 ms}").film();
  EXPECT_TRUE(alone.beside.empty());
  EXPECT_NEAR(distance(film.beside[1].camera), distance(alone.camera), 0.02 * distance(alone.camera))
      << "a quarter has the shape of the whole";
  const auto two = KnifeLine("frames: {every: 500 ms, cameras: [operator, knife]}").film();
  EXPECT_GT(distance(two.camera), 1.2 * distance(alone.camera)) << "half as wide: further away";
}

TEST(PicturesFilm, NamesThatTheMachineDoesNotHaveAreRefusedWithTheirPlace) {
  EXPECT_THAT(
      KnifeLine("lamps: [panel.start, AxisX.st_snyc]").told(),
      ElementsAre(
          "33: there is no channel 'AxisX.st_snyc'; did you mean AxisX.st_sync? [scenario.unknown-name]"));
  EXPECT_THAT(
      KnifeLine("live: [web.sped]").told(),
      ElementsAre("19: there is no channel 'web.sped'; did you mean web.speed? [scenario.unknown-name]"));
  EXPECT_THAT(
      KnifeLine("frames: {every: 500 ms, camera: nife}").told(),
      ElementsAre("44: there is no camera 'nife'; cameras: operator, web, knife [scenario.unknown-name]"));
  EXPECT_THAT(
      KnifeLine("frames: {every: 500 ms, camera: knife.blade}").told(),
      ElementsAre("44: there is no part 'knife.blade'; did you mean knife.blade 1? [scenario.unknown-name]"));
  EXPECT_THAT(
      KnifeLine("frames: {every: 500 ms, cameras: [operator, nife]}").told(),
      ElementsAre("56: there is no camera 'nife'; cameras: operator, web, knife [scenario.unknown-name]"));
  EXPECT_THAT(
      KnifeLine("frames: {every: 500 ms, cameras: [knife.blade, knife]}").told(),
      ElementsAre("46: there is no part 'knife.blade'; did you mean knife.blade 1? [scenario.unknown-name]"));
  EXPECT_THAT(
      KnifeLine("frames: {every: 500 ms, follow: knife.drumm}").told(),
      ElementsAre("44: there is no part 'knife.drumm'; did you mean knife.drum? [scenario.unknown-name]"));
}

TEST(PicturesProblems, LampsOverlaysAndLive) {
  EXPECT_THAT(problems_of("pictures: {overlays: [trail, shadows]}\n"),
              ElementsAre("1:30: pictures.overlays: there is no overlay 'shadows'; overlays: trail, lengths, "
                          "forces, speeds [scenario.unknown-choice]"));
  EXPECT_THAT(problems_of("pictures: {overlays: trail}\n"),
              ElementsAre("1:22: pictures.overlays must be a list, not a single value; write [first, "
                          "second], or a line '- ...' for each [scenario.wrong-kind]"));
  EXPECT_THAT(problems_of("pictures: {live: [a, b, c]}\n"),
              ElementsAre("1:25: pictures.live has 3 channels; one or two have room in the corner; show more "
                          "in plots [scenario.out-of-range]"));
  EXPECT_THAT(problems_of("pictures: {lamps: {a: b}}\n"),
              ElementsAre("1:19: pictures.lamps must be a list, not a map; write [first, second], or a line "
                          "'- ...' for each [scenario.wrong-kind]"));
}

TEST(PicturesProblems, UnitsAndQuota) {
  EXPECT_THAT(
      problems_of("pictures: {quota: {plant: press}}\n"),
      ElementsAre(
          "1:19: pictures.quota.at is missing; name a channel: at: Axis.setpos [scenario.missing-key]"));
  EXPECT_THAT(
      problems_of("pictures: {quota: {at: Axis.setpos}}\n"),
      ElementsAre(
          "1:19: pictures.quota.plant is missing; name the plant: plant: press [scenario.missing-key]"));
  const std::string quota = "pictures: {quota: {plant: press, at: Axis.setpos, tolerance: ";
  EXPECT_THAT(problems_of(quota + "0 mm}}\n"),
              ElementsAre("1:62: pictures.quota.tolerance is 0 mm, out of range; 0.001 mm to 1 m; 0.1 mm is "
                          "the default [scenario.out-of-range]"));
  EXPECT_THAT(problems_of(quota + "0.3 s}}\n"),
              ElementsAre(StartsWith("1:66: pictures.quota.tolerance is a length, not a time")));
}

TEST(Pictures, UnitsAndQuotaAreReadAndWritten) {
  std::vector<std::string> problems;
  const auto scenario = fakes::read(
      "pictures: {frames: {}, units: {Axis: 0.01 mm, glMiss: 1 um}, quota: {plant: press, at: Axis.setpos, "
      "tolerance: "
      "0.3 mm}, overlays: [speeds]}\n",
      problems);
  const auto check = [](const PicturesSection& pictures) {
    ASSERT_EQ(pictures.units.size(), 2U);
    EXPECT_EQ(pictures.units[0].of.text, "Axis");
    EXPECT_EQ(pictures.units[0].is.number, 0.01);
    EXPECT_EQ(pictures.units[0].is.unit, "mm");
    EXPECT_EQ(pictures.units[1].is.unit, "um");
    ASSERT_TRUE(pictures.quota);
    EXPECT_EQ(pictures.quota->plant.text, "press");
    EXPECT_EQ(pictures.quota->at.text, "Axis.setpos");
    EXPECT_EQ(pictures.quota->tolerance, 3e-4);
    EXPECT_TRUE(pictures.overlays.speeds);
    EXPECT_FALSE(pictures.overlays.forces);
  };
  EXPECT_THAT(problems, IsEmpty());
  check(scenario.pictures);
  const auto again = fakes::read(expand(scenario), problems);
  EXPECT_THAT(problems, IsEmpty());
  check(again.pictures);
}

TEST(PicturesProblems, Cameras) {
  const std::string camera = "pictures: {frames: {camera: {";
  EXPECT_THAT(problems_of(camera + "target: [0 m, 0 m, 0 m]}}}\n"),
              ElementsAre("1:29: pictures.frames.camera.eye is missing; write eye: [0 m, 1 m, 2 m], along x, "
                          "y and z [scenario.missing-key]"));
  EXPECT_THAT(problems_of(camera + "eye: [0 m, 1 m, 2 m]}}}\n"),
              ElementsAre("1:29: pictures.frames.camera.target is missing; write target: [0 m, 1 m, 2 m], "
                          "along x, y and z [scenario.missing-key]"));
  EXPECT_THAT(problems_of(camera + "eye: [0 m, 1 m], target: [0 m, 0 m, 0 m]}}}\n"),
              ElementsAre("1:30: pictures.frames.camera.eye has 2 numbers; write three, along x, y and z: [0 "
                          "m, 20 m, 0 m] [scenario.not-a-number]"));
  EXPECT_THAT(problems_of(camera + "eye: [0 m, 1 m, 2 s], target: [0 m, 0 m, 0 m]}}}\n"),
              ElementsAre("1:48: pictures.frames.camera.eye.2 is a length, not a time (s); for example 1 m "
                          "[scenario.wrong-unit]"));
  EXPECT_THAT(problems_of(camera + "eye: [1 m, 1 m, 1 m], target: [1 m, 100 cm, 1 m]}}}\n"),
              ElementsAre("1:52: pictures.frames.camera looks at the place where it stands; let target be "
                          "another point than eye [scenario.does-not-go-together]"));
  EXPECT_THAT(
      problems_of(camera + "eye: [1 m, 1 m, 1 m], target: [0 m, 0 m, 0 m], field_of_view: 0.5 deg}}}\n"),
      ElementsAre("1:92: pictures.frames.camera.field_of_view is 0.5 deg, out of range; 1 deg to 150 deg; 35 "
                  "deg is the default [scenario.out-of-range]"));
  EXPECT_THAT(
      problems_of(camera + "eye: [1 m, 1 m, 1 m], target: [0 m, 0 m, 0 m], field_of_view: 151 deg}}}\n"),
      ElementsAre("1:92: pictures.frames.camera.field_of_view is 151 deg, out of range; 1 deg to 150 deg; 35 "
                  "deg is the default [scenario.out-of-range]"));
  EXPECT_THAT(problems_of(camera + "eye: [1 m, 1 m, 1 m], target: [0 m, 0 m, 0 m], zoom: 2}}}\n"),
              ElementsAre("1:77: unknown key 'zoom' in pictures.frames.camera; known: eye, target, "
                          "field_of_view [scenario.unknown-key]"));
  EXPECT_THAT(problems_of("pictures: {frames: {camera: [a, b]}}\n"),
              ElementsAre("1:29: pictures.frames.camera must be a single value, not a list; write one value "
                          "[scenario.wrong-kind]"));
}

TEST(PicturesProblems, SeveralCameras) {
  const std::string cameras = "pictures: {frames: {cameras: ";
  EXPECT_THAT(problems_of(cameras + "[operator]}}\n"),
              ElementsAre("1:21: pictures.frames.cameras has 1; two to four share the picture; one stands "
                          "under camera [scenario.out-of-range]"));
  EXPECT_THAT(problems_of(cameras + "[a, b, c, d, e]}}\n"),
              ElementsAre("1:21: pictures.frames.cameras has 5; two to four share the picture; one stands "
                          "under camera [scenario.out-of-range]"));
  EXPECT_THAT(problems_of(cameras + "[b, c], camera: a}}\n"), IsEmpty()) << "in place of a base's";
  EXPECT_THAT(problems_of(cameras + "a}}\n"),
              ElementsAre("1:30: pictures.frames.cameras must be a list, not a single value; write [first, "
                          "second], or a line '- ...' for each [scenario.wrong-kind]"));
  EXPECT_THAT(problems_of(cameras + "[a, {eye: [1 m, 1 m, 1 m]}]}}\n"),
              ElementsAre("1:34: pictures.frames.cameras.1.target is missing; write target: [0 m, 1 m, 2 m], "
                          "along x, y and z [scenario.missing-key]"));
}

TEST(Pictures, SeveralCamerasAreReadAndWritten) {
  std::vector<std::string> problems;
  const auto scenario = fakes::read(
      "pictures: {frames: {cameras: [operator, {eye: [-1 m, 0.6 m, 1.4 m], target: [0 m, 1 cm, 0 m]}, "
      "saw.head]}}\n",
      problems);
  const auto check = [](const PicturesSection& pictures) {
    ASSERT_EQ(pictures.cameras.size(), 3U);
    ASSERT_EQ(pictures.views().size(), 3U);
    EXPECT_EQ(pictures.cameras[0].shows.text, "operator");
    EXPECT_FALSE(pictures.cameras[0].looks_at_part());
    ASSERT_TRUE(pictures.cameras[1].own);
    EXPECT_EQ(pictures.cameras[1].own->target, (std::array<double, 3>{0, 0.01, 0}));
    EXPECT_TRUE(pictures.cameras[2].looks_at_part());
  };
  EXPECT_THAT(problems, IsEmpty());
  check(scenario.pictures);
  const auto again = fakes::read(expand(scenario), problems);
  EXPECT_THAT(problems, IsEmpty());
  check(again.pictures);
}

TEST(Pictures, CameraFollowLampsOverlaysAndLiveAreReadAndWritten) {
  std::vector<std::string> problems;
  const auto scenario = fakes::read(
      "pictures:\n"
      "  frames: {camera: {eye: [-1 m, 0.6 m, 1.4 m], target: [0 m, 1 cm, 0 m], field_of_view: 40 deg}, "
      "follow: "
      "saw.carriage}\n"
      "  lamps: [a, panel.b]\n"
      "  overlays: [forces, trail]\n"
      "  live: [c, d]\n",
      problems);
  const auto check = [](const PicturesSection& pictures) {
    ASSERT_TRUE(pictures.camera.own);
    EXPECT_EQ(pictures.camera.own->eye, (std::array<double, 3>{-1, 0.6, 1.4}));
    EXPECT_EQ(pictures.camera.own->target, (std::array<double, 3>{0, 0.01, 0}));
    EXPECT_NEAR(pictures.camera.own->field_of_view, 40 * std::numbers::pi / 180, 1e-12);
    EXPECT_EQ(pictures.follow.text, "saw.carriage");
    ASSERT_EQ(pictures.lamps.size(), 2U);
    EXPECT_EQ(pictures.lamps[1].text, "panel.b");
    EXPECT_TRUE(pictures.overlays.trail && pictures.overlays.forces);
    EXPECT_FALSE(pictures.overlays.lengths);
    ASSERT_EQ(pictures.live.size(), 2U);
    EXPECT_EQ(pictures.live[1].text, "d");
  };
  EXPECT_THAT(problems, IsEmpty());
  check(scenario.pictures);
  const auto again = fakes::read(expand(scenario), problems);
  EXPECT_THAT(problems, IsEmpty());
  check(again.pictures);
}

}  // namespace
}  // namespace drycut::sim::scenario
