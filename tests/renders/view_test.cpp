// The machine in 3-D in a report: fewer keys that tell the same, and what is left out where it would be too
// much.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "base/output_file.hpp"
#include "renders/gltf_track.hpp"
#include "renders/machine_view.hpp"
#include "renders/png_image.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double degree = std::numbers::pi / 180;

Placement turned_by(double angle_deg) {
  Placement placement;
  placement.rotation = {0, 0, std::sin(angle_deg * degree / 2), std::cos(angle_deg * degree / 2)};
  return placement;
}
double angle_of(const Placement& placement) {
  return 2 * std::atan2(placement.rotation.z(), placement.rotation.w()) / degree;
}

/// So many keys, a hundredth of a second apart.
template <typename Place>
Track track(int keys, const Place& place) {
  Track made;
  for (int i = 0; i < keys; ++i) made.push_back({0.01 * i, place(i)});
  return made;
}

TEST(ThinTrack, AnEvenTurnNeedsAKeyEach120Degrees) {
  const auto even = track(73, [](int i) { return turned_by(25.0 * i); });
  const auto few = thinned(even);
  EXPECT_EQ(few.size(), 19U) << "four times 25 degrees, 72 of them";
  // Between its keys too.
  for (double time = 0; time < 0.72; time += 0.0007) {
    const double off = std::remainder(angle_of(placement_at(few, time)) - 2500 * time, 360);
    EXPECT_NEAR(off, 0, 1e-6) << time;
  }
}

TEST(ThinTrack, WhatSpeedsUpIsNowhereFarOff) {
  const auto swings = track(400, [](int i) {
    auto placement = turned_by(40 * std::sin(0.01 * i));
    placement.position = {0.3 * std::cos(0.004 * i), 0.01 * i, -2};
    placement.scale = {1 + 0.2 * std::sin(0.005 * i), 1, 1};
    return placement;
  });
  const auto few = thinned(swings);
  EXPECT_LT(few.size(), swings.size() / 4);
  double furthest = 0;
  for (const auto& key : swings) {
    const auto shown = placement_at(few, key.time_s);
    furthest = std::max(furthest, (shown.position - key.placement.position).norm());
    EXPECT_LE((shown.position - key.placement.position).norm(), 1e-4 + 1e-12);
    EXPECT_NEAR(angle_of(shown), angle_of(key.placement), 0.1 + 1e-6);
    EXPECT_LE((shown.scale - key.placement.scale).norm(), 1e-4 + 1e-12);
  }
  EXPECT_GT(furthest, 2e-5) << "what may be left out is left out";
  EXPECT_EQ(few.front().time_s, 0);
  EXPECT_EQ(few.back().time_s, swings.back().time_s);
}

TEST(ThinTrack, JumpsStayJumps) {
  const auto jumps = track(100, [](int i) {
    Placement placement;
    placement.position = {i < 50 ? 0.0 : 1.0, 0, 0};
    placement.scale = i < 30 ? Vec3::Zero() : Vec3::Ones();
    return placement;
  });
  const auto few = thinned(jumps);
  EXPECT_EQ(placement_at(few, 0.29).scale, Vec3::Zero());
  EXPECT_EQ(placement_at(few, 0.30).scale, Vec3::Ones());
  EXPECT_EQ(placement_at(few, 0.49).position.x(), 0);
  EXPECT_EQ(placement_at(few, 0.50).position.x(), 1);
  // Outside it stands.
  EXPECT_EQ(placement_at(few, -1).scale, Vec3::Zero());
  EXPECT_EQ(placement_at(few, 9).position.x(), 1);
  EXPECT_EQ(thinned(track(1, [](int) { return Placement(); })).size(), 1U);
}

