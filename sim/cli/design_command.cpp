#include "sim/cli/design_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "sim/cams/study.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/output_folder.hpp"
#include "sim/report/report.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/design/scene.hpp"

namespace drycut::sim::cli {

namespace {

using studies::DesignAxes;
using studies::DesignJob;
using studies::DesignKind;
using studies::MoveGoal;
using studies::PulseWay;

constexpr std::array kinds = {std::pair{"rotary_knife", DesignKind::rotary_knife},
                              std::pair{"flying_saw", DesignKind::flying_saw},
                              std::pair{"feed", DesignKind::feed}};
constexpr std::array goals = {std::pair{"rms", MoveGoal::rms}, std::pair{"peak", MoveGoal::peak},
                              std::pair{"jerk", MoveGoal::jerk}, std::pair{"energy", MoveGoal::energy}};
using Fit = std::optional<studies::DeviceCam> (*)(const DesignJob&, const DesignAxes&, Problems&);
constexpr std::array<std::pair<const char*, Fit>, 3> devices = {
    std::pair{"camming4", Fit(studies::fit_camming4)}, std::pair{"lx3vp", Fit(studies::fit_lx3vp)},
    std::pair{"mc_camin", Fit(studies::fit_mc_camin)}};

/// The value of a word, or a problem of `option`.
template <typename Choices>
auto chosen(const char* option, const std::string& word, const Choices& choices, Problems& problems)
    -> std::optional<typename Choices::value_type::second_type> {
  std::vector<std::string> words;
  for (const auto& [name, value] : choices) {
    if (word == name) return value;
    words.emplace_back(name);
  }
  problems.push_back({"option.unknown-choice"_code, option, 1, 1,
                      fmt::format("there is no {}", in_quotes(word)), did_you_mean(word, words)});
  return {};
}

/// The options as a job. What is wrong with one is told by its name.
class JobReader {
 public:
  JobReader(const DesignOptions& options, Problems& problems) : options_(options), problems_(problems) {}

  DesignJob read() {
    const auto kind = chosen("job", options_.kind, kinds, problems_);
    if (kind) job_.kind = *kind;
    if (const auto goal = chosen("--minimise", options_.minimise, goals, problems_)) job_.goal = *goal;
    job_.length = needed("--length", options_.length);
    job_.speed = quantity("--speed", options_.speed, "m/min");
    job_.max_velocity = quantity("--max-velocity", options_.max_velocity, "m/s");
    job_.max_acceleration = quantity("--max-acceleration", options_.max_acceleration, "m/s2");
    job_.max_travel = quantity("--max-travel", options_.max_travel, "mm");
    job_.no_reverse = options_.no_reverse;
    if (!kind) return job_;  // what else it needs hangs on it
    read_slave();
    read_sync();
    read_loads();
    check_combinations();
    return job_;
  }

 private:
  void problem(Code code, const char* option, std::string what, std::string remedy) {
    problems_.push_back({code, option, 1, 1, std::move(what), std::move(remedy)});
  }
  void missing(const char* option, const char* what) {
    problem("option.missing"_code, option, "it is not given", fmt::format("give {}, such as 120 mm", what));
  }

  /// In SI, nothing if it was not given or has a problem; above 0 unless `least` says otherwise.
  std::optional<double> quantity(const char* option, const std::string& text, const char* unit,
                                 double least = 1e-9) {
    if (text.empty()) return {};
    scenario::Findings findings({option});
    const auto name = std::string(option).substr(2);
    const auto value = scenario::read_si({text, {1, 1}}, name, unit, findings);
    for (auto& found : findings.sorted()) problems_.push_back(std::move(found));
    constexpr double most = 1e9;
    if (!value || (*value >= least && *value <= most)) return value;
    problem("option.out-of-range"_code, option, fmt::format("{} is out of range", text),
            least > 0 ? "give more than 0, at most 1e9 in SI" : "give 0 or more, at most 1e9 in SI");
    return {};
  }
  double needed(const char* option, const std::string& text) {
    if (text.empty()) missing(option, "it");
    return quantity(option, text, "mm").value_or(1);
  }
  void refuse(const char* option, bool given, const char* why) {
    if (given) problem("option.does-not-apply"_code, option, why, "leave it out");
  }

  void read_slave() {
    const bool knife = job_.kind == DesignKind::rotary_knife;
    const bool feed = job_.kind == DesignKind::feed;
    if (knife) {
      job_.slave = needed("--circumference", options_.circumference) / options_.blades;
      job_.blades = options_.blades;
    } else {
      refuse("--circumference", !options_.circumference.empty(), "only a rotary knife has one");
      refuse("--blades", options_.blades != 1, "only a rotary knife has several");
    }
    if (feed)
      job_.slave = needed("--feed", options_.feed);
    else
      refuse("--feed", !options_.feed.empty(), "only a feed has one");
    if (job_.kind != DesignKind::flying_saw)
      refuse("--max-travel", job_.max_travel.has_value(), "only a flying saw goes out and back");
    else
      refuse("--no-reverse", options_.no_reverse, "a flying saw must go back");
  }

