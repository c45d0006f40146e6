#include "sim/live/line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "renders/gltf.hpp"
#include "sim/file.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/report/film.hpp"
#include "sim/report/results.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::live {

namespace fs = std::filesystem;

namespace {

constexpr auto between_news = std::chrono::milliseconds(33);
constexpr auto not_made_good = std::chrono::milliseconds(200);  ///< who is so late begins anew
constexpr int news_an_outcome = 15;
constexpr std::size_t most_channels = 64;  ///< of an asker

std::string read_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

/// A folder that goes again.
struct PassingFolder {
  PassingFolder() {
    auto name = (fs::temp_directory_path() / "drycut-live-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder in " + name);
    path = name;
  }
  ~PassingFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  fs::path path;
};

/// The machine as a .glb: its first frame, with all that may ever be seen.
std::string machine_of(scenario::Scenario scenario, std::vector<std::string>& parts, Problems& problems) {
  auto& pictures = scenario.pictures;
  pictures.frames = true;
  pictures.from = 0;
  pictures.until.reset();
  pictures.around.reset();
  pictures.every = scenario.scene.step;
  pictures.slow = 1;
  pictures.live.clear();
  scenario.record.channels.clear();
  loop::Simulation simulation(scenario, problems);
  const auto meshes = report::load_part_meshes(scenario, simulation.plants(), problems);
  if (!problems.empty()) return "";
  simulation.advance();
  auto film = report::film_of(scenario, simulation, meshes);
  for (const auto& part : film.parts) parts.push_back(part.name);
  if (film.frames.empty() || film.parts.empty()) return "";
  for (auto& placement : film.frames.front().placements) placement.visible = true;
  const PassingFolder folder;
  renders::write_gltf(film, folder.path / "machine.glb");
  return read_bytes(folder.path / "machine.glb");
}

}  // namespace

/// One run of the line, from time zero.
class Line::OneRun : public loop::Observer {
 public:
  OneRun(const Options& options, int number, Problems& problems)
      : scenario_(read(options, problems)), number_(number) {
    if (!problems.empty()) return;
    machine_ = machine_of(read(options, problems), parts_, problems);
    if (!problems.empty()) return;
    fingerprint_ = fingerprint_of(scenario_);
    scenario_.pictures = {};
    simulation_ = std::make_unique<loop::Simulation>(scenario_, problems);
    if (!problems.empty()) return;
    simulation_->keep_nothing();
    simulation_->tell(*this);
    for (const auto& [name, plant] : simulation_->plants())
      for (auto& part : plant->parts()) shown_.push_back(std::move(part));
  }