/// A drum that swings, a frame that stands, a piece that comes at 2 s; from 0.5 s, 25 frames a second.
Film line() {
  Film film;
  film.parts = {{"knife.drum", SolidPart::Shape::cylinder, {0.2, 0.2, 0.4}},
                {"knife.frame", SolidPart::Shape::box, {0.3, 0.6, 0.1}},
                {"web.piece 1", SolidPart::Shape::box, {1, 0.1, 0.3}}};
  for (int i = 0; i < 100; ++i) {
    auto& frame = film.frames.emplace_back();
    frame.time_s = 0.5 + 0.04 * i;
    Placement piece;
    piece.visible = frame.time_s > 2;
    frame.placements = {turned_by(20 * std::sin(i)), Placement(), piece};
  }
  return film;
}

TEST(MachineInAPage, IsWhereTheFilmHasIt) {
  const auto film = line();
  const auto view = machine_view(film);
  EXPECT_EQ(view.parts, (std::vector<std::string>{"knife.drum", "knife.frame", "web.piece 1"}));
  EXPECT_EQ(view.from_s, 0.5);
  EXPECT_NEAR(view.until_s, 4.46, 1e-9);
  EXPECT_EQ(view.until_s, view.recorded_until_s);
  EXPECT_EQ(view.tracks[1].size(), 1U) << "what stands has one key";
  for (const auto& frame : film.frames) {
    const auto drum = placement_at(view.tracks[0], frame.time_s + 1e-9);
    EXPECT_NEAR(angle_of(drum), angle_of(frame.placements[0]), 0.1 + 1e-3);
    EXPECT_EQ(placement_at(view.tracks[2], frame.time_s + 1e-9).visible, frame.placements[2].visible)
        << frame.time_s;
  }
  EXPECT_THAT(view_figure(view), AllOf(HasSubstr("id=\"machine\""), HasSubstr("from 0.500 s to 4.460 s<")));
}

TEST(MachineInAPage, TooLongARunEndsEarlyAndSaysSo) {
  const auto whole = machine_view(line());
  const auto view = machine_view(line(), 40);
  EXPECT_LT(view.until_s, whole.until_s - 1);
  EXPECT_GT(view.until_s, view.from_s + 0.5);
  EXPECT_EQ(view.recorded_until_s, whole.until_s);
  std::size_t keys = 0;
  for (const auto& track : view.tracks) {
    keys += track.size();
    EXPECT_LE(track.back().time_s, view.until_s);
  }
  EXPECT_LE(keys, 42U);
  EXPECT_GE(keys, 30U);
  EXPECT_THAT(
      view_figure(view),
      HasSubstr(fmt::format("to {:.3f} s; up to 4.460 s it would make this report too heavy", view.until_s)));
}

TEST(MachineInAPage, NeedsThreeAndHasALimit) {
  const Scratch scratch;
  const auto view = machine_view(line());
  const auto folder = scratch.path.string();
  EXPECT_THAT(live_view(view, folder),
              AllOf(HasSubstr("libjs-three, which was not installed"), Not(HasSubstr("<script"))));
  std::filesystem::create_directories(scratch / "examples/js/loaders");
  std::filesystem::create_directories(scratch / "examples/js/controls");
  for (const auto* name :
       {"three.min.js", "examples/js/loaders/GLTFLoader.js", "examples/js/controls/OrbitControls.js"})
    write_file(scratch / name, "/* </script> */");
  const auto page = live_view(view, folder);
  for (const auto* id : {"view-library", "view-machine", "view-motion"})
    EXPECT_THAT(page, HasSubstr(fmt::format("<script type=\"application/octet-stream\" id=\"{}\">", id)));
  EXPECT_THAT(page, Not(HasSubstr("/* </script> */"))) << "it is packed";
  EXPECT_EQ(live_view(view, folder), page) << "the same bytes";
  EXPECT_THAT(live_view(view, folder, 1000),
              AllOf(HasSubstr("MB to this report"), Not(HasSubstr("<script"))));
}

}  // namespace
}  // namespace drycut::renders
