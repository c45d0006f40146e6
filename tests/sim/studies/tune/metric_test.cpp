// Metrics of a recording against their definitions.
#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "sim/studies/tune/metric.hpp"
#include "sim/studies/tune/parameter.hpp"
#include "tests/loop/fakes.hpp"

namespace drycut::sim::studies {
namespace {

using testing::HasSubstr;

const std::vector<loop::KnownEvent> events = {{"knife", "cut", {{"length", "mm"}, {"force", "N"}}}};

/// follerr = 5 - t in steps of 1 s, 0 to 5; cuts of 100, 102, 104 mm at 1, 3, 5 s.
struct TuneMetric : testing::Test {
  TuneMetric() : names({}, &controller, panel), watch(names) {
    controller.values["AxisX.follerr"] = 0;
    controller.values["AxisX.posit"] = 0;
    watch.record("AxisX.follerr", recording);
    watch.record("AxisX.posit", recording);
    for (int t = 0; t <= 5; ++t) {
      controller.values["AxisX.follerr"] = 5 - t;
      controller.values["AxisX.posit"] = -t;
      watch.update();
      recording.sample(t * second);
      if (t % 2 == 1)
        recording.happened(
            {t * second, 0, "knife", "cut", {{"length", 99.0 + t, "mm"}, {"force", 1, "N"}}, ""});
    }
  }
  double number(const std::string& text, Time from = 0) {
    std::vector<scenario::ExpressionFault> faults;
    auto metric = Metric::compile(text, Metric::Kind::number, events, faults);
    for (const auto& fault : faults) ADD_FAILURE() << text << ": " << fault.what;
    return metric ? metric->value(recording, from) : NAN;
  }
  static std::string fault(const std::string& text, Metric::Kind kind = Metric::Kind::number) {
    std::vector<scenario::ExpressionFault> faults;
    EXPECT_FALSE(Metric::compile(text, kind, events, faults).has_value()) << text;
    return faults.empty()
               ? ""
               : std::to_string(faults[0].offset + 1) + ": " + faults[0].what + "; " + faults[0].remedy;
  }