  /// Records the run in a folder of its own. Throws std::runtime_error.
  void record_in(const fs::path& folder) {
    fs::create_directories(folder);
    session_.emplace(folder / session_file, scenario_, fingerprint_);
    simulation_->write_to(folder / report::trace_file, folder / report::events_file);
  }

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] Time now() const { return simulation_->time(); }
  [[nodiscard]] Time step() const { return scenario_.scene.step; }
  [[nodiscard]] const std::string& failure() const { return simulation_->failure(); }
  bool advance() {
    const bool sound = simulation_->advance();
    if (session_ && now() >= next_reached_) {
      session_->reached(now());
      next_reached_ = (now() / second + 1) * second;
    }
    return sound;
  }
  void finish_record() {
    if (!session_) return;
    session_->reached(now());
    simulation_->flush();
  }

  Problems act(const std::string& text) {
    Problems problems;
    const auto stimulus = read_act(text, "act", now(), problems);
    if (stimulus && simulation_->act(*stimulus, problems) && session_) session_->add(*stimulus);
    for (auto& problem : problems) problem.file = "act";
    return problems;
  }

  void happened(const loop::RecordedEvent& event) override {
    events_.push_back(event);
    if (awaited_ && loop::names_event(*awaited_, event.source, event.event)) seen_ = true;
    if (awaited_ && awaited_->empty()) seen_ = true;
  }
  void await(const std::string& event) {
    awaited_ = event;
    seen_ = false;
  }
  [[nodiscard]] bool seen() const { return seen_; }

  Problems want(Asker asker, const std::vector<std::string>& names) {
    Problems problems;
    if (names.size() > most_channels)
      problems.push_back({"sample", 1, 1, fmt::format("{} channels", names.size()),
                          fmt::format("{} at most", most_channels)});
    for (const auto& name : names) {
      if (problems.size() < most_channels && !simulation_->names().reading(name))
        problems.push_back({"sample", 1, 1, fmt::format("there is no channel '{}'", name),
                            simulation_->names().suggest_reading(name)});
    }
    if (!problems.empty()) return problems;
    wanted_[asker] = names;
    choose_samples();
    return {};
  }
  void leave(Asker asker) {
    if (wanted_.erase(asker) > 0) choose_samples();
  }
  [[nodiscard]] const std::map<Asker, std::vector<std::string>>& wanted() const { return wanted_; }

  void take_samples() {
    if (readings_.empty()) return;
    samples_.times.push_back(now());
    for (const auto& reading : readings_) samples_.rows.push_back(reading.read());
  }

  void tell(News& news) {
    news.run = number_;
    news.time = now();
    news.failure = failure();
    news.poses.reserve(shown_.size());
    for (const auto& part : shown_) news.poses.push_back(part.now());
    for (const auto& target : targets()) news.values.push_back(scenario::from_si(target.read(), target.unit));
    for (const auto& lamp : lamps_) news.lamps.push_back(lamp.read());
    news.events = std::exchange(events_, {});
    news.samples = std::exchange(samples_, {sample_names_, {}, {}});
  }
  [[nodiscard]] loop::Outcome outcome() { return simulation_->outcome(); }

  std::shared_ptr<const LineDescription> describe() {
    auto told = std::make_shared<LineDescription>();
    told->run = number_;
    told->title = scenario_.scene.title;
    told->scenario = scenario_.file.filename().string();
    told->step = scenario_.scene.step;
    told->duration = scenario_.scene.duration;
    auto& names = simulation_->names();
    for (const auto& target : targets())
      told->targets.push_back({target.name, target.unit, target.range, target.name.starts_with("panel.")});
    for (const auto& lamp : lamps_) told->lamps.push_back(lamp.name);
    for (const auto& [component, fault] : names.faults())
      told->faults.push_back(
          {component, fault.name, std::string(fault.unit), fault.meaning, loop::range_of(fault.range)});
    for (const auto& name : names.reading_names()) {
      if (const auto reading = names.reading(name))
        told->channels.push_back({name, reading->unit, names.target(name).has_value()});
    }
    told->parts = parts_;
    told->machine = machine_;
    for (const auto& check : simulation_->outcome().checks) told->checks.push_back(check.name);
    told->notes = simulation_->notes();
    return told;
  }

 private:
  static scenario::Scenario read(const Options& options, Problems& problems) {
    return scenario::read_scenario(options.scenario, options.set, problems);
  }

  /// What an operator sets, and sees at once: switches of the panel and settings of the plants.
  const std::vector<loop::Target>& targets() {
    if (!targets_.empty() || !lamps_.empty()) return targets_;
    auto& names = simulation_->names();
    for (const auto& name : names.setting_names())
      if (auto target = names.target(name)) targets_.push_back(std::move(*target));
    for (const auto& name : names.lamp_names())
      if (auto lamp = names.reading(name)) lamps_.push_back(std::move(*lamp));
    return targets_;
  }

  void choose_samples() {
    auto names = std::make_shared<std::vector<std::string>>();
    for (const auto& [asker, own] : wanted_)
      for (const auto& name : own)
        if (std::find(names->begin(), names->end(), name) == names->end()) names->push_back(name);
    readings_.clear();
    for (const auto& name : *names) readings_.push_back(simulation_->names().reading(name).value());
    sample_names_ = std::move(names);
    samples_ = {sample_names_, {}, {}};
  }

  scenario::Scenario scenario_;
  int number_;
  std::uint64_t fingerprint_ = 0;
  std::vector<std::string> parts_;
  std::string machine_;
  std::unique_ptr<loop::Simulation> simulation_;
  std::optional<SessionFile> session_;
  Time next_reached_ = 0;
  std::vector<plants::Part> shown_;
  std::vector<loop::Target> targets_;
  std::vector<loop::Reading> lamps_;
  std::vector<loop::RecordedEvent> events_;
  std::optional<std::string> awaited_;
  bool seen_ = false;
  std::map<Asker, std::vector<std::string>> wanted_;
  std::vector<loop::Reading> readings_;
  std::shared_ptr<const std::vector<std::string>> sample_names_;
  News::Samples samples_;
};

Line::Line(Options options, Problems& problems)
    : options_(std::move(options)), running_(options_.running), pace_(options_.pace) {
  run_ = std::make_unique<OneRun>(options_, 1, problems);
}

Line::~Line() = default;

void Line::stop() {
  const std::lock_guard lock(inbox_.mutex);
  inbox_.stopped = true;
  has_mail_ = true;
  inbox_.changed.notify_all();
}

void Line::ask(Request request) {
  const std::lock_guard lock(inbox_.mutex);
  inbox_.requests.push_back(std::move(request));
  has_mail_ = true;
  inbox_.changed.notify_all();
}

void Line::run(const Listener& listener, const Describe& describe) {
  listener_ = listener;
  describe_ = describe;
  if (!options_.record.empty()) run_->record_in(options_.record / "1");
  describe_(run_->describe());
  begin_pace();
  next_news_ = Clock::now();
  while (take_mail()) {
    if (running_ && run_->failure().empty()) {
      cycle();
      keep_pace();
    } else {
      wait_for_mail();
    }
    if (Clock::now() >= next_news_) tell();
  }
  tell();
  run_->finish_record();
}

