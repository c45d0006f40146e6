// The pages of drycut sweep and drycut envelope: a map over two axes, curves over one, a table of anything.
#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/cli/sweep_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct SweepReport : CommandTest {
  SweepReport() {
    folder.file("it's web.yaml", R"(variables: {limit: 100 m/min, speed: 60 m/min}
scene: {step: 1 ms, duration: 0.2 s}
plants: {web: {type: web, speed: "${speed}"}}
record: {every: 10 ms, channels: [web.speed]}
checks:
  - {name: slow enough, always: "web.speed <= ${limit}"}
  - {name: fast enough, always: "web.speed >= 10 m/min"}
)");
    sweep.scenario = folder / "it's web.yaml";
    envelope.scenarios = {sweep.scenario};
    sweep.out = envelope.out = folder / "out";
  }
  std::string page() const {
    std::ifstream stream(folder / "out/report.html", std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// What the page's first map tells.
  nlohmann::json map() const {
    const auto text = page();
    const std::string begin = "id=\"map-data\">";
    const auto from = text.find(begin) + begin.size();
    return nlohmann::json::parse(text.substr(from, text.find("</script>", from) - from)).at(0);
  }

  /// What the browser draws its plots from.
  nlohmann::json plot_data() const {
    const auto text = page();
    const std::string begin = "id=\"plot-data\">";
    const auto from = text.find(begin) + begin.size();
    return nlohmann::json::parse(text.substr(from, text.find("</script>", from) - from));
  }
  nlohmann::json plots() const { return plot_data().at("plots"); }
  /// The y of a curve.
  std::vector<float> y_of(const nlohmann::json& curve) const {
    const auto column = plot_data().at("columns").at(curve.at("y").get<std::size_t>());
    EXPECT_EQ(column.at("type"), "f4");
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : column.at("base64").get<std::string>()) {
      if (c == '=') break;
      bits = bits << 6 | static_cast<unsigned>(digits.find(c));
      count += 6;
      if (count < 8) continue;
      count -= 8;
      bytes.push_back(static_cast<char>(bits >> count & 0xff));
    }
    std::vector<float> numbers(bytes.size() / sizeof(float));
    if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
  }

  TestFolder folder;
  SweepOptions sweep;
  EnvelopeOptions envelope;
};

TEST_F(SweepReport, OverTwoAxesItIsAMap) {
  sweep.over = {"variables.limit=80..120 m/min:3", "variables.speed=125,5,65,95 m/min"};  // in any order
  sweep.set = {"scene.seed=3"};
  ASSERT_EQ(captured([&] { return sweep_scenario(sweep); }), all_passed) << err;
  EXPECT_TRUE(fs::exists(folder / "out/plots/map.png"));
  const auto shown = map();
  EXPECT_EQ(shown["x"], (std::vector{80., 100., 120.}));
  EXPECT_EQ(shown["y"], (std::vector{5., 65., 95., 125.}));
  ASSERT_EQ(shown["cells"].size(), 12);
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      const double limit = shown["x"][column];
      const double speed = shown["y"][row];
      const auto& cells = shown["cells"][row * 3 + column];
      EXPECT_EQ(cells[0], fmt::format("{}", limit));
      EXPECT_EQ(cells[1], fmt::format("{}", speed));
      EXPECT_EQ(cells[2], speed < 10 || speed > limit ? "failed" : "passed");
      EXPECT_EQ(cells[3], speed < 10 ? "fast enough" : speed > limit ? "slow enough" : "");
    }
  // A shell takes it as it stands.
  const auto told = shown["headings"].size();
  EXPECT_EQ(shown["command"],
            "drycut run '" + (folder / "it'\\''s web.yaml").string() +
                fmt::format("' --set 'scene.seed=3' --set 'variables.limit={{{}}} m/min' --set "
                            "'variables.speed={{{}}} m/min'",
                            told, told + 1));
  EXPECT_THAT(page(), HasSubstr("<strong>5 of 12</strong> <span>points passed; 7 failed</span>"));
  EXPECT_THAT(page(), HasSubstr("What lies between the points was not run"));
}

// A third of a range has no end: the page says six digits, the command all of them.
TEST_F(SweepReport, NumbersAreReadableInThePageAndExactInTheCommand) {
  sweep.over = {"variables.limit=80..120 m/min:4", "variables.speed=30..50 m/min:2"};
  ASSERT_EQ(captured([&] { return sweep_scenario(sweep); }), all_passed) << err;
  const auto shown = map();
  const auto told = shown["headings"].size();
  EXPECT_EQ(shown["cells"][1][0], "93.3333");
  EXPECT_EQ(shown["cells"][1][told], "93.3333333333333");
  EXPECT_THAT(page(), HasSubstr("<td class=\"number\">93.3333</td>"));
  EXPECT_THAT(page(), Not(HasSubstr("<td class=\"number\">93.3333333333333</td>")));
}

