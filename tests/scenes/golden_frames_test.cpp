// A small frame a plant against a picture that was looked at and kept (tests/renders/golden). After a wanted
// change of the looks: DRYCUT_KEEP_FRAMES=1, run this test, look at the new pictures, keep them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/output_file.hpp"
#include "renders/caption_bar.hpp"
#include "renders/pictures.hpp"
#include "renders/png_image.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/report/film.hpp"

namespace drycut::sim {
namespace {

struct Golden {
  const char* scene;
  const char* from;
  const char* until;
  const char* part;  ///< one that the picture cannot do without
};
constexpr Golden kGolden[] = {
    {"rotary_knife", "4.34 s", "4.39 s", "knife.drum"},
    {"flying_saw", "8.154 s", "8.204 s", "saw.column"},
    {"fly_cut", "10.008 s", "10.158 s", "saw.column"},
    {"press_learning", "4 s", "4.15 s", "press.ram"},
};

renders::Film film_for(const Golden& golden) {
  Problems problems;
  const auto scenario = scenario::read_scenario(
      std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes" / (std::string(golden.scene) + ".yaml"),
      {{"pictures.frames.from", golden.from},
       {"pictures.frames.until", golden.until},
       {"pictures.frames.size", "320x180"}},
      problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  loop::Simulation simulation(scenario, problems);
  simulation.run();
  auto film = report::film_of(scenario, simulation);
  EXPECT_FALSE(film.frames.empty());
  film.frames.resize(1);
  return film;
}

renders::Image drawn(const renders::Film& film, const std::string& name) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / ("golden_" + name);
  return renders::read_png(renders::draw_film(film, folder).at(0));
}

/// How much of the picture one sees to be another: the share of blocks of 8 x 4 pixels whose mean colour
/// differs by more than 10 of 255 in any channel. Single pixels of edges, which differ between processors and
/// versions of Mesa, do not count.
double difference(const renders::Image& a, const renders::Image& b) {
  if (a.width != b.width || a.height != b.height) return 1;
  constexpr int wide = 8, high = 4;
  int different = 0, blocks = 0;
  for (int y = 0; y + high <= a.height; y += high) {
    for (int x = 0; x + wide <= a.width; x += wide, ++blocks) {
      int worst = 0;
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int i = 0; i < wide * high; ++i) {
          const int at = 3 * (x + i % wide) + c;
          sum += a.row(y + i / wide)[at] - b.row(y + i / wide)[at];
        }
        worst = std::max(worst, std::abs(sum) / (wide * high));
      }
      if (worst > 10) ++different;
    }
  }
  return static_cast<double>(different) / blocks;
}
constexpr double tolerated = 0.005;

class GoldenFrame : public ::testing::TestWithParam<Golden> {};
INSTANTIATE_TEST_SUITE_P(OfEveryPlant, GoldenFrame, ::testing::ValuesIn(kGolden),
                         [](const auto& one) { return std::string(one.param.scene); });

TEST_P(GoldenFrame, LooksAsItWasKept) {
  const auto film = film_for(GetParam());
  const auto image = drawn(film, GetParam().scene);
  const auto file = std::filesystem::path(DRYCUT_SOURCE_DIR) / "tests/renders/golden" /
                    (std::string(GetParam().scene) + ".png");
  if (std::getenv("DRYCUT_KEEP_FRAMES") != nullptr) write_file(file, renders::png_bytes(image));
  const auto golden = renders::read_png(file);
  EXPECT_LE(difference(image, golden), tolerated);
  EXPECT_EQ(image.rgb, drawn(film, GetParam().scene).rgb) << "the same run twice";

  // What this test must notice: a part that is missing, a light that is a tenth weaker.
  auto without = film;
  for (std::size_t i = 0; i < without.parts.size(); ++i)
    if (without.parts[i].name == GetParam().part) without.frames[0].placements[i].visible = false;
  without.camera = film.camera;
  EXPECT_GT(difference(drawn(without, GetParam().scene), golden), tolerated);
  auto dim = image;
  for (auto& value : dim.rgb) value = static_cast<std::uint8_t>(value * 9 / 10);
  EXPECT_GT(difference(dim, golden), 0.2);
}

TEST_P(GoldenFrame, CaptionIsLegibleAndThePictureIsNotBlank) {
  const auto film = film_for(GetParam());
  const auto image = drawn(film, GetParam().scene);
  const int view = film.height - renders::CaptionLayout(film).height();
  const auto spread = [&](int from, int until) {
    double sum = 0, squares = 0;
    const double count = static_cast<double>(until - from) * film.width;
    for (int y = from; y < until; ++y) {
      for (int x = 0; x < film.width; ++x) {
        const double green = image.row(y)[3 * x + 1];
        sum += green;
        squares += green * green;
      }
    }
    return std::sqrt(squares / count - sum * sum / count / count);
  };
  EXPECT_GT(spread(0, view), 25) << "many tones in the picture";
  int bright = 0;
  for (int y = view + 3; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x)
      if (image.row(y)[3 * x + 1] > 150) ++bright;
  EXPECT_GT(bright, 250) << "letters on the dark bar";
}

}  // namespace
}  // namespace drycut::sim
