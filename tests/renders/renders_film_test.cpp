#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "base/output_file.hpp"
#include "renders/camera.hpp"
#include "renders/caption_bar.hpp"
#include "renders/pictures.hpp"
#include "renders/png_image.hpp"
#include "renders/tiles.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using ::testing::HasSubstr;

/// A red cube of 0.4 m and a blue cylinder beside it, seen from the front; the cube moves right.
Film two_parts() {
  Film film;
  film.title = "two parts";
  film.width = 480;
  film.height = 300;
  SolidPart cube;
  cube.name = "cube";
  cube.size = {0.4, 0.4, 0.4};
  cube.colour = {0.9F, 0.1F, 0.1F};
  cube.material = "paint";
  SolidPart roll;
  roll.name = "roll";
  roll.shape = SolidPart::Shape::cylinder;
  roll.size = {0.4, 0.4, 0.4};
  roll.colour = {0.1F, 0.2F, 0.9F};
  roll.material = "paint";
  film.parts = {cube, roll};
  for (int i = 0; i < 3; ++i) {
    Frame frame;
    frame.time_s = 0.04 * i;
    frame.placements.resize(2);
    frame.placements[0].position = {-0.5 + 0.1 * i, 0.2, 0};
    frame.placements[1].position = {0.5, 0.2, 0};
    frame.caption = {{"web.speed", "60.0 m/min"}, {"frame", std::to_string(i)}};
    film.frames.push_back(frame);
  }
  film.camera.eye = {0, 0.5, 3};
  film.camera.target = {0, 0.2, 0};
  return film;
}

std::array<int, 3> colour_at(const Image& image, const std::array<double, 2>& at) {
  const std::uint8_t* p = image.row(static_cast<int>(at[1])) + 3 * static_cast<int>(at[0]);
  return {p[0], p[1], p[2]};
}

TEST(RendersFilm, PartsAreWhereTheCameraProjectsThem) {
  const Scratch scratch;
  const Film film = two_parts();
  const auto files = draw_film(film, scratch / "frames");
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[2].filename(), "frame_00002.png");
  const int view = film.height - CaptionLayout(film).height();
  for (std::size_t i = 0; i < files.size(); ++i) {
    const Image image = read_png(files[i]);
    ASSERT_EQ(image.width, 480);
    ASSERT_EQ(image.height, 300);
    const Vec3 cube = film.frames[i].placements[0].position + Vec3{0.1, 0, 0.2};
    const auto red = colour_at(image, projected(film.camera, film.width, view, cube));
    EXPECT_GT(red[0], red[1] + 60) << "frame " << i;
    EXPECT_GT(red[0], red[2] + 60) << "frame " << i;
    const auto blue = colour_at(image, projected(film.camera, film.width, view, {0.6, 0.28, 0.2}));
    EXPECT_GT(blue[2], blue[0] + 40) << "frame " << i;
    // Above both there is only background, which is grey to bluish.
    const auto back = colour_at(image, projected(film.camera, film.width, view, {0, 0.9, 0}));
    EXPECT_LT(std::abs(back[0] - back[1]), 40) << "frame " << i;
  }
}

TEST(RendersFilm, HiddenPartIsNotDrawn) {
  const Scratch scratch;
  Film film = two_parts();
  film.frames.resize(1);
  film.frames[0].placements[0].visible = false;
  film.frames[0].placements[0].position[0] = std::numeric_limits<double>::quiet_NaN();  // nobody asks for it
  const Image image = read_png(draw_film(film, scratch.path).at(0));
  const int view = film.height - CaptionLayout(film).height();
  const auto there = colour_at(image, projected(film.camera, film.width, view, {-0.4, 0.2, 0.2}));
  EXPECT_LT(std::abs(there[0] - there[1]), 40);
}