// checks.1 is called by its name wherever a page speaks of it.
TEST_F(SweepReport, ChecksGoByTheirNames) {
  sweep.over = {"checks.1.from=10..50 ms:2"};
  sweep.set = {"checks.0.until=150 ms"};
  ASSERT_EQ(captured([&] { return sweep_scenario(sweep); }), all_passed) << err;
  EXPECT_THAT(page(), HasSubstr("<dd>checks[slow enough].until = 150 ms</dd>"));
  EXPECT_THAT(page(), HasSubstr("<dd>checks[fast enough].from [ms]</dd>"));
  envelope.over = {"variables.speed=30..50 m/min:2"};
  envelope.find_max = {"checks.1.from=10..50 ms:10"};
  fs::remove_all(folder / "out");
  ASSERT_EQ(captured([&] { return envelope_scenario(envelope); }), all_passed) << err;
  EXPECT_THAT(page(), HasSubstr("Largest checks[fast enough].from [ms]"));
  EXPECT_THAT(out,
              HasSubstr("Largest checks[fast enough].from: 50 ms over 2 points; holds throughout to 50 ms"));
}

TEST_F(SweepReport, OverOneAxisItIsCurves) {
  sweep.over = {"variables.speed=5..125 m/min:7"};
  sweep.figures = {"peak=max(web.speed)"};
  ASSERT_EQ(captured([&] { return sweep_scenario(sweep); }), all_passed) << err;
  EXPECT_TRUE(fs::exists(folder / "out/plots/curves.png"));
  EXPECT_FALSE(fs::exists(folder / "out/plots/map.png"));
  const auto text = page();
  EXPECT_THAT(text, Not(HasSubstr("id=\"map-data\"")));
  EXPECT_THAT(text, HasSubstr("peak"));
  EXPECT_THAT(
      text, HasSubstr("<strong>4 of 7</strong> <span>points passed: 25 to 85 m/min; then at 105 m/min: slow "
                      "enough; 3 failed</span>"));
  // A dot a run and no ground painted between; the bound lies between two marks, the axis ends at what was
  // asked.
  const auto plot = plots()[0];
  EXPECT_THAT(plot["zones"], testing::IsEmpty());
  ASSERT_EQ(plot["marks"].size(), 2U);
  EXPECT_EQ(plot["marks"][0]["x"], 85);
  EXPECT_EQ(plot["marks"][0]["label"], "passes at 85");
  EXPECT_EQ(plot["marks"][1]["x"], 105);
  EXPECT_EQ(plot["marks"][1]["label"], "fails at 105");
  EXPECT_EQ(plot["panels"].back()["title"], "peak");
  const auto& curves = plot["panels"].back()["curves"];
  ASSERT_EQ(curves.size(), 3U);
  EXPECT_EQ(curves[1]["label"], "fails");
  EXPECT_EQ(curves[2]["label"], "passes");
  for (const auto& dots : {curves[1], curves[2]}) EXPECT_EQ(dots["style"], "points");
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(y_of(curves[1]), testing::Pointwise(testing::NanSensitiveFloatEq(),
                                                  std::vector<float>{5, none, none, none, none, 105, 125}));
  EXPECT_THAT(y_of(curves[2]), testing::Pointwise(testing::NanSensitiveFloatEq(),
                                                  std::vector<float>{none, 25, 45, 65, 85, none, none}));
}

// What a sweep shows of a bound is what an envelope of the same line finds.
TEST_F(SweepReport, ASweepDoesNotContradictTheEnvelope) {
  sweep.figures = {"peak=max(web.speed)"};
  for (const double limit : {45.0, 66.6, 110.0}) {
    sweep.set = envelope.set = {fmt::format("variables.limit={} m/min", limit)};
    sweep.over = {"variables.speed=20..140 m/min:7"};
    fs::remove_all(folder / "out");
    ASSERT_EQ(captured([&] { return sweep_scenario(sweep); }), all_passed) << err;
    const auto marks = plots()[0]["marks"];
    envelope.find_max = {"variables.speed=20..140 m/min:0.5"};
    envelope.out = folder / "bound";
    ASSERT_EQ(captured([&] { return envelope_scenario(envelope); }), all_passed) << err;
    double bound = 0;
    ASSERT_EQ(std::sscanf(out.c_str(), "Largest variables.speed: %lf m/min", &bound), 1) << out;
    ASSERT_EQ(marks.size(), 2U);
    EXPECT_LE(marks[0]["x"].get<double>(), bound);
    EXPECT_GT(marks[1]["x"].get<double>(), bound);
  }
}

