// drycut design: its sheet, its tables, what it refuses.
#include <fmt/format.h>

#include <cmath>
#include <regex>

#include "sim/cams/study.hpp"
#include "sim/cli/cam_command.hpp"
#include "sim/cli/design_command.hpp"
#include "sim/studies/design/fit.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::studies {
namespace {

using cli::DesignOptions;
using testing::HasSubstr;
using testing::Not;

DesignOptions knife() {
  DesignOptions options;
  options.kind = "rotary_knife";
  options.length = "800 mm";
  options.circumference = "600 mm";
  options.sync = "120 mm";
  options.speed = "60 m/min";
  return options;
}
DesignOptions saw() {
  DesignOptions options;
  options.kind = "flying_saw";
  options.length = "660 mm";
  options.sync = "190 mm";
  options.speed = "40 m/min";
  return options;
}
DesignOptions feed() {
  DesignOptions options;
  options.kind = "feed";
  options.length = "300 mm";
  options.feed = "120 mm";
  options.sync = "100 mm";
  options.speed = "30 m/min";
  return options;
}

struct DesignCommand : CommandTest {
  int run(const DesignOptions& options) {
    return captured([&] { return cli::design_cam(options); });
  }
  /// The numbers of the sheet's line that begins so: factor, rms a, peak a, peak j, peak v.
  std::vector<double> line(const std::string& name) const {
    std::vector<double> numbers;
    std::istringstream lines(out);
    for (std::string text; std::getline(lines, text);) {
      const auto place = text.find(name);
      if (place == std::string::npos || place > 2) continue;
      std::istringstream cells(text.substr(place + name.size()));
      for (std::string cell; cells >> cell;) numbers.push_back(cell == "-" ? 0 : std::stod(cell));
      break;
    }
    return numbers;
  }
  TestFolder folder;
};

TEST_F(DesignCommand, FactorsOfTheClosedForms) {
  auto options = knife();
  ASSERT_EQ(run(options), cli::all_passed) << err;
  EXPECT_NEAR(line("designed").at(0), 12, 0.012);
  EXPECT_NEAR(line("quintic").at(0), 120.0 / 7, 1e-3);
  EXPECT_NEAR(line("cycloid").at(0), 2 * M_PI * M_PI, 1e-3);
  options.minimise = "peak";
  ASSERT_EQ(run(options), cli::all_passed) << err;
  EXPECT_NEAR(line("designed").at(0), 16, 0.016);
}

// A published knife: 3 in of diameter, 20 in/s, 4.71239 in a piece; cut over 10 degrees of the drum. What is
// left of a piece takes 222.529 ms, and the tip comes to 62.35 in/s: so it is the cam of least peak
// acceleration.
TEST_F(DesignCommand, PublishedKnife) {
  auto options = knife();
  options.length = "4.71239 in";
  options.circumference = "9.42478 in";
  options.sync = "0.261799 in";
  options.speed = "20 in/s";
  options.minimise = "peak";
  ASSERT_EQ(run(options), cli::all_passed) << err;
  EXPECT_THAT(out, HasSubstr("(222.529"));
  EXPECT_NEAR(line("designed").at(4) / 0.0254, 62.35, 0.01);
}

TEST_F(DesignCommand, SheetWithoutSpeedIsOfTheMaster) {
  auto options = knife();
  options.speed.clear();
  ASSERT_EQ(run(options), cli::all_passed) << err;
  EXPECT_THAT(out, HasSubstr("1/m"));
  EXPECT_THAT(out, Not(HasSubstr("m/s")));
  // 6 d / T^2.
  EXPECT_NEAR(line("designed").at(2), 6 * 0.2 / (0.68 * 0.68), 0.001);
}

TEST_F(DesignCommand, SeveralBladesCutSeveralPiecesATurn) {
  auto options = knife();
  options.circumference = "1200 mm";
  options.blades = 2;
  options.device = "mc_camin";
  options.table = folder / "cam.csv";
  ASSERT_EQ(run(options), cli::all_passed) << err;
  EXPECT_THAT(out, HasSubstr("600 mm from blade to blade"));
  EXPECT_NEAR(line("designed").at(0), 12, 0.012);
  const auto text = content(folder / "cam.csv");
  EXPECT_THAT(text, HasSubstr("# master_modulo: 16000000"));
  EXPECT_THAT(text, HasSubstr("# slave_modulo: 3600000"));
}

TEST_F(DesignCommand, PiecesAsLongAsTheTurnNeedNoMove) {
  for (const auto* device : {"camming4", "lx3vp", "mc_camin"}) {
    auto options = knife();
    options.length = "600 mm";
    options.device = device;
    EXPECT_EQ(run(options), cli::all_passed) << device << err;
    EXPECT_THAT(out, HasSubstr("nothing to optimise: pieces of 600 mm")) << device;
    EXPECT_THAT(out, Not(HasSubstr("the least"))) << device;
    EXPECT_NEAR(line("designed").at(2), 0, 1e-9) << device;
    EXPECT_NEAR(line("as " + std::string(device) + " plays it").at(4), 1, 1e-6) << device;
  }
}

// In material the blade is as far along the web as the web is: s = r asin(x / r) around the cut.
TEST_F(DesignCommand, ABladeThatSwingsThroughMaterialKeepsTheWebsSpeed) {
  DesignJob job;
  job.length = 0.8;
  job.slave = 0.6;
  job.thickness = 0.008;
  const double radius = 0.6 / (2 * M_PI);
  EXPECT_NEAR(job.contact(), 2 * std::sqrt(radius * radius - std::pow(radius - 0.008, 2)), 1e-12);
  job.sync = 0.08;
  ASSERT_TRUE(hindrances(job).empty());
  const auto cam = design_cam(job);
  ASSERT_TRUE(cam);
  for (double along = -0.04; along <= 0.04; along += 0.001) {
    const auto motion = cam->at(0.04 + along + 1e-12);
    const double angle = (motion.position - job.sync_slave() / 2) / radius;
    EXPECT_NEAR(radius * std::sin(angle), along, 1e-8) << along;
    EXPECT_NEAR(motion.velocity * std::cos(angle), 1, 1e-6) << along;
  }
  // All of it is still a turn a piece, and nothing jumps where the move begins and ends.
  EXPECT_NEAR(cam->at(0.8 - 1e-9).position, 0.6, 1e-8);
  for (const double end : {0.08, 0.8})
    EXPECT_NEAR(cam->at(end - 1e-9).velocity, cam->at(end + 1e-9).velocity, 1e-6);
}

// What the job may travel is what the table says, and the judge of tables finds that it does.
TEST_F(DesignCommand, TablesKeepTheTravelThatTheySay) {
  for (const auto* device : {"camming4", "lx3vp", "mc_camin"})
    for (const auto* goal : {"rms", "peak"})
      for (const auto* travel : {"355 mm", "370 mm", "450 mm", "480 mm"})
        for (const auto* sync : {"250 mm", "270 mm"}) {
          SCOPED_TRACE(fmt::format("{} {} {} {}", device, goal, travel, sync));
          auto options = saw();
          options.length = "1 m";
          options.speed = "34 m/min";
          options.sync = sync;
          options.minimise = goal;
          options.max_travel = travel;
          options.device = device;
          EXPECT_EQ(run(options), cli::all_passed) << out << err;
        }
}

// The kernel's own kind of file: the same cam, to the last digit.
TEST_F(DesignCommand, ATabFileHasTheSameCam) {
  auto options = knife();
  options.device = "mc_camin";
  const auto samples = [&](const char* table) {
    options.table = folder / table;
    EXPECT_EQ(run(options), cli::all_passed) << err;
    cli::CamOptions cam;
    cam.table = options.table;
    cam.csv = "-";
    EXPECT_EQ(captured([&] { return cli::validate_cam(cam); }), cli::all_passed) << err;
    return out;
  };
  const auto tab = samples("cam.tab");
  EXPECT_THAT(content(folder / "cam.tab"), testing::AllOf(HasSubstr("\nFunctiontype = 3 # POLYNOM_3_KOEFF\n"),
                                                          HasSubstr("\nTable-ID     = 1\n")));
  EXPECT_EQ(tab, samples("cam.csv"));
}

TEST_F(DesignCommand, EnergyNeedsLessForceThanRmsWhereFrictionIsLarge) {
  auto options = knife();
  options.length = "3000 mm";
  options.no_reverse = true;
  options.minimise = "energy";
  options.inertia = "20 kg";
  options.viscous = "60 N s/m";
  ASSERT_EQ(run(options), cli::all_passed) << err;
  const double straight = line("designed").at(5);
  const double factor = line("designed").at(0);
  // The same as an inertia and friction of the drum.
  const double radius = 0.6 / (2 * M_PI);
  options.inertia = fmt::format("{} kg m2", 20 * radius * radius);
  options.viscous = fmt::format("{} N m s", 60 * radius * radius);
  options.coulomb = "0 N m";
  ASSERT_EQ(run(options), cli::all_passed) << err;
  EXPECT_NEAR(line("designed").at(5), straight, 1e-3 * straight);
  EXPECT_GT(factor, 12.1);
}

/// What an option says must be seen: a figure of the designed cam with it, and that it is another without.
struct Option {
  std::string name;
  DesignOptions with;
  DesignOptions without;
  std::string line;
  std::size_t column;  ///< factor, rms a, peak a, peak j, peak v, of a saw travel, of energy rms force
  double least;        ///< of the figure with it
  double most;
  friend void PrintTo(const Option& option, std::ostream* out) { *out << option.name; }
};

std::vector<Option> options_that_show() {
  const auto change = [](DesignOptions options, const std::function<void(DesignOptions&)>& how) {
    how(options);
    return options;
  };
  std::vector<Option> all;
  const auto add = [&](const char* name, const DesignOptions& base,
                       const std::function<void(DesignOptions&)>& how, std::size_t column, double least,
                       double most, const char* line = "designed") {
    all.push_back({name, change(base, how), base, line, column, least, most});
  };
  // The peak acceleration of the least rms is 6 |L - C| v^2 / (L - sync)^2.
  const auto peak = [](double length, double drum, double sync, double speed) {
    return 6 * std::abs(length - drum) * speed * speed / ((length - sync) * (length - sync));
  };
  const auto near = [&](const char* name, const std::function<void(DesignOptions&)>& how, double value) {
    add(name, knife(), how, 2, 0.999 * value, 1.001 * value);
  };
  near(
      "length", [](auto& o) { o.length = "900 mm"; }, peak(0.9, 0.6, 0.12, 1));
  near(
      "circumference", [](auto& o) { o.circumference = "700 mm"; }, peak(0.8, 0.7, 0.12, 1));
  near(
      "sync", [](auto& o) { o.sync = "200 mm"; }, peak(0.8, 0.6, 0.2, 1));
  near(
      "speed", [](auto& o) { o.speed = "2 m/s"; }, peak(0.8, 0.6, 0.12, 2));
  near(
      "blades", [](auto& o) { o.blades = 2; }, peak(0.8, 0.3, 0.12, 1));
  add(
      "feed", feed(), [](auto& o) { o.feed = "150 mm"; }, 2, 0.999 * 6 * 0.15 * 0.25 / 0.04,
      1.001 * 6 * 0.15 * 0.25 / 0.04);
  // Of the least peak 4 |d| v^2 / T^2, of the least jerk 32 |d| v^3 / T^3.
  add(
      "minimise_peak", knife(), [](auto& o) { o.minimise = "peak"; }, 2, 0.999 * 0.8 / 0.4624,
      1.001 * 0.8 / 0.4624);
  add(
      "minimise_jerk", knife(), [](auto& o) { o.minimise = "jerk"; }, 3, 0.999 * 6.4 / 0.314432,
      1.001 * 6.4 / 0.314432);
  const auto brief = change(knife(), [](auto& o) { o.length = "400 mm"; });
  add(
      "max_velocity", brief, [](auto& o) { o.max_velocity = "1.9 m/s"; }, 4, 1.85, 1.9);
  add(
      "max_acceleration", brief, [](auto& o) { o.max_acceleration = "12 m/s2"; }, 2, 11.5, 12);
  const auto far = change(saw(), [](auto& o) { o.length = "2 m"; });
  add(
      "max_travel", far, [](auto& o) { o.max_travel = "300 mm"; }, 5, 295, 300);
  const auto dwelling = change(knife(), [](auto& o) { o.length = "3 m"; });
  add(
      "no_reverse", dwelling, [](auto& o) { o.no_reverse = true; }, 0, 13, 1000);
  const auto heavy = change(knife(), [](auto& o) {
    o.minimise = "energy";
    o.inertia = "20 kg";
  });
  add(
      "inertia", heavy, [](auto& o) { o.inertia = "40 kg"; }, 5, 30, 60);
  add(
      "viscous", heavy, [](auto& o) { o.viscous = "60 N s/m"; }, 5, 40, 200);
  add(
      "coulomb", heavy, [](auto& o) { o.coulomb = "100 N"; }, 5, 90, 200);
  return all;
}

class DesignOption : public testing::WithParamInterface<Option>, public DesignCommand {};

TEST_P(DesignOption, Shows) {
  const auto& option = GetParam();
  ASSERT_EQ(run(option.with), cli::all_passed) << err;
  const auto with = line(option.line);
  ASSERT_GT(with.size(), option.column) << out;
  EXPECT_GE(with[option.column], option.least) << out;
  EXPECT_LE(with[option.column], option.most) << out;
  ASSERT_EQ(run(option.without), cli::all_passed) << err;
  const double without = line(option.line).at(option.column);
  EXPECT_TRUE(without < option.least || without > option.most) << out;
}

INSTANTIATE_TEST_SUITE_P(Options, DesignOption, testing::ValuesIn(options_that_show()),
                         [](const auto& info) { return info.param.name; });

// Ways of a pulse: the table's ends are the job's ways in them.
TEST_F(DesignCommand, PulsesAreTheTablesUnits) {
  auto options = knife();
  options.device = "lx3vp";
  options.table = folder / "cam.csv";
  options.master_pulse = "500 mm/20000";
  options.slave_pulse = "0.03 mm";
  ASSERT_EQ(run(options), cli::all_passed) << err;
  EXPECT_THAT(content(options.table), HasSubstr("\n32000,20000\n"));
  options.device = "camming4";
  ASSERT_EQ(run(options), cli::all_passed) << err;
  EXPECT_THAT(content(options.table), testing::AllOf(HasSubstr("# measurem: 5000\n# pulsem: 20000\n"),
                                                     HasSubstr("# measure: 3\n# pulse: 10\n")));
}

// S ramps begin and end without acceleration: pi/2 of the least jerk, and more where one must end because the
// slave turns round. The sheet says so, and the table comes near to it.
TEST_F(DesignCommand, SaysWhatTheDeviceCanDoAtBest) {
  for (const bool turns : {false, true}) {
    auto options = turns ? saw() : knife();
    options.minimise = "jerk";
    ASSERT_EQ(run(options), cli::all_passed) << err;
    EXPECT_THAT(out, Not(HasSubstr("no table of the device")));
    options.device = "camming4";
    ASSERT_EQ(run(options), cli::all_passed) << err;
    std::smatch part;
    ASSERT_TRUE(std::regex_search(
        out, part,
        std::regex("the fit costs ([0-9.]+) % of it\n.*no table of the device costs less than ([0-9.]+) %")))
        << out;
    const double cost = std::stod(part[1]);
    const double least = std::stod(part[2]);
    if (!turns) {
      EXPECT_NEAR(least, 100 * (M_PI / 2 - 1), 0.2);
    }
    EXPECT_GT(least, turns ? 200 : 50);
    EXPECT_GE(cost, least - 0.1);
    EXPECT_LE(cost, least + 5);
    EXPECT_THAT(out, HasSubstr(turns ? "where the slave turns round" : "pi/2 of the jerk"));
  }
}

/// A job for a device and the most that its fit may cost, in per cent of what was to be small.
struct Fit {
  std::string name;
  std::string device;
  DesignOptions options;
  double most_loss = 0;
  friend void PrintTo(const Fit& fit, std::ostream* out) { *out << fit.name; }
};

DesignOptions with(DesignOptions options, const std::function<void(DesignOptions&)>& change) {
  change(options);
  return options;
}

std::vector<Fit> fits() {
  std::vector<Fit> all;
  for (const auto* device : {"camming4", "lx3vp", "mc_camin"}) {
    const std::string name = device;
    const bool lattice = name == "camming4";
    const auto add = [&](const char* what, DesignOptions options, double loss) {
      options.device = name;
      all.push_back({name + "_" + what, name, std::move(options), loss});
    };
    add("knife", knife(), 1);
    add("knife_peak", with(knife(), [](auto& o) { o.minimise = "peak"; }), 5);
    add("knife_jerk", with(knife(), [](auto& o) { o.minimise = "jerk"; }), lattice ? 58 : 1);
    add("knife_short", with(knife(), [](auto& o) { o.length = "400 mm"; }), 1);
    add("knife_limits",
        with(knife(),
             [](auto& o) {
               o.length = "400 mm";
               o.max_velocity = "2.1 m/s";
               o.max_acceleration = "20 m/s2";
             }),
        4);
    add("knife_dwell",
        with(knife(),
             [](auto& o) {
               o.length = "3 m";
               o.no_reverse = true;
             }),
        1);
    add("knife_dwell_peak",
        with(knife(),
             [](auto& o) {
               o.length = "3 m";
               o.no_reverse = true;
               o.minimise = "peak";
             }),
        8);
    add("knife_no_sync", with(knife(), [](auto& o) { o.sync = "0 mm"; }), 1);
    add("saw", saw(), 1);
    add("saw_travel",
        with(saw(),
             [](auto& o) {
               o.length = "2 m";
               o.max_travel = "300 mm";
             }),
        15);
    add("saw_peak", with(saw(), [](auto& o) { o.minimise = "peak"; }), 30);
    add("feed", feed(), 1);
    add("feed_short", with(feed(), [](auto& o) { o.minimise = "peak"; }), 8);
    add("energy",
        with(knife(),
             [](auto& o) {
               o.minimise = "energy";
               o.inertia = "20 kg";
               o.viscous = "50 N s/m";
               o.coulomb = "30 N";
             }),
        1);
  }
  return all;
}

class DesignFit : public testing::WithParamInterface<Fit>, public DesignCommand {};

TEST_P(DesignFit, IsSoundAndNearTheBest) {
  auto options = GetParam().options;
  options.table = folder / "cam.csv";
  ASSERT_EQ(run(options), cli::all_passed) << err;
  std::smatch loss;
  if (std::regex_search(out, loss, std::regex("the fit costs (-?[0-9.]+) %"))) {
    EXPECT_LE(std::stod(loss[1]), GetParam().most_loss) << out;
    // Averages from the middle of straight pieces to the next are a little less than what they are of.
    EXPECT_GE(std::stod(loss[1]), GetParam().device == "lx3vp" ? -1.5 : -0.2) << out;
  } else {
    EXPECT_THAT(out, HasSubstr("no jerk to compare"));
  }
  // The table as a file of its own.
  cli::CamOptions cam;
  cam.table = options.table;
  cam.strict = true;
  EXPECT_EQ(captured([&] { return cli::validate_cam(cam); }), cli::all_passed) << out << err;
}

INSTANTIATE_TEST_SUITE_P(Devices, DesignFit, testing::ValuesIn(fits()),
                         [](const auto& info) { return info.param.name; });

// Whole Um round off more of a short feed than of a long piece.
TEST_F(DesignCommand, FinerUmCostLess) {
  auto options = feed();
  options.device = "camming4";
  ASSERT_EQ(run(options), cli::all_passed) << err;
  const double coarse = line("as camming4 plays it").at(0);
  options.decpt = 3;
  ASSERT_EQ(run(options), cli::all_passed) << err;
  EXPECT_THAT(out, HasSubstr("1 Um = 0.001 mm"));
  EXPECT_LT(line("as camming4 plays it").at(0), coarse - 0.02);
}

TEST_F(DesignCommand, SameInputSameBytes) {
  auto options = saw();
  options.device = "camming4";
  std::string first;
  for (const auto* name : {"a.csv", "b.csv"}) {
    options.table = folder / name;
    ASSERT_EQ(run(options), cli::all_passed) << err;
    if (first.empty()) first = content(options.table);
    EXPECT_EQ(content(options.table), first);
  }
}

TEST_F(DesignCommand, PictureGoesIntoItsFolder) {
  auto options = knife();
  options.out = folder / "out";
  ASSERT_EQ(run(options), cli::all_passed) << err;
  EXPECT_THAT(content(options.out / "design.png"), HasSubstr("PNG"));
  EXPECT_THAT(out, HasSubstr("design.png"));
}

/// What is refused: the options, what is told, and where there is one the number that would be right.
struct Refused {
  std::string name;
  DesignOptions options;
  std::vector<std::string> told;
  friend void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.name; }
};