TEST(RendersFilm, FloorCatchesShadow) {
  const Scratch scratch;
  Film film = two_parts();
  film.frames.resize(1);
  film.camera.eye = {0, 3, 2};
  film.camera.target = {0, 0, 0};
  const int view = film.height - CaptionLayout(film).height();
  const Image image = read_png(draw_film(film, scratch.path).at(0));
  // The lamp is upstream and on the operator's side, so the shadow falls downstream and away from him.
  const auto shadow = colour_at(image, projected(film.camera, film.width, view, {-0.25, 0, -0.1}));
  const auto light = colour_at(image, projected(film.camera, film.width, view, {-0.9, 0, 0.3}));
  EXPECT_LT(shadow[1], light[1] - 25);
}

TEST(RendersFilm, EdgesAreAntialiased) {
  const Scratch scratch;
  Film film = two_parts();
  film.frames.resize(1);
  film.frames[0].placements[0].rotation = {0, 0, 0.1, 1};
  const Image image = read_png(draw_film(film, scratch.path).at(0));
  // Left alone, a slanted edge between red and grey knows two colours; smoothed, each of its six stairs has
  // steps in between.
  const int view = film.height - CaptionLayout(film).height();
  const int row = static_cast<int>(projected(film.camera, film.width, view, {-0.5, 0.2, 0.2})[1]);
  int between = 0;
  for (int y = row - 15; y < row + 15; ++y) {
    int redness_before = 0;
    for (int x = 0; x < image.width / 2; ++x) {
      const std::uint8_t* p = image.row(y) + 3 * x;
      const int redness = p[0] - p[1];
      if (redness > 25 && redness < 80 && redness_before < 20) ++between;
      redness_before = redness;
    }
  }
  EXPECT_GE(between, 6);
}

TEST(RendersFilm, LampsOfTheCaptionAreLitOrDark) {
  Film film = two_parts();
  film.frames[0].caption = {{"in sync", "", true}};
  film.frames[1].caption = {{"in sync", "", false}};
  const CaptionLayout caption(film);
  const auto green = [&](std::size_t frame) {
    Image image(film.width, film.height);
    caption.draw(film.frames[frame], image);
    int count = 0;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
      if (image.rgb[i + 1] > image.rgb[i] + 80) ++count;
    return count;
  };
  EXPECT_GT(green(0), 30);
  EXPECT_EQ(green(1), 0);
}

TEST(RendersFilm, APictureComesBackFromItsPng) {
  const Scratch scratch;
  Image image(37, 11);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<std::uint8_t>(i * i / 7);
  for (const int effort : {1, 6, 9, 12}) {
    write_file(scratch / "a.png", png_bytes(image, effort));
    const Image again = read_png(scratch / "a.png");
    EXPECT_EQ(again.width, 37);
    EXPECT_EQ(again.rgb, image.rgb) << effort;
  }
  EXPECT_EQ(message_of<std::runtime_error>([] { png_bytes(Image()); }),
            "pictures: a picture cannot be compressed");
}

TEST(RendersFilm, SeveralCamerasShareThePicture) {
  const Scratch scratch;
  Film film = two_parts();
  film.frames.resize(2);
  const Camera front = film.camera;
  const Camera above = {{0, 3, 0.01}, {0, 0, 0}, 35};
  film.beside = {{"above", above}};
  film.camera_name = "front";
  film.follow = 0;  // the first camera goes along, the other one stands
  const auto split = draw_film(film, scratch / "split");
  for (std::size_t frame = 0; frame < 2; ++frame) {
    const Image both = read_png(split[frame]);
    const auto tiles = tiles_of(film);
    ASSERT_EQ(tiles.size(), 2U);
    for (std::size_t view = 0; view < 2; ++view) {
      Vec3 cube = film.frames[frame].placements[0].position + Vec3{0.1, 0.1, 0.1};
      const auto at = projected(camera_of(film, frame, view), tiles[view].width, tiles[view].height, cube);
      const auto red =
          colour_at(both, {tiles[view].left + std::clamp(at[0], 0.0, tiles[view].width - 1.0), at[1]});
      EXPECT_GT(red[0], red[1] + 40) << "frame " << frame << " view " << view;
    }
  }
  EXPECT_EQ(camera_of(film, 1, 1), above);
  EXPECT_NE(camera_of(film, 1, 0), front) << "goes along";
  film.beside.resize(4, film.beside.front());
  EXPECT_EQ(message_of<std::invalid_argument>([&] { require_drawable(film); }),
            "pictures: one to four cameras share a picture");
}