// The command that is offered repeats what a reader asks about: the first point that failed.
TEST_F(SweepReport, OffersTheFirstPointThatFailed) {
  sweep.over = {"variables.speed=1e6,45,105,125 m/min"};
  ASSERT_EQ(captured([&] { return sweep_scenario(sweep); }), all_passed) << err;
  EXPECT_THAT(page(), HasSubstr("The first point that failed, once more with pictures"));
  EXPECT_THAT(page(), HasSubstr("variables.speed=105 m/min&#39;</pre>"));
  // What was refused is no verdict: not among the dots, and counted for itself.
  EXPECT_THAT(page(),
              HasSubstr("<strong>1 of 4</strong> <span>points passed: 45 m/min; then at 105 m/min: slow "
                        "enough; 2 failed, 1 refused (input wrong, not simulated)</span>"));
  sweep.over = {"variables.speed=45,65 m/min"};
  ASSERT_EQ(captured([&] { return sweep_scenario(sweep); }), all_passed) << err;
  EXPECT_THAT(page(), HasSubstr("The first point, once more with pictures"));
}

// Numbers are noisy in their last digits: an axis does not make a mountain of 2e-8 mm.
TEST_F(SweepReport, NoAxisIsMadeOfNoise) {
  sweep.over = {"variables.speed=25..85 m/min:4"};
  sweep.figures = {"dust=max(abs(web.speed*1e-12))"};
  ASSERT_EQ(captured([&] { return sweep_scenario(sweep); }), all_passed) << err;
  EXPECT_EQ(plots()[0]["panels"].back()["least"][1], 1e-4);
}

TEST_F(SweepReport, OfWordsSamplesAndThreeAxesItIsATable) {
  for (const bool sampled : {false, true}) {
    sweep.over = {"variables.speed=50..125 m/min", "variables.limit=80..120 m/min"};
    sweep.sample = "sobol:8";
    if (!sampled) {
      sweep.sample.clear();
      sweep.over = {"variables.speed=50,125 m/min", "variables.limit=80,120 m/min",
                    "plants.web.thickness=1,2 mm"};
    }
    ASSERT_EQ(captured([&] { return sweep_scenario(sweep); }), all_passed) << err;
    EXPECT_FALSE(fs::exists(folder / "out/plots/map.png"));
    EXPECT_FALSE(fs::exists(folder / "out/plots/curves.png"));
    EXPECT_THAT(page(), HasSubstr("8 rows"));
  }
}

TEST_F(SweepReport, AnEnvelopeShowsItsBoundAndWhatGivesWay) {
  envelope.over = {"variables.limit=40..120 m/min:5"};
  envelope.find_max = {"variables.speed=20..300 m/min:0.5"};
  ASSERT_EQ(captured([&] { return envelope_scenario(envelope); }), all_passed) << err;
  EXPECT_TRUE(fs::exists(folder / "out/plots/envelope.png"));
  EXPECT_THAT(page(), HasSubstr("slow enough"));
  // What was looked at, and the command of the first bound.
  const auto bounds = plots()[0]["panels"][0];
  EXPECT_EQ(bounds["curves"][1]["label"], "fails");
  EXPECT_EQ(bounds["curves"][2]["label"], "holds");
  EXPECT_EQ(bounds["least"][0], 20) << "the axis is not longer than the range that was asked";
  EXPECT_LE(bounds["least"][1], 300);
  EXPECT_THAT(page(),
              testing::ContainsRegex("<strong>FOUND</strong> <span>Largest variables.speed: 39[.][0-9] to "
                                     "119[.][0-9] m/min over 5 points"));
  EXPECT_THAT(page(), HasSubstr("variables.limit=40 m/min"));
  EXPECT_THAT(page(), testing::ContainsRegex("variables.speed=(39[.][5-9][0-9]*|40) m/min"));
  envelope.over.emplace_back("plants.web.thickness=1,2 mm");
  ASSERT_EQ(captured([&] { return envelope_scenario(envelope); }), all_passed) << err;
  EXPECT_FALSE(fs::exists(folder / "out/plots/envelope.png"));
  const auto shown = map();
  ASSERT_EQ(shown["cells"].size(), 10);
  for (const auto& cells : shown["cells"]) {
    EXPECT_NEAR(std::stod(cells[2].get<std::string>()), std::stod(cells[0].get<std::string>()), 0.5);
    EXPECT_EQ(cells[4], "slow enough");
  }
  // The command repeats the bound, not only its point, to the last digit: behind what is told.
  const auto told = shown["headings"].size();
  EXPECT_THAT(shown["command"].get<std::string>(),
              HasSubstr(fmt::format("--set 'variables.speed={{{}}} m/min'", told + 2)));
  for (const auto& cells : shown["cells"]) {
    ASSERT_EQ(cells.size(), told + 3);
    const auto bound = cells[told + 2].get<std::string>();
    EXPECT_LE(std::stod(bound), std::stod(cells[0].get<std::string>()));
    EXPECT_LE(cells[2].get<std::string>().size(), 5U) << "in digits that the tolerance warrants";
    EXPECT_LE(std::stod(cells[2].get<std::string>()), std::stod(bound))
        << "never above what was found to hold";
  }
}

