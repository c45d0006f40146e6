#include "renders/plots.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "renders/axes.hpp"
#include "renders/decimate.hpp"
#include "renders/plot_layout.hpp"
#include "renders/png_image.hpp"
#include "renders/text.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Curve ramp(std::size_t count) {
  Curve curve;
  curve.label = "AxisX.posit_now";
  for (std::size_t i = 0; i < count; ++i) {
    curve.x.push_back(static_cast<double>(i));
    curve.y.push_back(std::sin(0.01 * static_cast<double>(i)));
  }
  return curve;
}

TEST(Extremes, KeepsEveryPeakOfALongCurve) {
  Curve curve = ramp(1'000'000);
  curve.y[123'456] = 7;
  curve.y[123'457] = -5;
  curve.y[999'999] = 9;
  thin(curve.x, curve.y);
  EXPECT_LE(curve.x.size(), 2 * kStretches);
  EXPECT_TRUE(std::is_sorted(curve.x.begin(), curve.x.end()));
  const auto at = [&](double x) {
    const auto found = std::lower_bound(curve.x.begin(), curve.x.end(), x);
    return found != curve.x.end() && *found == x ? curve.y[static_cast<std::size_t>(found - curve.x.begin())]
                                                 : kNan;
  };
  EXPECT_EQ(at(123'456), 7);
  EXPECT_EQ(at(123'457), -5);
  EXPECT_EQ(at(999'999), 9);
  // What is left are samples, and of every stretch the extremes: nowhere more than a stretch apart.
  for (std::size_t i = 1; i < curve.x.size(); ++i) ASSERT_LE(curve.x[i] - curve.x[i - 1], 200);
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (std::abs(curve.y[i]) > 1) continue;
    ASSERT_EQ(curve.y[i], std::sin(0.01 * curve.x[i]));
  }
}

TEST(Extremes, LeavesWhatIsShortAsItIs) {
  Curve curve = ramp(kMostSamples);
  const Curve before = curve;
  thin(curve.x, curve.y);
  EXPECT_EQ(curve.x, before.x);
  EXPECT_EQ(curve.y, before.y);
}

TEST(Cloud, DrawsAPathThatIsRunAgainAndAgainOnce) {
  const auto circle = [](std::size_t samples) {
    Cloud cloud(samples, {-1, 1, -1, 1}, true);
    for (std::size_t i = 0; i < samples; ++i) {
      const double angle = 0.001 * static_cast<double>(i);
      cloud.add(std::cos(angle), std::sin(angle));
    }
    return cloud.take();
  };
  EXPECT_EQ(circle(kMostSamples).x.size(), kMostSamples);
  const Points once = circle(1'000'000);
  EXPECT_LT(once.x.size(), 30'000U);
  double top = 0;
  for (const double y : once.y)
    if (std::isfinite(y)) top = std::max(top, y);
  EXPECT_NEAR(top, 1, 1e-6);
}

Plot plot_of(std::vector<Curve> curves) {
  Plot plot;
  plot.name = "axis_x";
  plot.title = "axis_x";
  plot.x_label = "time [s]";
  plot.width = 800;
  plot.panels.push_back({"position_of_axis", "posit_now [counts]", std::move(curves), {}, {}});
  return plot;
}

int first_colour(const Image& image) { return pixels_like(image, 0x00, 0x72, 0xb2); }

TEST(RendersPlots, PictureHasTheSizeOfItsLayout) {
  Plot plot = plot_of({ramp(500)});
  plot.panels.push_back(plot.panels[0]);
  plot.panels.push_back(plot.panels[0]);
  const Image image = drawn(plot);
  EXPECT_EQ(image.width, 800);
  EXPECT_GE(image.height, 3 * plot.panel_height);
  EXPECT_LE(image.height, 3 * plot.panel_height + 120);
  EXPECT_GT(first_colour(image), 1000);
}

TEST(RendersPlots, SameDataSameBytes) {
  const Scratch scratch;
  const Plot plot = plot_of({ramp(5000)});
  const auto a = draw_plots({plot}, scratch / "a");
  const auto b = draw_plots({plot}, scratch / "b");
  EXPECT_EQ(a.at(0).filename(), "axis_x.png");
  EXPECT_EQ(read_file(a.at(0)), read_file(b.at(0)));
}

TEST(RendersPlots, UnderscoreIsDrawnAsItIs) {
  Plot plain = plot_of({ramp(50)});
  Plot braces = plain;
  plain.x_label = "a_b";
  braces.x_label = "a_{b}";
  EXPECT_NE(drawn(plain).rgb, drawn(braces).rgb);
}

TEST(RendersPlots, GapIsNotBridged) {
  // 40 % of a flat line is missing: so many columns have no pixel of its colour.
  Curve whole;
  for (int i = 0; i <= 1000; ++i) {
    whole.x.push_back(i);
    whole.y.push_back(1);
  }
  Curve broken = whole;
  for (std::size_t i = 300; i < 700; ++i) broken.y[i] = kNan;
  const auto coloured_columns = [](const Image& image) {
    int columns = 0;
    for (int x = 0; x < image.width; ++x) {
      for (int y = 0; y < image.height; ++y) {
        const std::uint8_t* p = image.row(y) + 3 * x;
        if (p[0] < 60 && p[2] > 140) {
          ++columns;
          break;
        }
      }
    }
    return columns;
  };
  const int all = coloured_columns(drawn(plot_of({whole})));
  const int some = coloured_columns(drawn(plot_of({broken})));
  EXPECT_GT(all, 600);
  EXPECT_NEAR(some, 0.6 * all, 12);
}

TEST(RendersPlots, StepsAreDrawnAsSteps) {
  Curve line;
  line.x = {0, 1};
  line.y = {0, 1};
  Curve steps = line;
  steps.style = Curve::Style::steps;
  EXPECT_NE(drawn(plot_of({line})).rgb, drawn(plot_of({steps})).rgb);
}

TEST(RendersPlots, LonelySamplesAreVisible) {
  Curve lonely;
  lonely.x = {0, 1, 2, 3, 4};
  lonely.y = {kNan, 1, kNan, 2, kNan};
  Curve none = lonely;
  none.y = {kNan, kNan, kNan, kNan, kNan};
  EXPECT_GT(first_colour(drawn(plot_of({lonely}))), first_colour(drawn(plot_of({none}))) + 10);
}

TEST(RendersPlots, EmptyCurvesAndPanelsAreDrawn) {
  Curve empty;
  empty.label = "nothing";
  EXPECT_GT(drawn(plot_of({empty})).width, 0);
  EXPECT_GT(drawn(plot_of({})).width, 0);
  EXPECT_GT(drawn(plot_of({empty, ramp(20)})).width, 0);
  EXPECT_NE(drawn(plot_of({empty})).rgb, drawn(plot_of({ramp(5)})).rgb);
}

TEST(RendersPlots, BandsAndLimitsShow) {
  Plot plot = plot_of({ramp(500)});
  const Image without = drawn(plot);
  plot.panels[0].bands = {{"tolerance ±0.5", -0.5, 0.5}, {"alarm", 0.9, 0.9}, {"far away", 50, 60}};
  plot.panels[0].y_range = std::pair{-1.2, 1.2};
  const Image with = drawn(plot);
  EXPECT_GT(pixels_like(with, 250, 241, 199), 20000) << "a translucent fill";
  EXPECT_GT(pixels_like(with, 0xb3, 0x26, 0x1e), 100) << "a limit line";
  EXPECT_EQ(pixels_like(without, 0xb3, 0x26, 0x1e), 0);
}

TEST(RendersPlots, AnyTextIsDrawn) {
  for (const std::string& odd : {std::string("`ls` '\" @x $HOME %d {1}_2 ^3 \\"), std::string("two\nlines\t"),
                                 std::string("\xff\x01 \\"), std::string("±0.1 µm …"), std::string()}) {
    Curve curve = ramp(10);
    curve.label = odd;
    Plot plot = plot_of({curve});
    plot.title = plot.x_label = odd;
    plot.panels[0].title = plot.panels[0].y_label = odd;
    plot.panels[0].bands = {{odd, 0, 1}};
    EXPECT_GT(first_colour(drawn(plot)), 100) << odd;
  }
}

TEST(RendersPlots, APictureHigherThanCairoTakesIsDrawn) {
  Plot plot = plot_of({ramp(50)});
  plot.width = 400;
  plot.panels.assign(120, plot.panels[0]);
  const Image image = drawn(plot);
  EXPECT_GT(image.height, 35'000);
  Image last(image.width, 300);
  std::copy(image.row(image.height - 300), image.row(image.height), last.row(0));
  EXPECT_GT(first_colour(last), 200) << "the last panel is there too";
}

TEST(RendersPlots, AMillionSamplesBecomeAFewThousand) {
  Curve curve = ramp(1000000);
  curve.y[123456] = 7;   // one sample sticks out
  curve.y[654321] = -9;  // and one the other way
  const Points points = decimated(curve, {0, 1e6, -10, 10, 1000, 300});
  EXPECT_LE(points.x.size(), 4U * 1001);
  EXPECT_GE(points.x.size(), 1000U);
  EXPECT_EQ(std::count(points.y.begin(), points.y.end(), 7), 1);
  EXPECT_EQ(std::count(points.y.begin(), points.y.end(), -9), 1);
  EXPECT_EQ(points.x.front(), 0);
  EXPECT_EQ(points.x.back(), 999999);
  EXPECT_TRUE(std::is_sorted(points.x.begin(), points.x.end()));
  EXPECT_GT(first_colour(drawn(plot_of({curve}))), 1000);
}

TEST(RendersPlots, DecimationLeavesShortCurvesAlone) {
  const Curve curve = ramp(50);
  const Points points = decimated(curve, {0, 50, -1, 1, 1000, 300});
  EXPECT_EQ(points.x, curve.x);
  EXPECT_EQ(points.y, curve.y);
}

TEST(RendersPlots, DecimationKeepsGapsOnceAndNotAtTheEnds) {
  Curve curve;
  curve.x = {0, 1, 2, 3, 4, 5, 6};
  curve.y = {kNan, 1, kNan, std::numeric_limits<double>::infinity(), 2, 3, kNan};
  const Points points = decimated(curve, {0, 6, 0, 4, 100, 100});
  ASSERT_EQ(points.y.size(), 5U);
  EXPECT_EQ(points.y[0], 1);
  EXPECT_TRUE(std::isnan(points.y[1]));
  EXPECT_EQ(points.y[2], 2);
  EXPECT_EQ(points.y[3], 3);
  EXPECT_TRUE(std::isnan(points.y[4])) << "harmless at the end";
}

TEST(RendersPlots, DecimatedPointsAreOneAPixel) {
  Curve curve;
  curve.style = Curve::Style::points;
  std::set<std::pair<int, int>> pixels;
  for (int i = 0; i < 100000; ++i) {
    const double x = std::fmod(i * 0.618033988, 1.0);
    const double y = std::fmod(i * 0.754877666, 1.0);
    curve.x.push_back(x);
    curve.y.push_back(y);
    pixels.insert({static_cast<int>(x * 50), static_cast<int>(y * 20)});
  }
  EXPECT_EQ(decimated(curve, {0, 1, 0, 1, 50, 20}).x.size(), pixels.size());
}

TEST(RendersPlots, TicksAreRoundAndToldApart) {
  const auto labels = [](double low, double high, int wanted, double least = 0) {
    std::vector<std::string> words;
    for (const Tick& tick : axis_ticks(low, high, wanted, least)) words.push_back(tick.label);
    return words;
  };
  EXPECT_EQ(labels(0, 10, 5), (std::vector<std::string>{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels(-0.06, 1.06, 6, 1), (std::vector<std::string>{"0", "1"}));
  EXPECT_EQ(labels(799.9, 800.1, 4),
            (std::vector<std::string>{"799.90", "799.95", "800.00", "800.05", "800.10"}));
  EXPECT_EQ(labels(-1, 1, 2), (std::vector<std::string>{"-1", "0", "1"}));
  EXPECT_EQ(labels(0, 4e9, 4), (std::vector<std::string>{"0", "1e+09", "2e+09", "3e+09", "4e+09"}));
  for (const auto& [low, high] :
       {std::pair{1e6, 1e6 + 0.1}, {-3e-7, 5e-7}, {1e15, 1e15 + 10}, {-1e150, 1e150}}) {
    const auto words = labels(low, high, 5);
    EXPECT_GE(words.size(), 2U) << low;
    EXPECT_LE(words.size(), 9U) << low;
    EXPECT_EQ(std::set<std::string>(words.begin(), words.end()).size(), words.size()) << low;
  }
}

TEST(RendersPlots, LegendStaysInsideAndAboveTheAxes) {
  std::vector<Curve> curves;
  for (int i = 0; i < 14; ++i) {
    Curve curve = ramp(10);
    curve.label = "channel_number_" + std::to_string(i) + (i == 7 ? std::string(300, 'w') : "");
    curves.push_back(curve);
  }
  Plot plot = plot_of(curves);
  const PlotLayout layout = laid_out(plot);
  const auto& legend = layout.panels[0].legend;
  ASSERT_EQ(legend.size(), 14U);
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const double right =
        legend[i].left + kLegendSample + kLegendGap + text_width(legend[i].label, PlotType::text);
    EXPECT_LE(right, layout.right + 0.5);
    EXPECT_GE(legend[i].left, layout.left);
    EXPECT_LT(legend[i].baseline, layout.panels[0].top - 8);
    if (i == 0 || legend[i].baseline != legend[i - 1].baseline) continue;
    EXPECT_GT(legend[i].left, legend[i - 1].left + text_width(legend[i - 1].label, PlotType::text));
  }
  EXPECT_LT(layout.panels[0].top, layout.panels[0].bottom - 100);
  EXPECT_GT(layout.height, layout.panels[0].bottom);
}

TEST(RendersPlots, RangesHoldDataAndBands) {
  Plot plot = plot_of({ramp(1000)});
  plot.panels[0].bands = {{"limit", -3, 4}, {"open", -std::numeric_limits<double>::infinity(), 1}};
  const PlotLayout layout = laid_out(plot);
  EXPECT_LT(layout.panels[0].y_range.first, -3);
  EXPECT_GT(layout.panels[0].y_range.second, 4);
  EXPECT_TRUE(std::isfinite(layout.panels[0].y_range.first));
  EXPECT_EQ(layout.x_range.first, 0);
  EXPECT_EQ(layout.x_range.second, 1000) << "999 is so near to a mark that the axis goes there";
}

TEST(RendersPlots, RefusesWhatCannotBeDrawn) {
  const Scratch scratch;
  const auto refusal = [&](const auto& change) {
    Plot plot = plot_of({ramp(5)});
    change(plot);
    return message_of<std::invalid_argument>([&] { draw_plots({plot}, scratch.path); });
  };
  EXPECT_THAT(refusal([](Plot& p) { p.panels[0].curves[0].y.pop_back(); }),
              HasSubstr("plot 'axis_x': curve 'AxisX.posit_now' has 5 x and 4 y values"));
  EXPECT_THAT(refusal([](Plot& p) { p.name = "../up"; }), HasSubstr("must be a file name"));
  EXPECT_THAT(refusal([](Plot& p) { p.panels.clear(); }), HasSubstr("it has no panel"));
  EXPECT_THAT(refusal([](Plot& p) { p.width = 0; }),
              HasSubstr("width 0 and panel height 300 cannot be drawn"));
  EXPECT_THAT(refusal([](Plot& p) {
                p.panels[0].y_range = std::pair{2.0, 1.0};
              }),
              HasSubstr("the y range must go from low to high"));
}

TEST(RendersText, OneLineIsCleanUtf8) {
  EXPECT_EQ(one_line("a\nb\tc"), "a b c");
  EXPECT_EQ(one_line("±µ°…"), "±µ°…");
  EXPECT_EQ(one_line("\xff|\xc3|\xe2\x82|\xc0\xaf|\xed\xa0\x80"), "?|?|??|??|???");
  std::string text = "mm²";
  drop_last_character(text);
  EXPECT_EQ(text, "mm");
  drop_last_character(text = "");
  EXPECT_EQ(text, "");
}

TEST(RendersText, FittedTextFits) {
  EXPECT_EQ(fitted_text("short", 15, 500), "short");
  const std::string cut = fitted_text("a rather long label [counts]", 15, 100);
  EXPECT_LE(text_width(cut, 15), 100);
  EXPECT_THAT(cut, HasSubstr("…"));
}

TEST(RendersText, LongTextIsWrappedAtItsWords) {
  using ::testing::ElementsAre;
  EXPECT_THAT(wrapped_text("short", 15, 500, 3), ElementsAre("short"));
  EXPECT_THAT(wrapped_text("", 15, 500, 3), ElementsAre(""));
  const std::string text = "one two three four five six";
  const double room = text_width("three four", 15);
  EXPECT_THAT(wrapped_text(text, 15, room, 3), ElementsAre("one two", "three four", "five six"));
  const auto two = wrapped_text(text, 15, room, 2);
  EXPECT_THAT(two, ElementsAre("one two", HasSubstr("three"))) << "no third line";
  EXPECT_THAT(two.back(), HasSubstr("…"));
  EXPECT_LE(text_width(two.back(), 15), room);
  const auto wide = wrapped_text("averyverylongwordindeed and more", 15, room, 3);
  EXPECT_THAT(wide.at(0), HasSubstr("…"));
  EXPECT_EQ(wide.at(1), "and more");
  for (const auto& line : wide) EXPECT_LE(text_width(line, 15), room);
}

}  // namespace
}  // namespace drycut::renders
