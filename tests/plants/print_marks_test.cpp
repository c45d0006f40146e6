#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "plants/rotary_knife.hpp"
#include "tests/plants/web_line.hpp"

namespace drycut::plants {
namespace {

/// A web of 1 m/s with marks of 5 mm each 300 mm, the photocell 900 mm before the cut, without delay.
struct PrintedLine : WebLine {
  static WebData printed() {
    WebData data;
    data.marks.pitch = 0.3;
    data.marks.delay = 0;
    return data;
  }
  explicit PrintedLine(const WebData& data = printed()) : WebLine(data) {}

  /// Travel of the web at each rising edge of the photocell [m].
  std::vector<double> edges(double seconds) {
    const auto& port = plug<SignalPort>("photocell");
    std::vector<double> found;
    for (int i = 0; i < std::lround(seconds / h); ++i) {
      step();
      for (const SignalPort::Edge& edge : port.edges)
        if (edge.rising) found.push_back(web.travel(edge.fraction));
    }
    return found;
  }
};

TEST(PrintMarks, ThePhotocellSeesTheFrontEdgeOfEachMarkWhereItIs) {
  PrintedLine line;
  const auto edges = line.edges(1);
  // The mark of place p comes to the photocell when the web has travelled p - 0.9 m; at the start the third
  // one is under it. Its front edge comes half a mark before its middle.
  ASSERT_EQ(edges.size(), 3U);
  for (std::size_t i = 0; i < edges.size(); ++i)
    EXPECT_NEAR(edges[i], 0.3 * (static_cast<double>(i) + 1) - 0.0025, 1e-9) << i;
}

TEST(PrintMarks, StretchAndOffsetMoveThem) {
  auto data = PrintedLine::printed();
  data.marks.stretch = 0.01;
  data.marks.offset = 0.05;
  PrintedLine line(data);
  const auto edges = line.edges(1);
  ASSERT_EQ(edges.size(), 4U);
  // First place 0.35, the true pitch 0.303: places 0.956, 1.259 ...; those before are under or past the cell.
  for (std::size_t i = 0; i < edges.size(); ++i)
    EXPECT_NEAR(edges[i], 0.35 + 0.303 * (static_cast<double>(i) + 2) - 0.9 - 0.0025, 1e-9) << i;
}

TEST(PrintMarks, ScatterIsThatOfANormalDistributionAndTheSameForASeed) {
  auto data = PrintedLine::printed();
  data.marks.scatter = 0.002;
  PrintedLine line(data);
  const auto edges = line.edges(300);
  PrintedLine again(data);
  EXPECT_EQ(again.edges(300), edges);
  double sum = 0;
  double squares = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double off = edges[i] - 0.3 * std::round((edges[i] + 0.0025) / 0.3) + 0.0025;
    sum += off;
    squares += off * off;
  }
  const double n = static_cast<double>(edges.size());
  EXPECT_NEAR(n, 1000, 2);
  EXPECT_NEAR(sum / n, 0, 3 * 0.002 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.002, 0.0002);
}

TEST(PrintMarks, TheNearestIsToldEvenWhereScatterBringsMarksOutOfOrder) {
  PrintMarkData data;
  data.pitch = 0.02;
  data.scatter = 0.05;
  PrintMarks marks(data, Random(7, "marks"));
  for (int i = 0; i < 4000; ++i) {
    const double travel = i * 1e-3;
    marks.sense(travel, h);
    const auto& places = marks.places();
    ASSERT_TRUE(std::is_sorted(places.begin(), places.end()));
    for (const double place : {travel, travel + 0.41, places.front() - 1, places.back() + 1}) {
      double nearest = 1e9;
      for (const double mark : places) nearest = std::min(nearest, std::abs(place - mark));
      ASSERT_DOUBLE_EQ(std::abs(marks.behind_mark(place)), nearest) << "at " << place;
    }
  }
}

TEST(PrintMarks, ASpliceShiftsTheMarksThatAreStillToCome) {
  PrintedLine line;
  const auto before = line.edges(0.5);
  line.fault("marks", "shift", 0.007);
  const auto after = line.edges(1);
  ASSERT_EQ(before.size(), 1U);
  ASSERT_EQ(after.size(), 3U);
  // The next one is on its way already.
  EXPECT_NEAR(after[0] - before[0], 0.3, 1e-9);
  EXPECT_NEAR(after[1] - after[0], 0.307, 1e-9);
  EXPECT_NEAR(after[2] - after[1], 0.3, 1e-9);
}

TEST(PrintMarks, APhotocellThatIsDeadSeesNothing) {
  PrintedLine line;
  line.fault("photocell", "dead", 1);
  EXPECT_THAT(line.edges(1), testing::IsEmpty());
}

TEST(PrintMarks, RegisterIsTheWayFromTheNearestMarkToTheCut) {
  PrintedLine line;
  line.edges(0.62);
  line.web.separate(1, 0.604);
  EXPECT_NEAR(line.web.register_error(), 0.004, 1e-12);
  line.web.separate(1, 0.895);
  EXPECT_NEAR(line.web.register_error(), -0.005, 1e-12);
}

TEST(PrintMarks, TheCutOfAPrintedWebTellsItsRegisterAndThatOfAPlainOneDoesNot) {
  for (const bool printed : {true, false}) {
    World world;
    Web web(printed ? PrintedLine::printed() : WebData(), world);
    RotaryKnife knife({}, world, web);
    bool told = false;
    for (const auto& type : knife.event_types())
      if (type.name == "cut")
        for (const auto& value : type.values) told = told || value.name == "register";
    EXPECT_EQ(told, printed);
  }
}

TEST(PrintMarks, MarksWithoutAGapAreRefused) {
  WebDefinition definition;
  definition.data = PrintedLine::printed();
  EXPECT_THAT(definition.objections(1e-4), testing::IsEmpty());
  const auto fast = definition.objections(6e-3);
  ASSERT_FALSE(fast.empty());
  EXPECT_EQ(fast.back().parameter, "marks.width");
  EXPECT_EQ(fast.back().what, "at 60 m/min a mark of 5 mm is past the photocell within a step of 6000 us");
  EXPECT_EQ(fast.back().remedy, "scene.step of at most 5000 us");
  definition.data.marks.scatter = 0.05;
  const auto objections = definition.objections(1e-4);
  ASSERT_EQ(objections.size(), 1U);
  EXPECT_EQ(objections[0].what, "marks of 5 mm at 300 mm leave no gap");
  EXPECT_EQ(objections[0].remedy, "more than 305.4 mm (width, twice the hysteresis, six times the scatter)");
}

}  // namespace
}  // namespace drycut::plants