  fakes::FakeController controller;
  loop::OperatorPanel panel;
  loop::Names names;
  loop::Watch watch;
  record::Recording recording;
};

TEST_F(TuneMetric, TermsAreWhatTheirNamesSay) {
  EXPECT_DOUBLE_EQ(number("max(AxisX.follerr)"), 5);
  EXPECT_DOUBLE_EQ(number("min(AxisX.follerr)"), 0);
  EXPECT_DOUBLE_EQ(number("mean(AxisX.follerr)"), 2.5);
  EXPECT_DOUBLE_EQ(number("rms(AxisX.follerr)"), std::sqrt(55.0 / 6));
  EXPECT_DOUBLE_EQ(number("sd(AxisX.follerr)"), std::sqrt(3.5));
  EXPECT_DOUBLE_EQ(number("count(AxisX.follerr)"), 6);
  EXPECT_DOUBLE_EQ(number("max(abs(AxisX.posit) + AxisX.follerr)"), 5);
  EXPECT_DOUBLE_EQ(number("mean(AxisX.follerr)", 4 * second), 0.5);
}

TEST_F(TuneMetric, SettlesAfterTheLastInstantOutsideTheBand) {
  EXPECT_DOUBLE_EQ(number("settling(AxisX.follerr, 2)"), 3);
  EXPECT_DOUBLE_EQ(number("settling(AxisX.follerr, 2)", 1 * second), 2);
  EXPECT_DOUBLE_EQ(number("settling(AxisX.follerr, 5)"), 0);
  EXPECT_DOUBLE_EQ(number("settling(AxisX.follerr - 5, 1)"), 5);  // never: the whole window
}

TEST_F(TuneMetric, EventsAreLookedAtOnceEach) {
  EXPECT_DOUBLE_EQ(number("mean(cut.length)"), 102);
  EXPECT_DOUBLE_EQ(number("sd(knife.cut.length)"), 2);
  EXPECT_DOUBLE_EQ(number("count(cut.length)", 2 * second), 2);
  EXPECT_TRUE(std::isnan(number("sd(cut.length)", 4 * second)));  // one cut has no spread
}

TEST_F(TuneMetric, FormulasOverTermsAndPlainMax) {
  EXPECT_DOUBLE_EQ(number("2 * max(AxisX.follerr) - mean(cut.length) / 51"), 8);
  EXPECT_DOUBLE_EQ(number("max(min(AxisX.follerr), 1, max(AxisX.posit))"), 1);
}

TEST_F(TuneMetric, AConstraintHasItsRoom) {
  std::vector<scenario::ExpressionFault> faults;
  auto limit = Metric::compile("max(AxisX.follerr) <= 3 && mean(cut.length) > 100", Metric::Kind::limit,
                               events, faults);
  ASSERT_TRUE(limit.has_value());
  EXPECT_DOUBLE_EQ(limit->value(recording, 0), -2);
  EXPECT_DOUBLE_EQ(limit->value(recording, 3 * second), 1);
}

TEST_F(TuneMetric, AConstraintMayLimitTheLoop) {
  std::vector<scenario::ExpressionFault> faults;
  auto limit = Metric::compile("phase_margin - 5 >= 40 && max(AxisX.follerr) <= 9", Metric::Kind::limit,
                               events, faults);
  ASSERT_TRUE(limit.has_value());
  EXPECT_TRUE(limit->needs_loop());
  EXPECT_DOUBLE_EQ(limit->value(recording, 0, {46, 6, 2}), 1);
  EXPECT_DOUBLE_EQ(limit->value(recording, 0, {80, 6, 2}), 4);
  EXPECT_TRUE(std::isnan(limit->value(recording, 0)));
  auto gain =
      Metric::compile("gain_margin >= 6 && max_sensitivity <= 2", Metric::Kind::limit, events, faults);
  ASSERT_TRUE(gain.has_value());
  EXPECT_DOUBLE_EQ(gain->value(recording, 0, {46, 8, 2.5}), -0.5);
  auto plain = Metric::compile("max(AxisX.follerr) <= 9", Metric::Kind::limit, events, faults);
  ASSERT_TRUE(plain.has_value());
  EXPECT_FALSE(plain->needs_loop());
  EXPECT_THAT(fault("rms(AxisX.follerr) + gain_margin"),
              HasSubstr("22: gain_margin is measured for constraints only; put a limit into --constraint"));
}

TEST_F(TuneMetric, FaultsStandAtTheirPlace) {
  EXPECT_THAT(fault("AxisX.follerr"), HasSubstr("1: 'AxisX.follerr' stands outside a term; write max("));
  EXPECT_THAT(fault("2 + 3"), HasSubstr("1: nothing recorded is in it"));
  EXPECT_THAT(fault("1 + rms(max(x))"), HasSubstr("9: max inside rms"));
  EXPECT_THAT(fault("rms(2)"), HasSubstr("no channel and no event value"));
  EXPECT_THAT(fault("rms(x) + rmss(rms(y))"), HasSubstr("10: unknown function 'rmss'"));
  EXPECT_THAT(fault("rms(x + foo(y))"), HasSubstr("9: unknown function 'foo'"));
  EXPECT_THAT(fault("rms(x, y)"), HasSubstr("1: rms has 2 arguments; it takes one"));
  EXPECT_THAT(fault("settling(x)"), HasSubstr("settling has 1 arguments; write settling(AxisX.follerr, 10)"));
  EXPECT_THAT(fault("settling(x, -1)"), HasSubstr("12: the band of settling is no number from 0 on"));
  EXPECT_THAT(fault("max(cut.lenght)"),
              HasSubstr("5: the event cut has no value 'lenght'; its values: length, force"));
  EXPECT_THAT(fault("max(cut.length - x)"), HasSubstr("cut.length and x do not happen together"));
  EXPECT_THAT(fault("max(x) < 3"), HasSubstr("8: a metric is a number, not a comparison; put limits into"));
  EXPECT_THAT(fault("max(x)", Metric::Kind::limit), HasSubstr("1: a constraint compares by < <= > >="));
  EXPECT_THAT(fault("max(x"), HasSubstr("4: this ( is not closed"));
}

TEST(TuneParameter, AHypercubeMeetsEveryPartOfEveryRangeOnce) {
  TunedParameters parameters(2);
  parameters[0].high = 10;
  parameters[1].low = -1;
  parameters[1].high = 1;
  const auto points = latin_hypercube(parameters, 10, plants::Random(3, "test"));
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<int> met(10);
    for (const auto& point : points) ++met.at(static_cast<std::size_t>(to_unit(parameters, point)[i] * 10));
    EXPECT_THAT(met, testing::Each(1));
  }
}

}  // namespace
}  // namespace drycut::sim::studies
