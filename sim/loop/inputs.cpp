#include "sim/loop/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include "base/state_archive.hpp"
#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/loop/bus.hpp"
#include "sim/loop/files_read.hpp"
#include "sim/loop/live_parameters.hpp"
#include "sim/recordings/recording.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::loop {

namespace {

using scenario::RecordedInput;

/// What an input writes.
struct Driven {
  std::function<void(double)> write;
  std::string unit;                            ///< "" = pure number
  std::optional<devices::ValueRange> range{};  ///< in `unit`
  bool is_switch = false;                      ///< on where it is not 0
};

/// The recording's YAML, relative to the working folder.
std::filesystem::path path_of(const scenario::Scenario& scenario, const RecordedInput& input) {
  return scenario.file.parent_path() / input.recording.text;
}

}  // namespace

/// Makes sources of a scenario's inputs and says what does not fit.
class InputBinder {
 public:
  InputBinder(const scenario::Scenario& scenario, const std::vector<NamedPlant>& plants, Names& names,
              Problems& problems, std::vector<Finding>& notes)
      : scenario_(scenario), plants_(plants), names_(names), problems_(problems), notes_(notes) {}

  void bind(Inputs& made) {
    for (const auto& input : scenario_.inputs) {
      const auto driven = driven_by(input);
      const auto* recording = recording_of(input);
      if (!driven || recording == nullptr) continue;
      const auto* series = series_of(input, *recording);
      if (series == nullptr || !fits(input, *series, *driven)) continue;
      auto source = source_of(input, *series, *driven, recording->begin());
      if (source.times.empty()) continue;
      if (input.after_end == RecordedInput::AfterEnd::stop && source.times.back() < made.end_.at)
        made.end_ = {source.times.back(), input.name.text};
      made.sources_.push_back(std::move(source));
      names_.drive(input.name.text);
    }
  }

 private:
  void problem(Code code, const scenario::ScenePlace& place, std::string what, std::string remedy) {
    problems_.push_back(scenario::problem_at(code, scenario_, place, std::move(what), std::move(remedy)));
  }

  std::optional<Driven> driven_by(const RecordedInput& input) {
    const auto& name = input.name.text;
    if (const auto target = names_.target(name))
      return Driven{target->write, target->unit, target->range, name.starts_with("panel.")};
    std::vector<std::string> plugs;
    for (const auto& [plant, made] : plants_) {
      for (const auto& port : made->ports()) {
        auto plug = plug_of(port);
        if (!plug) continue;
        plugs.push_back(plant + "." + port.name);
        if (plugs.back() != name) continue;
        return is_wired(input.name) ? std::nullopt : plug;
      }
    }
    if (const auto fixed = fixed_parameter(scenario_, name))
      problem(fixed->code, input.name.place, fixed->what, fixed->remedy);
    else
      problem("timeline.nothing-to-set"_code, input.name.place,
              fmt::format("nothing called '{}' can be driven", name),
              did_you_mean(name, plugs, names_.suggest_target(name)));
    return {};
  }

  static std::optional<Driven> plug_of(const plants::Port& port) {
    if (auto* const* reference = std::get_if<plants::ReferencePort*>(&port.plug))
      return Driven{[to = *reference](double volts) { to->volts = volts; }, "V"};
    if (auto* const* command = std::get_if<plants::CommandPort*>(&port.plug))
      return Driven{[to = *command](double on) { to->level = on != 0; }, "", {}, true};
    return {};
  }

  /// Told, if it is.
  bool is_wired(const scenario::Text& plug) {
    for (const auto& wire : scenario_.wiring) {
      if (wire.plug.text != plug.text) continue;
      problem("input.driven-twice"_code, plug.place,
              fmt::format("{} is wired to {}, which drives it", plug.text, wire.terminal.text),
              "leave the wire out, or this input");
      return true;
    }
    return false;
  }

  /// nullptr, told once, if it cannot be read.
  const recordings::Recording* recording_of(const RecordedInput& input) {
    const auto path = path_of(scenario_, input);
    const auto [known, fresh] = recordings_.try_emplace(path.string());
    auto& recording = known->second;
    if (!fresh) return recording ? &*recording : nullptr;
    const auto before = problems_.size();
    const auto place = scenario::named_at(scenario_, input.recording.place);
    const auto text = read_file(path, problems_, place);
    if (!text) return nullptr;
    const auto file = recordings::read_recording_text(*text, path, problems_);
    if (problems_.size() != before) return nullptr;
    auto bytes = read_file(file.export_path(), problems_,
                           {path.string(), file.file.place.line, file.file.place.column}, largest_export);
    if (!bytes) return nullptr;
    auto read = recordings::load(file, std::move(*bytes), problems_, notes_);
    if (problems_.size() != before) return nullptr;
    recording = std::move(read);
    return &*recording;
  }

  const recordings::Series* series_of(const RecordedInput& input, const recordings::Recording& recording) {
    std::vector<std::string> channels;
    for (const auto& series : recording.series) {
      if (series.channel == input.channel.text) return &series;
      channels.push_back(series.channel);
    }
    problem("input.no-channel"_code, input.channel.place,
            fmt::format("{} has no channel '{}'", input.recording.text, input.channel.text),
            did_you_mean(input.channel.text, channels));
    return nullptr;
  }

