#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "sim/live/line.hpp"

namespace drycut::sim::live {

/// One run of a live line, from time zero: the simulation, its record, and what is seen of it.
class LineRun : public loop::Observer {
 public:
  /// May be used if there are no problems.
  LineRun(const Line::Options& options, int number, Problems& problems);

  /// Simulates up to where the session ended that it goes on from. Records all of the run in a new folder in
  /// `folder`, which has the next number, unless that is "". Gives up as soon as `stopped`. Throws
  /// std::runtime_error.
  void begin(const std::filesystem::path& folder, const std::atomic<bool>& stopped);
  /// Retentive values are in their file, for who begins next. Throws std::runtime_error.
  void keep_retentive() const;
  /// All that was recorded is in its files, and retentive values in theirs. Throws std::runtime_error.
  void end();
  /// The folder of the record, "" = none.
  [[nodiscard]] const std::filesystem::path& record() const { return record_; }

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] Time now() const { return simulation_->time(); }
  [[nodiscard]] Time step() const { return scenario_.scene.step; }
  [[nodiscard]] const std::string& failure() const { return simulation_->failure(); }
  /// One step; false if the simulation itself failed.
  bool advance();
  /// Does something to the line, before the next step.
  Problems act(const std::string& text);
  Problems act(const scenario::Stimulus& stimulus);
  [[nodiscard]] loop::Simulation& simulation() { return *simulation_; }

  void happened(const loop::RecordedEvent& event) override;
  /// From now on seen() tells whether such an event has happened; "" = any. A problem if nothing reports it.
  Problems await(const std::string& event);
  [[nodiscard]] bool seen() const { return seen_; }

  /// Has an asker's channels sampled by take_samples(), and the programs watched if it wants that.
  Problems want(Asker asker, const Sample& sample);
  void leave(Asker asker);
  [[nodiscard]] const std::map<Asker, Sample>& wanted() const { return wanted_; }
  void take_samples();
  /// The values of these channels now, in their units; none after a problem.
  Problems values_of(const std::vector<std::string>& names, std::vector<double>& values);

  /// What is to be seen now, and what has come since it was told last.
  void tell(News& news);
  [[nodiscard]] loop::Outcome outcome() { return simulation_->outcome(); }
  std::shared_ptr<const LineDescription> describe();

 private:
  void record_in(const std::filesystem::path& folder);
  void choose_samples();
  void watch_programs();
  [[nodiscard]] double largest_used(const loop::Target& target) const;
  [[nodiscard]] std::optional<bool> is_push_button(const loop::Target& target) const;
  [[nodiscard]] double usual_of(const loop::Target& target) const;
  void describe_programs(LineDescription& told);

  Replay replay_;  ///< of nothing, unless it goes on from a session
  std::vector<std::string> notes_;
  scenario::Scenario& scenario_ = replay_.scenario;
  int number_;
  std::vector<std::string> parts_;
  std::string machine_;
  std::unique_ptr<loop::Simulation> simulation_;
  std::filesystem::path record_;
  std::optional<SessionFile> session_;
  Time next_reached_ = 0;
  std::vector<plants::Part> shown_;
  std::vector<loop::Target> targets_;  ///< what an operator sets: switches of the panel, settings of plants
  std::vector<loop::Reading> lamps_;
  std::vector<loop::RecordedEvent> events_;
  std::optional<std::string> awaited_;
  bool seen_ = false;
  std::map<Asker, Sample> wanted_;
  bool programs_wanted_ = false;
  std::vector<loop::Reading> readings_;
  std::unordered_map<std::string, std::function<double()>> known_;  ///< what values_of() has looked up
  std::shared_ptr<const std::vector<std::string>> sample_names_;
  News::Samples samples_;
};

}  // namespace drycut::sim::live