class DesignRefusal : public testing::WithParamInterface<Refused>, public DesignCommand {};

TEST_P(DesignRefusal, IsToldWithWhatWouldBeRight) {
  auto options = GetParam().options;
  if (options.table.empty() && !options.device.empty()) options.table = folder / "cam.csv";
  EXPECT_EQ(run(options), cli::bad_input) << out;
  for (const auto& told : GetParam().told) EXPECT_THAT(err, HasSubstr(told));
  EXPECT_EQ(out, "");
  EXPECT_FALSE(std::filesystem::exists(folder / "cam.csv"));
}

std::vector<Refused> refusals() {
  const auto change = [](DesignOptions options, const std::function<void(DesignOptions&)>& how) {
    how(options);
    return options;
  };
  return {
      {"kind", change(knife(), [](auto& o) { o.kind = "rotary_knive"; }), {"did you mean rotary_knife?"}},
      {"goal",
       change(knife(), [](auto& o) { o.minimise = "peek"; }),
       {"--minimise:1:1", "did you mean peak?"}},
      {"device",
       change(knife(), [](auto& o) { o.device = "lx3pv"; }),
       {"--device:1:1", "did you mean lx3vp?"}},
      {"unit", change(knife(), [](auto& o) { o.length = "800 kg"; }), {"--length", "a length", "a mass"}},
      {"no_unit", change(knife(), [](auto& o) { o.sync = "120"; }), {"--sync", "has no unit"}},
      {"not_given",
       change(knife(), [](auto& o) { o.length = o.circumference = o.sync = ""; }),
       {"--length:1:1: it is not given", "--circumference:1:1: it is not given",
        "--sync:1:1: it is not given"}},
      {"negative",
       change(knife(), [](auto& o) { o.length = "-1 mm"; }),
       {"--length:1:1: -1 mm is out of range"}},
      {"sync_too_long",
       change(knife(), [](auto& o) { o.sync = "900 mm"; }),
       {"--sync:1:1", "give less than 800 mm", "give less than 600 mm"}},
      {"slow",
       change(knife(), [](auto& o) { o.max_velocity = "0.9 m/s"; }),
       {"--max-velocity:1:1", "1.005 m/s"}},
      // 1 + 0.2/0.28 m/s with any acceleration.
      {"too_slow_for_a_short_piece",
       change(knife(),
              [](auto& o) {
                o.length = "400 mm";
                o.max_velocity = "1.6 m/s";
              }),
       {"--max-velocity:1:1: 1.6 m/s is too little", "give 1.7", "run the master at 0.9"}},
      // 4 * 0.2 m / (0.28 s)^2 = 10.2 m/s2.
      {"too_weak",
       change(knife(),
              [](auto& o) {
                o.length = "400 mm";
                o.max_acceleration = "10 m/s2";
              }),
       {"--max-acceleration:1:1: 10 m/s2 is too little", "give 10.26 m/s2", "run the master at 0.98"}},
      {"travel",
       change(saw(), [](auto& o) { o.max_travel = "150 mm"; }),
       {"--max-travel:1:1", "give 191 mm at least"}},
      {"limits_without_speed",
       change(knife(),
              [](auto& o) {
                o.speed = "";
                o.max_velocity = "2 m/s";
              }),
       {"--max-velocity:1:1", "give --speed too"}},
      {"energy_of_nothing", change(knife(), [](auto& o) { o.minimise = "energy"; }), {"--inertia:1:1"}},
      {"loads_for_nothing",
       change(knife(), [](auto& o) { o.coulomb = "3 N"; }),
       {"--coulomb:1:1", "leave it out"}},
      {"others_options",
       change(saw(),
              [](auto& o) {
                o.circumference = "600 mm";
                o.feed = "1 mm";
                o.no_reverse = true;
              }),
       {"--circumference:1:1", "--feed:1:1", "--no-reverse:1:1"}},
      {"travel_of_a_knife", change(knife(), [](auto& o) { o.max_travel = "1 m"; }), {"--max-travel:1:1"}},
      {"table_of_nobody", change(knife(), [](auto& o) { o.table = "x.csv"; }), {"--table:1:1: whose table?"}},
      {"table_of_another_kind",
       change(knife(),
              [](auto& o) {
                o.device = "mc_camin";
                o.table = "x.txt";
              }),
       {"--table:1:1: x.txt does not end in .csv or .tab; name it x.csv"}},
      {"tab_of_another_device",
       change(knife(),
              [](auto& o) {
                o.device = "lx3vp";
                o.table = "x.tab";
              }),
       {"--table:1:1: x.tab does not end in .csv; name it x.csv [option.file-name]"}},
      // A feed has no tool: it rests.
      {"feed_without_rest",
       change(knife(),
              [](auto& o) {
                o.kind = "feed";
                o.circumference = o.sync = "";
                o.feed = "120 mm";
              }),
       {"--sync:1:1: it is not given; give the way of the master on which the slave rests"}},
      {"thickness_of_a_saw",
       change(saw(), [](auto& o) { o.thickness = "2 mm"; }),
       {"--thickness:1:1", "leave it out"}},
      // 2 sqrt(8 (2 * 95.493 - 8)) mm of web pass while the blade is in 8 mm of it.
      {"sync_shorter_than_the_swing",
       change(knife(),
              [](auto& o) {
                o.thickness = "8 mm";
                o.sync = "70 mm";
              }),
       {"--sync:1:1: 70 mm is less than the way on which the blade is in 8 mm of material; give 76.6 mm at "
        "least"}},
      {"too_thick",
       change(knife(), [](auto& o) { o.thickness = "60 mm"; }),
       {"--thickness:1:1", "give 47.7 mm at most"}},
      {"swing_under_camming4",
       change(knife(),
              [](auto& o) {
                o.thickness = "2 mm";
                o.device = "camming4";
              }),
       {"--thickness:1:1: a synchronous sector of CAMMING4 is straight", "2.1 % slower than the web"}},
      {"scene_without_table",
       change(knife(), [](auto& o) { o.scene = "x.yaml"; }),
       {"--scene:1:1: there is nothing to run in it; give --table too [option.missing]"}},
      {"decpt", change(knife(), [](auto& o) { o.decpt = 2; }), {"--decpt:1:1"}},
      {"pulse", change(knife(), [](auto& o) { o.master_pulse = "1 kg/3"; }), {"--master-pulse:1:1"}},
      {"pulse_count", change(knife(), [](auto& o) { o.slave_pulse = "1 mm/0"; }), {"--slave-pulse:1:1"}},
      {"not_whole_pulses",
       change(knife(),
              [](auto& o) {
                o.device = "lx3vp";
                o.length = "800.004 mm";
              }),
       {"--length:1:1: 800.004 mm is no whole number of master pulses", "the nearest is 800 mm"}},
      {"not_whole_um",
       change(knife(),
              [](auto& o) {
                o.device = "camming4";
                o.circumference = "600.0003 mm";
              }),
       {"--circumference:1:1: 600.0003 mm is no whole number of 0.1 mm"}},
      {"coarse_pulses",
       change(knife(),
              [](auto& o) {
                o.device = "lx3vp";
                o.master_pulse = "1 mm";
              }),
       {"--master-pulse:1:1", "give 0.8 mm at most"}},
  };
}

INSTANTIATE_TEST_SUITE_P(Options, DesignRefusal, testing::ValuesIn(refusals()),
                         [](const auto& info) { return info.param.name; });

// What the refusal says is enough, and a little less is not.
TEST_F(DesignCommand, WhatARefusalNamesIsEnough) {
  auto options = knife();
  options.length = "400 mm";
  options.max_velocity = "1.8 m/s";
  options.max_acceleration = "12 m/s2";
  ASSERT_EQ(run(options), cli::bad_input);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(err, found, std::regex("at least, or run the master at ([0-9.]+ m/s)")));
  options.speed = found[1];
  EXPECT_EQ(run(options), cli::all_passed) << err;
  options.speed = "60 m/min";
  ASSERT_EQ(run(options), cli::bad_input);
  ASSERT_TRUE(std::regex_search(err, found, std::regex("max-acceleration[^\n]*give ([0-9.]+ m/s2)")));
  options.max_acceleration = found[1];
  EXPECT_EQ(run(options), cli::all_passed) << err;
}

}  // namespace
}  // namespace drycut::sim::studies
