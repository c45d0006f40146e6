#include "sim/report/gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "base/shown_units.hpp"
#include "renders/caption_bar.hpp"
#include "renders/decimate.hpp"
#include "renders/filmstrip.hpp"
#include "renders/mesh.hpp"
#include "renders/part_models.hpp"
#include "renders/pictures.hpp"
#include "renders/process.hpp"
#include "renders/video.hpp"
#include "sim/controllers/kinds.hpp"
#include "sim/file.hpp"
#include "sim/loop/shutter.hpp"
#include "sim/loop/signs.hpp"
#include "sim/report/chosen_frames.hpp"
#include "sim/report/coverage.hpp"
#include "sim/report/drives.hpp"
#include "sim/report/gallery_plots.hpp"
#include "sim/report/key_figures.hpp"
#include "sim/report/origin.hpp"
#include "sim/report/report.hpp"
#include "sim/report/results.hpp"
#include "sim/report/torque.hpp"
#include "sim/scenario/axis_units.hpp"
#include "sim/scenario/parameter_text.hpp"
#include "sim/studies/half_step.hpp"

namespace drycut::sim::report {

namespace {

constexpr auto* frames_folder = "frames";
constexpr auto* cams_folder = "cams";
constexpr auto* video_file = "film.mp4";
constexpr auto* strip_file = "filmstrip.png";

/// Takes the rows of a table as they come; of very many the first and the last stay.
class TableRows {
 public:
  explicit TableRows(renders::ReportTable& table) : table_(table) {}
  void add(renders::ReportRow row) {
    if (count_ < 2 * most)
      table_.rows.push_back(std::move(row));
    else
      table_.rows[most + count_ % most] = std::move(row);
    ++count_;
  }
  void finish() {
    if (count_ <= 2 * most) return;
    const auto oldest = static_cast<std::ptrdiff_t>(most + count_ % most);
    std::rotate(table_.rows.begin() + most, table_.rows.begin() + oldest, table_.rows.end());
    table_.title += fmt::format(": the first {0} and the last {0} of {1}, all are in the record of the run",
                                most, count_);
  }