TEST(RendersFilm, SameFilmSameBytes) {
  const Scratch scratch;
  const Film film = two_parts();
  const auto first = draw_film(film, scratch / "a");
  const auto second = draw_film(film, scratch / "b");
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(read_file(first[i]), read_file(second[i])) << i;
  EXPECT_NE(read_file(first[0]), read_file(first[1])) << "the cube has moved";
}

TEST(RendersFilm, FrameDoesNotDependOnTheFramesBefore) {
  const Scratch scratch;
  Film film = two_parts();
  const auto all = draw_film(film, scratch / "all");
  // Same extent for light and camera: keep the frames, change their order.
  std::swap(film.frames[0], film.frames[2]);
  const auto swapped = draw_film(film, scratch / "swapped");
  EXPECT_EQ(read_file(all[2]), read_file(swapped[0]));
}

TEST(RendersFilm, FilmsDrawnInTwoThreadsDoNotMix) {
  const Scratch scratch;
  const Film film = two_parts();
  const auto alone = draw_film(film, scratch / "alone");
  std::thread one([&] { draw_film(film, scratch / "one"); });
  std::thread two([&] { draw_film(film, scratch / "two"); });
  one.join();
  two.join();
  for (const auto& file : alone) {
    EXPECT_EQ(read_file(file), read_file(scratch / "one" / file.filename()));
    EXPECT_EQ(read_file(file), read_file(scratch / "two" / file.filename()));
  }
}

TEST(RendersFilm, TellsItsProgress) {
  const Scratch scratch;
  std::vector<int> told;
  draw_film(two_parts(), scratch.path, [&](int done) { told.push_back(done); });
  EXPECT_EQ(told, (std::vector<int>{1, 2, 3}));
}

TEST(RendersFilm, FilmWithoutFramesGivesNoFiles) {
  const Scratch scratch;
  Film film = two_parts();
  film.frames.clear();
  EXPECT_TRUE(draw_film(film, scratch / "none").empty());
}

TEST(RendersFilm, RefusesWhatCannotBeDrawn) {
  const Scratch scratch;
  const auto refusal = [&](const auto& change) {
    Film film = two_parts();
    change(film);
    return message_of<std::invalid_argument>([&] { draw_film(film, scratch / "no"); });
  };
  EXPECT_THAT(refusal([](Film& f) { f.width = 0; }),
              HasSubstr("size 0x300 cannot be drawn; width and height are 160"));
  EXPECT_THAT(refusal([](Film& f) { f.height = 100000; }), HasSubstr("size 480x100000"));
  EXPECT_THAT(refusal([](Film& f) { f.parts[0].material = "gold"; }),
              HasSubstr("part 'cube': unknown material 'gold'; known: steel, paint"));
  EXPECT_THAT(refusal([](Film& f) { f.parts[1].size[2] = 0; }),
              HasSubstr("part 'roll': sizes must be more than 0 m"));
  EXPECT_THAT(refusal([](Film& f) { f.frames[1].placements.pop_back(); }),
              HasSubstr("frame 1: 1 placements for 2 parts"));
  EXPECT_THAT(refusal([](Film& f) { f.frames[2].placements[0].position[1] = std::nan(""); }),
              HasSubstr("frame 2: part 'cube' has no place"));
  EXPECT_THAT(refusal([](Film& f) {
                f.frames[2].placements[1].rotation = {0, 0, 0, 0};
              }),
              HasSubstr("frame 2: part 'roll' has no place"));
  EXPECT_THAT(refusal([](Film& f) { f.camera.eye = f.camera.target; }), HasSubstr("two different points"));
  EXPECT_THAT(refusal([](Film& f) { f.camera.field_of_view_deg = 0; }), HasSubstr("field of view 0 degrees"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "no")) << "refused before anything is written";
}