  void read_sync() {
    const bool knife = job_.kind == DesignKind::rotary_knife;
    if (knife)
      job_.thickness = quantity("--thickness", options_.thickness, "mm").value_or(0);
    else
      refuse("--thickness", !options_.thickness.empty(),
             "only the blade of a rotary knife swings through it");
    constexpr double tenth = 1e-4;
    if (!options_.sync.empty())
      job_.sync = quantity("--sync", options_.sync, "mm", 0).value_or(0);
    else if (job_.thickness > 0 && job_.thickness < job_.radius())
      job_.sync = std::ceil(job_.contact() / tenth) * tenth;
    else if (job_.kind == DesignKind::feed)
      missing("--sync", "the way of the master on which the slave rests");
    else
      missing("--sync", knife ? "the way on which the blade runs with the web"
                              : "the way on which the saw runs with the tube");
  }

  /// An inertia of a drum is what its mass at the blade would be.
  double load(const char* option, const std::string& text, const char* straight, const char* turning) {
    if (text.empty()) return 0;
    const auto parsed = scenario::parse_quantity(text);
    const bool knife = job_.kind == DesignKind::rotary_knife;
    if (knife && parsed && scenario::is_unit(parsed->unit) &&
        scenario::same_dimension(parsed->unit, turning)) {
      const double radius = job_.slave * job_.blades / units::turn;
      return quantity(option, text, turning, 0).value_or(0) /
             (option == std::string_view("--coulomb") ? radius : radius * radius);
    }
    return quantity(option, text, straight, 0).value_or(0);
  }
  void read_loads() {
    job_.inertia = load("--inertia", options_.inertia, "kg", "kg m2");
    job_.viscous = load("--viscous", options_.viscous, "N s/m", "N m s");
    job_.coulomb = load("--coulomb", options_.coulomb, "N", "N m");
    if (job_.goal == MoveGoal::energy) {
      if (!(job_.inertia > 0))
        problem("option.missing"_code, "--inertia", "energy depends on what is moved",
                "give it, such as 20 kg or 0.3 kg m2");
      return;
    }
    for (const auto& [option, text] : {std::pair{"--inertia", &options_.inertia},
                                       {"--viscous", &options_.viscous},
                                       {"--coulomb", &options_.coulomb}})
      refuse(option, !text->empty(), "only --minimise energy asks for it");
  }

  void check_combinations() {
    if (!job_.speed)
      for (const auto& [option, given] : {std::pair{"--max-velocity", job_.max_velocity.has_value()},
                                          {"--max-acceleration", job_.max_acceleration.has_value()},
                                          {"--minimise", job_.goal == MoveGoal::energy}})
        if (given)
          problem("option.does-not-apply"_code, option, "it means nothing without the master's speed",
                  "give --speed too");
    if (options_.device.empty() && !options_.table.empty())
      problem("option.missing"_code, "--table", "whose table?", "give --device camming4, lx3vp or mc_camin");
    const auto ending = std::filesystem::path(options_.table).extension();
    const bool tab = options_.device == "mc_camin";
    if (!options_.table.empty() && ending != ".csv" && !(tab && ending == ".tab"))
      problem("option.file-name"_code, "--table",
              fmt::format("{} does not end in .csv{}", options_.table, tab ? " or .tab" : ""),
              tab ? "name it x.csv, or x.tab for the kernel's own kind" : "name it x.csv");
    if (options_.table.empty() && !options_.scene.empty())
      problem("option.missing"_code, "--scene", "there is nothing to run in it", "give --table too");
    if (options_.decpt && options_.device != "camming4")
      problem("option.does-not-apply"_code, "--decpt", "only CAMMING4 has it", "leave it out");
    if (!options_.table.empty())
      check_output("--table", options_.table, {"", "job"}, {options_.force}, problems_);
  }