 private:
  static constexpr std::size_t most = 1000;
  renders::ReportTable& table_;
  std::size_t count_ = 0;
};

renders::ReportTable event_table(const record::Recording& recording, const loop::KnownEvent& known) {
  renders::ReportTable table{fmt::format("{} of {}", known.name, known.source), {"time [s]"}, {}, true};
  for (const auto& [name, unit] : known.values) {
    table.headings.push_back(unit.empty() ? name : fmt::format("{} [{}]", name, shown_unit(unit).unit));
  }
  TableRows rows(table);
  for (const auto& event : recording.events()) {
    if (event.source != known.source || event.event != known.name) continue;
    renders::ReportRow row{{fmt::format("{:.6f}", event.at_seconds())}};
    for (const auto& [name, unit] : known.values) {
      const auto* value = event.find(name);
      row.cells.push_back(
          value == nullptr
              ? ""
              : fmt::format("{:.6g}", record::without_noise(shown_unit(unit).factor * value->number)));
    }
    rows.add(std::move(row));
  }
  rows.finish();
  return table;
}

renders::ReportTable parameter_table(const scenario::PlantEntry& entry) {
  renders::ReportTable table{fmt::format("Parameters of {} ({})", entry.name.text, entry.type.text),
                             {"parameter", "value", "meaning", "from"},
                             {},
                             true};
  const auto given = [&](const std::string& name) {
    return std::any_of(entry.places.begin(), entry.places.end(),
                       [&](const auto& p) { return p.first == name; });
  };
  const auto from = [&](const plants::Parameter& parameter) {
    const auto among = [&](const auto& values) {
      const auto found =
          std::ranges::find(values, parameter.name, &scenario::PlantEntry::Modelled::parameter);
      return found == values.end() ? nullptr : &found->from;
    };
    if (const auto* fitted = among(entry.fitted)) return *fitted;
    if (given(parameter.name)) return std::string("the scenario");
    const auto* modelled = among(entry.modelled);
    return modelled == nullptr ? std::string(parameter.source) : *modelled;
  };
  for (const auto& parameter : entry.definition->parameters()) {
    table.rows.push_back(
        {{parameter.name, scenario::value_text(parameter), std::string(parameter.meaning), from(parameter)}});
  }
  return table;
}

renders::ReportTable axis_table(const controllers::PlcopenSection::Axis& axis) {
  renders::ReportTable table{fmt::format("Parameters of axis {} at the start", axis.name.text),
                             {"parameter", "value", "meaning", "from"},
                             {},
                             true};
  const auto& [name, parameters, measure] = axis.configuration;
  for (const auto& row : devices::plcopen::axis_parameter_table()) {
    const bool given = std::any_of(axis.places.begin(), axis.places.end(),
                                   [&](const auto& p) { return p.first == row.name; });
    table.rows.push_back({{std::string(row.name), scenario::axis_value_text(row, parameters, measure),
                           std::string(row.meaning), given ? "the scenario" : std::string(row.number)}});
  }
  return table;
}

/// What the controller holds at the end: device parameters, states, program variables.
renders::ReportTable controller_table(loop::Simulation& simulation) {
  renders::ReportTable table{"Controller at the end of the run", {"value", "", "unit"}, {}, true};
  for (const auto& reading : simulation.controller_values()) {
    const auto [unit, factor] = shown_unit(reading.unit);
    table.rows.push_back({{reading.name, fmt::format("{:.10g}", factor * reading.read()), unit}});
  }
  return table;
}

std::string units_note(double simulated) { return fmt::format("{:g} s", simulated); }

/// The units of the device in which something was recorded, explained; how large the user's own are.
std::vector<std::string> units_explained(const record::Recording& recording,
                                         const scenario::PicturesSection& pictures) {
  std::vector<std::string> lines;
  const auto& columns = recording.columns();
  for (const auto& [unit, meaning] : unit_meaning_rows) {
    if (std::any_of(columns.begin(), columns.end(),
                    [&unit = unit](const auto& column) { return column.unit.starts_with(unit); }))
      lines.push_back(fmt::format("{}: {}.", unit, meaning));
  }
  for (const auto& [of, is] : pictures.units)
    lines.push_back(fmt::format("{} counts in {:g} {}.", of.text, is.number, is.unit));
  return lines;
}

MachineFacts facts_of(const loop::Simulation& simulation, const record::Outcome& outcome) {
  MachineFacts facts{outcome.drives, {}};
  for (const auto& [name, plant] : simulation.plants())
    for (const auto& [own, travel, cuts] : plant->recurrences())
      facts.recurrences.push_back({fmt::format("{}.{}", name, own), travel, cuts});
  return facts;
}

/// Plants whose speed the timeline can set.
std::vector<std::string> lines_in(const loop::Simulation& simulation) {
  std::vector<std::string> lines;
  for (const auto& [name, plant] : simulation.plants()) {
    const auto settings = plant->settings();
    if (std::any_of(settings.begin(), settings.end(), [](const auto& s) { return s.name == "speed"; }))
      lines.push_back(name);
  }
  return lines;
}

constexpr std::size_t fewest_frames = 3, most_frames = 6;  // of a report
constexpr std::size_t strip_frames = 8;

std::vector<double> times_of(const std::vector<loop::Snapshot>& shots) {
  std::vector<double> times;
  times.reserve(shots.size());
  for (const auto& shot : shots) times.push_back(seconds(shot.time));
  return times;
}

std::vector<Moment> moments_in_film(const loop::Simulation& simulation, const record::Outcome& outcome) {
  const double begin = seconds(simulation.snapshots().front().time);
  const double end = seconds(simulation.snapshots().back().time);
  const auto event = simulation.frames_event();
  return event ? moments_around(*event, begin, end)
               : moments_of(simulation.recording().events(), outcome.checks, begin, end);
}

/// What the machine does, at a glance.
std::vector<ChosenFrame> frames_to_show(const loop::Simulation& simulation, const record::Outcome& outcome,
                                        std::size_t wanted) {
  return chosen_frames(times_of(simulation.snapshots()), moments_in_film(simulation, outcome), wanted);
}

std::string frame_label(const loop::Simulation& simulation, const ChosenFrame& chosen) {
  const double time = seconds(simulation.snapshots()[chosen.frame].time);
  const auto event = simulation.frames_event();
  if (event) return fmt::format("{:.3f} s ({:+.1f} ms)", time, (time - *event) * 1e3);
  return fmt::format("{:.3f} s{}{}", time, chosen.what.empty() ? "" : ": ", chosen.what);
}

}  // namespace

renders::Report report_of(const scenario::Scenario& scenario, loop::Simulation& simulation,
                          const record::Outcome& outcome, const Drawn& drawn) {
  renders::Report report;
  report.title = scenario.scene.title.empty() ? scenario.file.stem().string() : scenario.scene.title;
  report.scenario = scenario.file.filename().string();
  report.passed = outcome.passed();
  report.verdict = verdict_text(outcome);
  report.keys = key_figures(simulation.recording(), simulation.known_events(), lines_in(simulation), outcome,
                            scenario.drives.judge);
  report.facts = {{{"simulated", units_note(seconds(outcome.end))}},
                  {{"physics step", fmt::format("{:g} us", static_cast<double>(scenario.scene.step) / 1e3)}},
                  {{"seed", fmt::format("{}", scenario.scene.seed)}},
                  {{"drycut", DRYCUT_VERSION}},
                  {{"what is in the model", "drycut help validity"}}};
  for (auto& fact : origin_of(scenario.file)) report.facts.push_back(std::move(fact));
  add_overrides(scenario.overrides, report);
  if (const auto samples = simulation.recording().times().size(); samples > renders::kMostSamples)
    report.notes.push_back(
        fmt::format("{} samples of each channel: what the plots show is thinned, to the lowest and "
                    "highest of {} stretches of equal length; all are in the record of the run",
                    samples, renders::kStretches));
  if (auto sign = loop::sign_told(outcome); !sign.empty()) report.notes.push_back(std::move(sign));
  for (const auto& warning : outcome.warnings()) report.notes.push_back("warning: " + to_string(warning));
  for (const auto& note : simulation.notes()) report.notes.push_back(to_string(note));
  add_checks(outcome.checks, report);
  if (auto drives = drive_table(outcome.drives, scenario.drives.judge && outcome.failure.empty());
      !drives.rows.empty())
    report.summary.push_back(std::move(drives));
  for (const auto& split : torque_splits(scenario, simulation, outcome.drives))
    report.tables.push_back(torque_table(split));
  if (outcome.half_step) report.summary.push_back(studies::margin_table(outcome, scenario.scene.step));
  if (!drawn.frames.empty()) {
    // Frames between moments that have a name look alike; around an event each of them counts.
    const auto wanted = simulation.frames_event() ? most_frames
                                                  : std::clamp(moments_in_film(simulation, outcome).size(),
                                                               fewest_frames, most_frames);
    for (const auto& chosen : frames_to_show(simulation, outcome, wanted))
      report.frames.push_back({drawn.frames.at(chosen.frame), frame_label(simulation, chosen)});
  }
  report.units = units_explained(simulation.recording(), scenario.pictures);
  report.video = drawn.video;
  report.poster = drawn.poster;
  for (const auto& known : simulation.known_events()) {
    auto table = event_table(simulation.recording(), known);
    if (!table.rows.empty()) report.tables.push_back(std::move(table));
  }
  renders::ReportTable others{"Other events", {"time [s]", "source", "event", "what"}, {}, false};
  TableRows rows(others);
  for (const auto& event : simulation.recording().events()) {
    const auto is_known = [&](const loop::KnownEvent& k) {
      return k.source == event.source && k.name == event.event;
    };
    if (std::any_of(simulation.known_events().begin(), simulation.known_events().end(), is_known)) continue;
    rows.add(
        {{fmt::format("{:.6f}", event.at_seconds()), event.source, event.event, record::values_text(event)}});
  }
  rows.finish();
  if (!others.rows.empty()) report.tables.push_back(std::move(others));
  if (auto table = coverage_table(simulation); !table.rows.empty()) report.tables.push_back(std::move(table));
  if (auto table = controller_table(simulation); !table.rows.empty())
    report.tables.push_back(std::move(table));
  if (const auto* plcopen = controllers::controller_of<controllers::PlcopenSection>(scenario))
    for (const auto& axis : plcopen->axes) report.tables.push_back(axis_table(axis));
  for (const auto& entry : scenario.plants) report.tables.push_back(parameter_table(entry));
  report.scenario_expanded = scenario::expand(scenario);
  return report;
}

std::string write_pictures(const scenario::Scenario& scenario, loop::Simulation& simulation,
                           const renders::Film& film, const record::Outcome& outcome, OutputFolder& folder,
                           int threads, const std::function<void(const char*, double)>& progress) {
  Drawn drawn;
  std::string left_out;
  if (!film.frames.empty()) {
    const auto count = static_cast<double>(film.frames.size());
    const auto frames = folder.add(frames_folder, renders::frame_names(film));
    drawn.frames = renders::draw_film(
        film, frames, [&](int done) { progress("drawing", done / count); }, threads);
    std::vector<renders::StripFrame> strip;
    for (const auto& chosen : frames_to_show(simulation, outcome, strip_frames))
      strip.push_back({drawn.frames.at(chosen.frame), frame_label(simulation, chosen)});
    renders::draw_filmstrip(strip, renders::CaptionLayout(film).height(), folder.add(strip_file));
    if (scenario.pictures.video) {
      progress("filming", 1);
      try {
        const auto video = folder.add(video_file);
        const auto poster =
            poster_frame(times_of(simulation.snapshots()), moments_in_film(simulation, outcome));
        renders::encode_video(frames, scenario.pictures.every, poster, video);
        drawn.video = video;
        drawn.poster = drawn.frames.at(poster);
      } catch (const renders::HelperFailed& failed) {
        left_out = failed.what();
      }
    }
  }
  auto report = report_of(scenario, simulation, outcome, drawn);
  const auto machine = facts_of(simulation, outcome);
  for (const auto& finding : findings_of(scenario, simulation.recording(), machine))
    report.notes.push_back(finding);
  if (!left_out.empty()) report.notes.push_back("left out: " + left_out);
  auto plots = plots_of(scenario, simulation.recording(), machine);
  for (auto& plot : drive_plots(outcome.drives, scenario.pictures.plots)) plots.push_back(std::move(plot));
  const auto cams = cams_of(scenario, simulation);
  for (const auto& cam : cams) {
    plots.insert(plots.end(), cam.plots.begin(), cam.plots.end());
    write_file(folder.add(cams_folder, {cam.name + ".csv"}) / (cam.name + ".csv"), cam.table);
  }
  add_plots(std::move(plots), folder, report);
  report.sections = cam_sections(cams, report.plots);
  if (scenario.pictures.view && !film.frames.empty()) report.view = renders::machine_view(film);
  renders::write_report(report, folder.add(report_file));
  return left_out;
}

}  // namespace drycut::sim::report