  bool fits(const RecordedInput& input, const recordings::Series& series, const Driven& driven) {
    const auto& name = input.name.text;
    const bool is_number = driven.unit.empty();
    if (is_number ? !series.unit.empty() : !scenario::same_dimension(series.unit, driven.unit)) {
      const auto what = [](const std::string& unit) {
        return unit.empty() ? std::string("a pure number")
                            : fmt::format("{} ({})", scenario::dimension_name(unit), unit);
      };
      problem("scenario.wrong-unit"_code, input.channel.place,
              fmt::format("{} is {}, the channel {} is {}", name, what(driven.unit), series.channel,
                          what(series.unit)),
              is_number ? "name another channel, or give its column in the recording's YAML the unit \"\""
                        : fmt::format("name another channel, or give its column in {}", driven.unit));
      return false;
    }
    const bool is_whole = driven.is_switch || (driven.range && driven.range->whole);
    if (is_whole && input.interpolate != RecordedInput::Between::hold) {
      problem("scenario.does-not-go-together"_code, input.name.place,
              fmt::format("{} {}: there is nothing between two samples", name,
                          driven.is_switch ? "is on or off" : "takes whole numbers"),
              "add interpolate: hold");
      return false;
    }
    return true;
  }

  /// Without the samples that could not be recorded. Empty, and told, if a value does not fit.
  Inputs::Source source_of(const RecordedInput& input, const recordings::Series& series, const Driven& driven,
                           double begin) {
    Inputs::Source source{driven.write, {}, {}, input.interpolate == RecordedInput::Between::hold};
    const auto usable = recordings::without_clipped(series);
    for (const double time : usable.time_s)
      source.times.push_back(static_cast<Time>(std::llround((time - begin) * second)));
    source.values = usable.value;
    if (source.times.empty())
      problem("recording.no-rows"_code, input.channel.place,
              fmt::format("{}: all of its samples are clipped", series.channel), "name another channel");
    else if (driven.range && !driven.is_switch && !keep_to_range(input, driven, source))
      return {};
    return source;
  }

  /// Noise and drift go a little beyond a limit: what is beyond is taken as the limit, and told. False if the
  /// values cannot be taken at all.
  bool keep_to_range(const RecordedInput& input, const Driven& driven, Inputs::Source& source) {
    const auto& range = *driven.range;
    const auto si = [&](double number) {
      return driven.unit.empty() ? number : scenario::to_si(number, driven.unit);
    };
    const double low = si(range.low);
    const double high = si(range.high);
    std::int64_t beyond = 0;
    std::string first;
    for (std::size_t i = 0; i < source.values.size(); ++i) {
      auto& value = source.values[i];
      const auto told = [&] {
        return fmt::format("{} at {:g} s",
                           driven.unit.empty()
                               ? fmt::format("{:g}", value)
                               : fmt::format("{:.6g} {}", scenario::from_si(value, driven.unit), driven.unit),
                           seconds(source.times[i]));
      };
      if (range.whole && value != std::round(value)) {
        problem("scenario.not-a-number"_code, input.channel.place,
                fmt::format("{} takes whole numbers, {} has {}", input.name.text, input.channel.text, told()),
                "give its column another unit, of or scale in the recording's YAML");
        return false;
      }
      if (value >= low && value <= high) continue;
      if (beyond++ == 0) first = told();
      value = std::clamp(value, low, high);
    }
    if (beyond > 0)
      notes_.emplace_back(
          "input.beyond-range"_code,
          fmt::format("{} takes {:g} to {:g}{}; {} of its recording beyond are taken as the "
                      "limit, the first one {}",
                      input.name.text, range.low, range.high, driven.unit.empty() ? "" : " " + driven.unit,
                      counted(beyond, "sample"), first));
    const auto [least, most] = std::ranges::minmax(source.values);
    for (const double extreme : {least, most}) {
      const auto objection = objection_to(scenario_, input.name.text, extreme);
      if (!objection) continue;
      problem(objection->code, input.channel.place, objection->what, objection->remedy);
      return false;
    }
    return true;
  }

  const scenario::Scenario& scenario_;
  const std::vector<NamedPlant>& plants_;
  Names& names_;
  Problems& problems_;
  std::vector<Finding>& notes_;
  std::map<std::string, std::optional<recordings::Recording>> recordings_;  ///< by the path of the YAML
};

Inputs::Inputs(const scenario::Scenario& scenario, const std::vector<NamedPlant>& plants, Names& names,
               Problems& problems, std::vector<Finding>& notes) {
  InputBinder(scenario, plants, names, problems, notes).bind(*this);
}

double Inputs::Source::at(Time now) {
  if (times[last] > now) last = 0;  // it came back to an earlier moment
  while (last + 1 < times.size() && times[last + 1] <= now) ++last;
  if (holds || last + 1 == times.size() || now <= times[last]) return values[last];
  const double share =
      static_cast<double>(now - times[last]) / static_cast<double>(times[last + 1] - times[last]);
  return values[last] + (values[last + 1] - values[last]) * share;
}

Time Inputs::Source::next(Time now) const {
  if (now < times.front()) return times.front();
  if (last + 1 == times.size()) return never;
  return holds ? times[last + 1] : now + 1;
}

void Inputs::work(Time now) {
  next_ = never;
  for (auto& source : sources_) {
    const double value = source.at(now);
    if (value != source.written) source.write(value);
    source.written = value;
    next_ = std::min(next_, source.next(now));
  }
}

void Inputs::visit(StateArchive& archive) {
  archive.each("sources_", sources_, [&](Source& source) { STATE(archive, source.written); });
  if (archive.restores()) next_ = 0;  // where it is follows from the time
}

}  // namespace drycut::sim::loop