bool Line::take_mail() {
  if (!has_mail_.exchange(false)) return true;
  std::deque<Request> mail;
  {
    const std::lock_guard lock(inbox_.mutex);
    if (inbox_.stopped) return false;
    mail.swap(inbox_.requests);
  }
  for (const auto& request : mail) act_on(request);
  return true;
}

void Line::wait_for_mail() {
  std::unique_lock lock(inbox_.mutex);
  inbox_.changed.wait_until(lock, next_news_, [this] { return has_mail_.load(); });
}

void Line::act_on(const Request& request) {
  Problems problems;
  const auto& what = request.what;
  if (const auto* done = std::get_if<Act>(&what)) {
    problems = run_->act(done->text);
  } else if (const auto* on = std::get_if<Go>(&what)) {
    until_.reset();
    until_event_.reset();
    go(on->on);
  } else if (const auto* advance = std::get_if<Advance>(&what)) {
    until_event_.reset();
    until_ = run_->now() + std::max(run_->step(), advance->by);
    go(true);
  } else if (const auto* event = std::get_if<UntilEvent>(&what)) {
    until_.reset();
    until_event_ = event->name;
    run_->await(event->name);
    go(true);
  } else if (const auto* pace = std::get_if<Pace>(&what)) {
    pace_ = pace->value;
    begin_pace();
  } else if (std::holds_alternative<Restart>(what)) {
    problems = restart();
  } else if (const auto* sampled = std::get_if<Sample>(&what)) {
    problems = run_->want(request.asker, sampled->names);
  } else {
    run_->leave(request.asker);
    return;
  }
  if (request.asker != 0) answers_.push_back({request.asker, std::move(problems)});
  next_news_ = Clock::now();
}

void Line::go(bool on) {
  running_ = on;
  begin_pace();
}

Problems Line::restart() {
  Problems problems;
  auto fresh = std::make_unique<OneRun>(options_, run_->number() + 1, problems);
  if (!problems.empty()) return problems;
  run_->finish_record();
  for (const auto& [asker, names] : run_->wanted()) fresh->want(asker, names);
  run_ = std::move(fresh);
  if (!options_.record.empty()) run_->record_in(options_.record / std::to_string(run_->number()));
  until_.reset();
  until_event_.reset();
  describe_(run_->describe());
  begin_pace();
  return {};
}

Time Line::cycle_time() const {
  constexpr Time at_full_speed = 10 * millisecond;
  const auto fitting =
      pace_ == 0 ? at_full_speed
                 : static_cast<Time>(std::llround(static_cast<double>(millisecond) * std::max(1.0, pace_)));
  const Time step = run_->step();
  return std::max(step, fitting / step * step);
}

void Line::cycle() {
  auto end = run_->now() + cycle_time();
  if (until_) end = std::min(end, *until_);
  bool sound = true;
  while (sound && run_->now() < end && !(until_event_ && run_->seen())) sound = run_->advance();
  run_->take_samples();
  const bool there = (until_ && run_->now() >= *until_) || (until_event_ && run_->seen());
  if (sound && !there) return;
  until_.reset();
  until_event_.reset();
  running_ = false;
  next_news_ = Clock::now();
}

void Line::begin_pace() {
  begun_ = Clock::now();
  begun_at_ = run_->now();
  punctuality_ = {};
}

void Line::keep_pace() {
  if (pace_ == 0 || until_event_ || !running_) return;
  const auto due = begun_ + std::chrono::nanoseconds(static_cast<std::int64_t>(
                                static_cast<double>(run_->now() - begun_at_) / pace_));
  const auto late = Clock::now() - due;
  ++punctuality_.cycles;
  if (late > std::chrono::milliseconds(1)) ++punctuality_.late;
  punctuality_.worst = std::max(punctuality_.worst, std::chrono::duration<double>(late).count());
  if (late > not_made_good) {
    punctuality_.dropped += std::chrono::duration<double>(late).count();
    begun_ += late;
    return;
  }
  // A request wakes it, but waits for the next cycle: the line goes by its clock.
  if (late < std::chrono::nanoseconds(0)) std::this_thread::sleep_until(due);
}

void Line::tell() {
  auto news = std::make_shared<News>();
  if (!running_) run_->take_samples();  // what was written is seen
  run_->tell(*news);
  news->running = running_;
  news->pace = pace_;
  news->punctuality = punctuality_;
  news->answers = std::exchange(answers_, {});
  if (news_++ % news_an_outcome == 0 || !running_) news->outcome = run_->outcome();
  listener_(std::move(news));
  next_news_ = Clock::now() + between_news;
}

}  // namespace drycut::sim::live