  const DesignOptions& options_;
  Problems& problems_;
  DesignJob job_;
};

/// "0.01 mm", or "500 mm/10000"; nothing if it is not given.
std::optional<PulseWay> pulse_way(const char* option, const std::string& text, Problems& problems) {
  if (text.empty()) return {};
  const auto slash = text.rfind('/');
  const auto refuse = [&] {
    problems.push_back({"option.value"_code, option, 1, 1,
                        fmt::format("{} is no way of a pulse", in_quotes(text)),
                        "give a length, or a length and the pulses on it: 0.01 mm, 500 mm/10000"});
    return PulseWay();
  };
  const auto way = scenario::parse_quantity(trimmed(std::string_view(text).substr(0, slash)));
  const auto count = slash == std::string::npos
                         ? std::optional(1.0)
                         : parsed<double>(trimmed(std::string_view(text).substr(slash + 1)));
  constexpr double most = 1e9;
  if (!way || !scenario::is_unit(way->unit) || !scenario::same_dimension(way->unit, "mm") || !count)
    return refuse();
  const PulseWay made{scenario::from_si(scenario::to_si(way->number, way->unit), "mm"), *count};
  const bool sound = made.millimetres > 0 && made.millimetres <= most && *count >= 1 && *count <= most &&
                     *count == std::floor(*count);
  return sound ? made : refuse();
}

/// The scene in which the table is to run, if one is asked for.
std::optional<scenario::Scenario> scene_of(const DesignOptions& options, Problems& problems) {
  if (options.scene.empty()) return {};
  const auto before = problems.size();
  auto scene = scenario::read_scenario(options.scene, {}, problems);
  if (problems.size() != before) return {};
  return scene;
}

std::optional<studies::DesignSheet> designed(const DesignOptions& options,
                                             const std::optional<scenario::Scenario>& scene,
                                             Problems& problems) {
  const auto job = JobReader(options, problems).read();
  const studies::GivenPulses pulses{pulse_way("--master-pulse", options.master_pulse, problems),
                                    pulse_way("--slave-pulse", options.slave_pulse, problems)};
  const auto fit = options.device.empty() ? std::optional<Fit>(nullptr)
                                          : chosen("--device", options.device, devices, problems);
  if (problems.empty()) problems = studies::hindrances(job);
  if (!problems.empty()) return {};
  auto axes = scene
                  ? studies::scene_axes(*scene, options.device, job, pulses, problems)
                  : DesignAxes{pulses.master.value_or(PulseWay{0.01}), pulses.slave.value_or(PulseWay{0.02})};
  axes.decpt = options.decpt;
  if (!problems.empty()) return {};
  const auto cam = studies::design_cam(job);
  if (!cam) {
    problems.push_back({"design.impossible"_code, "design", 1, 1, "no cam keeps these limits",
                        "give them a little more room"});
    return {};
  }
  studies::DesignSheet sheet{*cam, {}};
  if (*fit == nullptr) return sheet;
  sheet.device = (*fit)(job, axes, problems);
  sheet.device_name = options.device;
  if (!sheet.device) return {};
  return sheet;
}

/// The scenario that plays the table.
std::optional<studies::CamScene> scene_with(const DesignOptions& options, const studies::DesignSheet& sheet,
                                            const scenario::Scenario& scene, Problems& problems) {
  auto made = studies::cam_scene(sheet, scene, options.table, problems);
  if (!made) return {};
  for (const auto& file : {made->file, made->registers_file})
    if (!file.empty())
      check_output("--scene", file.string(), {options.scene, "scene"}, {options.force}, problems);
  return made;
}

/// The table as a file, judged as `drycut cam` judges what it reads from there.
std::string table_text(const DesignOptions& options, studies::DesignSheet& sheet) {
  const auto name = options.table.empty() ? options.device : options.table;
  auto text = studies::remarks_text(sheet) + cams::cam_file(sheet.device->table, name);
  Problems problems;
  const auto table = cams::read_cam(options.device, text, name, problems);
  const auto study = cams::study_cam(table, {sheet.device->duty}, problems);
  if (!problems.empty()) throw std::runtime_error("the table does not read back: " + to_string(problems[0]));
  sheet.findings = study.findings;
  return text;
}

record::Verdict verdict_of(const DesignOptions& options, const studies::DesignSheet& sheet) {
  record::Verdict verdict;
  verdict.title = fmt::format("Cam of a {}", options.kind);
  verdict.word = "DESIGNED";
  if (sheet.device) {
    const bool unsound = cams::is_unsound(sheet.findings, false);
    verdict.judge(!unsound);
    verdict.word = "";
    verdict.sentence =
        unsound ? "drycut cam finds fault with the table" : "drycut cam finds no fault with the table";
  }
  verdict.counts["findings"] = std::ssize(sheet.findings);
  if (!options.scene.empty()) verdict.scenarios = {options.scene};
  return verdict;
}

}  // namespace

int design_cam(const DesignOptions& options) {
  Problems problems;
  const auto base = scene_of(options, problems);
  auto sheet = designed(options, base, problems);
  std::optional<studies::CamScene> scene;
  if (problems.empty() && base) scene = scene_with(options, *sheet, *base, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty() && !options.out.empty())
    folder.emplace(options.out, "design", std::vector<std::string>{"design.png", record::verdict_file},
                   problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  int status = all_passed;
  try {
    const auto table = sheet->device ? table_text(options, *sheet) : "";
    const auto verdict = verdict_of(options, *sheet);
    status = verdict.exit;
    fmt::print("{}", studies::sheet_text(*sheet));
    if (!options.table.empty()) {
      write_file(options.table, table);
      fmt::print("  table: {}\n", options.table);
      if (const auto speed = sheet->device->duty.master_speed)
        fmt::print("  judge it again: drycut cam {} --master-speed {:.9g}\n", shell_word(options.table),
                   *speed);
    }
    if (scene && !scene->registers.empty()) {
      write_file(scene->registers_file, scene->registers);
      fmt::print("  registers: {}\n", scene->registers_file.string());
    }
    if (scene) {
      write_file(scene->file, scene->scenario);
      fmt::print("  scenario: {}\n  run it: drycut run {}\n", scene->file.string(),
                 shell_word(scene->file.string()));
    }
    if (folder) {
      folder->begin();
      const auto picture = folder->add("design.png");
      report::draw_png(studies::design_plot(*sheet), picture);
      record::write_verdict(verdict, *folder);
      fmt::print("  picture: {}\n", picture.string());
    }
  } catch (const std::exception& error) {
    return print_failure(drycut::words_of(error));
  }
  return status;
}

namespace {

void design_options(CLI::App& design, int& status) {
  const auto chosen = std::make_shared<DesignOptions>();
  auto& options = *chosen;
  design.add_option("job", options.kind, "rotary_knife, flying_saw or feed")->required();
  const auto add = [&](const char* name, std::string& target, const char* help) {
    auto* option = design.add_option(name, target, help);
    if (!target.empty()) option->capture_default_str();
  };
  add("--length", options.length, "Way of the master for a piece, as \"800 mm\"");
  add("--circumference", options.circumference, "Way of the blade in a turn of the drum, as \"600 mm\"");
  design.add_option("--blades", options.blades, "Blades on the drum")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  add("--feed", options.feed, "Way of the slave for a piece");
  add("--sync", options.sync,
      "Way of the master around the cut on which the slave has its speed; of a feed: rests");
  add("--thickness", options.thickness,
      "Of the material under a rotary knife: the blade has the web's speed along the web while it swings "
      "through, "
      "its own is v / cos; --sync is then the way on which it has, without it as long as the blade is in the "
      "material (lx3vp, mc_camin)");
  add("--speed", options.speed, "Speed of the master: figures in time, and what limits need");
  add("--minimise", options.minimise, "rms or peak of the acceleration, peak jerk, or energy (copper loss)");
  add("--max-velocity", options.max_velocity, "Limit of the slave's velocity, as \"1.5 m/s\"");
  add("--max-acceleration", options.max_acceleration, "Limit of its acceleration, as \"20 m/s2\"");
  add("--max-travel", options.max_travel, "Limit of a flying saw's travel from end to end");
  design.add_flag("--no-reverse", options.no_reverse, "Knife and feed: never backwards, a dwell instead");
  add("--inertia", options.inertia, "For energy: what is moved, in kg at the blade, of a drum also in kg m2");
  add("--viscous", options.viscous, "For energy: friction with speed, N s/m, of a drum also N m s");
  add("--coulomb", options.coulomb, "For energy: friction without, N, of a drum also N m");
  add("--device", options.device, "What is to play it: camming4, lx3vp, mc_camin");
  add("--table", options.table, "Write the device's table: .csv, of mc_camin also .tab");
  add("--scene", options.scene,
      "Scenario (.yaml) in which the table is to run: writes one beside the table that extends it, with the "
      "registers that the PLC needs");
  add("--master-pulse", options.master_pulse,
      "Way of the master a pulse (count x4), of CAMMING4 and LX3VP; also as \"500 mm/10000\"; unless given "
      "the "
      "scene's, without one 0.01 mm");
  add("--slave-pulse", options.slave_pulse, "The same of the slave; unless given the scene's, else 0.02 mm");
  design.add_option("--decpt", options.decpt, "CAMMING4: 1 Um is 10^-decpt mm; else the coarsest that fits")
      ->check(CLI::Range(0, 3));
  add_force(design, options.force);
  add_out(design, options.out, "Directory for a picture: position, velocity, acceleration, jerk");
  design.callback([chosen, &status] { status = design_cam(*chosen); });
}

}  // namespace

Verb design_verb() {
  return {
      "design",
      "Design a cam from its job: the best one there is, and the nearest that a device can play, as its "
      "table.\n"
      "rotary_knife: --length of a piece, --circumference of the drum. flying_saw: --length; the carriage "
      "goes\n"
      "out and back. feed: --feed of the slave in a --length of the master, of which it rests for --sync.\n"
      "Exit status: 0 designed, 1 drycut cam finds fault with the table, 2 bad input or a job that cannot "
      "be\n"
      "done, 3 a result could not be written",
      {R"(drycut design rotary_knife --length "800 mm" --circumference "600 mm")"},
      {},
      design_options};
}

}  // namespace drycut::sim::cli