TEST(RendersFilm, SaysWhichFileCannotBeWritten) {
  const Scratch scratch;
  std::filesystem::create_directories(scratch / "frame_00000.png");  // a directory is in the way
  EXPECT_THAT(message_of<std::runtime_error>([&] { draw_film(two_parts(), scratch.path); }),
              HasSubstr("frame_00000.png: it is a directory"));
}

// ---- caption ----

Film with_items(int count) {
  Film film = two_parts();
  film.width = 960;
  film.height = 540;
  film.frames.resize(1);
  film.frames[0].caption.clear();
  for (int i = 0; i < count; ++i) {
    film.frames[0].caption.push_back(
        {"machine.axis_with_a_long_name_" + std::to_string(i), "-12345.678 counts/s"});
  }
  return film;
}

/// Pixels of the bar in these columns that are brighter than its ground.
int written_pixels(const Image& image, int bar, int from_x, int to_x) {
  int written = 0;
  for (int y = image.height - bar + 4; y < image.height; ++y) {
    for (int x = from_x; x < to_x; ++x) written += image.row(y)[3 * x + 1] > 90 ? 1 : 0;
  }
  return written;
}

TEST(RendersCaption, TextAppearsAndChanges) {
  Film film = two_parts();
  const CaptionLayout layout(film);
  Image first(film.width, film.height), second(film.width, film.height);
  layout.draw(film.frames[0], first);
  layout.draw(film.frames[1], second);
  EXPECT_GT(written_pixels(first, layout.height(), 0, film.width), 200);
  EXPECT_NE(first.rgb, second.rgb);
  for (int y = 0; y < film.height - layout.height(); ++y) {
    for (int x = 0; x < 3 * film.width; ++x) ASSERT_EQ(first.row(y)[x], 0) << "drawn above the bar";
  }
}

TEST(RendersCaption, ManyLongItemsStayInsideThePicture) {
  for (const int count : {0, 1, 5, 12, 40}) {
    const Film film = with_items(count);
    const CaptionLayout layout(film);
    Image image(film.width, film.height);
    layout.draw(film.frames[0], image);
    EXPECT_GT(written_pixels(image, layout.height(), 0, film.width), 100);
    EXPECT_EQ(written_pixels(image, layout.height(), 0, 12), 0) << count << " items";
    EXPECT_EQ(written_pixels(image, layout.height(), film.width - 12, film.width), 0) << count << " items";
    EXPECT_LT(layout.height(), film.height / 3) << count << " items";
    // The lowest rows stay free: nothing is cut off below.
    for (int x = 0; x < film.width; ++x) EXPECT_LT(image.row(film.height - 1)[3 * x + 1], 60);
  }
}

TEST(RendersCaption, DigitsStayWhereTheyAre) {
  // The second item must not move when the first grows from one digit to four.
  Film film = two_parts();
  film.frames.resize(2);
  film.frames[0].caption = {{"error", "7 counts"}, {"speed", "60 m/min"}};
  film.frames[1].caption = {{"error", "1234 counts"}, {"speed", "60 m/min"}};
  film.frames[1].time_s = film.frames[0].time_s;
  const CaptionLayout layout(film);
  Image first(film.width, film.height), second(film.width, film.height);
  layout.draw(film.frames[0], first);
  layout.draw(film.frames[1], second);
  int last_difference = 0;
  for (int y = 0; y < film.height; ++y) {
    for (int x = 0; x < film.width; ++x) {
      if (first.row(y)[3 * x] != second.row(y)[3 * x]) last_difference = std::max(last_difference, x);
    }
  }
  EXPECT_GT(last_difference, 0);
  EXPECT_LT(last_difference, 150) << "only the first number, right-aligned, has changed";
}

TEST(RendersCaption, TextThatIsNoUtf8IsStillDrawn) {
  Film film = two_parts();
  film.title = "bad \xff\xfe title";
  const CaptionLayout layout(film);
  Image image(film.width, film.height);
  layout.draw(film.frames[0], image);
  EXPECT_GT(written_pixels(image, layout.height(), film.width - 120, film.width), 20)
      << "the time, at the right";
}

}  // namespace
}  // namespace drycut::renders
