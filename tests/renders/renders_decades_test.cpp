#include <gmock/gmock.h>

#include <cmath>

#include "renders/axes.hpp"
#include "renders/plots.hpp"

namespace drycut::renders {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
  std::vector<std::string> texts;
  for (const auto& tick : ticks) {
    EXPECT_NEAR(tick.value, std::log10(std::stod(tick.label)), 1e-9);
    texts.push_back(tick.label);
  }
  return texts;
}

TEST(Decades, AreMarkedAtOneTwoFive) {
  EXPECT_THAT(labels(decade_ticks(-0.31, std::log10(125))),
              ElementsAre("0.5", "1", "2", "5", "10", "20", "50", "100"));
}

TEST(Decades, ManyAreMarkedAtTheirPowersAlone) {
  EXPECT_THAT(labels(decade_ticks(-3, 4)),
              ElementsAre("0.001", "0.01", "0.1", "1", "10", "100", "1000", "10000"));
}

TEST(Decades, RefuseWhatHasNoLogarithm) {
  Plot plot;
  plot.name = "bode";
  plot.log_x = true;
  plot.panels = {{"gain", "[dB]", {{"open loop", {0, 1}, {1, 2}}}, {}, {}}};
  try {
    draw_plots({plot}, ".");
    FAIL() << "it was drawn";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("curve 'open loop' has x that a logarithmic axis cannot show"));
  }
}

}  // namespace
}  // namespace drycut::renders