// Green is where nothing gives way, in a map of an envelope as in one of a sweep.
TEST_F(SweepReport, AnEnvelopeSaysWhereItHoldsNowhereAndToTheEnd) {
  envelope.over = {"variables.limit=5,40,400 m/min"};
  envelope.find_max = {"variables.speed=4..300 m/min:0.5"};
  ASSERT_EQ(captured([&] { return envelope_scenario(envelope); }), all_passed) << err;
  const auto text = page();
  for (const auto* region : {"holds nowhere", "slow enough", "nothing, to the end of the range"})
    EXPECT_THAT(text, HasSubstr(fmt::format("<td class=\"number\">1</td><td>{}</td>", region)));
  EXPECT_THAT(text, HasSubstr("fails above it: slow enough"));
  EXPECT_EQ(plots()[0]["panels"][0]["least"][1], 300) << "the end of the range";
  // It begins at 10 m/min: what lies below fails, and the table says so.
  EXPECT_THAT(text, HasSubstr("holds from "));
}

TEST_F(SweepReport, EnvelopesOfSeveralScenesLieOverEachOther) {
  folder.file("saw.yaml", "extends: it's web.yaml\nchecks: {slow enough: {always: web.speed <= 50}}\n");
  envelope.scenarios.push_back(folder / "saw.yaml");
  envelope.over = {"variables.limit=40..120 m/min:5"};
  envelope.find_max = {"variables.speed=20..300 m/min:0.5"};
  ASSERT_EQ(captured([&] { return envelope_scenario(envelope); }), all_passed) << err;
  EXPECT_TRUE(fs::exists(folder / "out/plots/envelope.png"));
  const auto panels = plots()[0]["panels"];
  ASSERT_EQ(panels.size(), 3U);  // over each other, then each alone
  ASSERT_EQ(panels[0]["curves"].size(), 2U);
  EXPECT_EQ(panels[0]["curves"][0]["label"], "it's web");
  EXPECT_EQ(panels[0]["curves"][1]["label"], "saw");
  EXPECT_EQ(panels[1]["title"], "it's web");
  EXPECT_EQ(panels[2]["title"], "saw");
  // With other axes each has a plot of its own.
  envelope.over = {"it:variables.limit=40..120 m/min:5", "saw:plants.web.thickness=1..2 mm:3"};
  ASSERT_EQ(captured([&] { return envelope_scenario(envelope); }), all_passed) << err;
  EXPECT_FALSE(fs::exists(folder / "out/plots/envelope.png"));
  EXPECT_TRUE(fs::exists(folder / "out/plots/envelope_1.png"));
  EXPECT_TRUE(fs::exists(folder / "out/plots/envelope_2.png"));
}

// What is refused is no dot of a verdict, neither among those that hold nor among those that fail.
TEST_F(SweepReport, RefusedValuesOfAnEnvelopeAreNoDots) {
  envelope.over = {"variables.limit=2000,3000 m/min"};
  envelope.find_max = {"plants.web.speed=200..2000 m/min:50"};
  ASSERT_EQ(captured([&] { return envelope_scenario(envelope); }), all_passed) << err;
  std::size_t dots = 0;
  const auto curves = plots()[0]["panels"][0]["curves"];
  for (const auto& curve : curves) {
    for (const float y : y_of(curve)) EXPECT_LE(y, 1000) << curve["label"];
    dots += y_of(curve).size();
  }
  EXPECT_GT(dots, 10U);
}

TEST_F(SweepReport, TheSmallestIsHeadedSo) {
  envelope.over = {"variables.limit=80,120 m/min"};
  envelope.find_min = {"variables.speed=5..75 m/min:0.5"};
  ASSERT_EQ(captured([&] { return envelope_scenario(envelope); }), all_passed) << err;
  const auto text = page();
  for (const auto* words :
       {"<span>Smallest variables.speed: ", "Smallest variables.speed over variables.limit",
        "fails below it: fast enough", "(± 0.5 m/min, rounded up); below it fails: fast enough"})
    EXPECT_THAT(text, HasSubstr(words));
  EXPECT_THAT(text, Not(HasSubstr("argest")));
}

}  // namespace
}  // namespace drycut::sim::cli
