#pragma once
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/live/line.hpp"
#include "sim/live/line_view.hpp"
#include "sim/live/past.hpp"
#include "sim/live/record.hpp"

namespace drycut::sim::live {

/// One run of a live line, from time zero: the simulation, its record, and what is seen of it.
class LineRun : public record::Observer {
 public:
  /// May be used if there are no problems.
  LineRun(const Line::Options& options, Problems& problems);
  /// The next one of the same line; with the machine of `before` if nothing of the scenario has changed, for
  /// to make that takes ten times as long as all the rest.
  LineRun(const Line::Options& options, const LineRun& before, Problems& problems);

  /// Comes to where the session ended that it goes on from, by a moment that it kept or from zero. Records
  /// all of the run in a new folder in `folder`, which has the next number, unless that is "". Gives up as
  /// soon as the line is to stop.
  void begin(const std::filesystem::path& folder, const Inbox& inbox);
  /// Retentive values are in their file, for who begins next. Throws std::runtime_error.
  void keep_retentive() const;
  /// All that was recorded is in its files, and retentive values in theirs; nobody is told of the past any
  /// more. Throws std::runtime_error.
  void end();

  /// Has it told what was to be seen at a time before now.
  void look(Asker asker, Look look);
  /// Makes ready for go_on(); after a problem there is nothing to go on from.
  Problems come_back(Time from);
  /// Once this one has ended: it is the next run, which has come to that time and has a record of its own in
  /// `folder`, with all that was before.
  void go_on(Time from, const std::filesystem::path& folder, const Inbox& inbox);

  /// The folder of the record, "" = none.
  [[nodiscard]] const std::filesystem::path& record() const;
  /// Why the record has ended before the run, "" = it has not.
  [[nodiscard]] const std::string& record_lost() const;

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] Time now() const { return view_->now(); }
  [[nodiscard]] Time step() const { return scenario_.scene.step; }
  [[nodiscard]] const std::string& failure() const { return view_->simulation().failure(); }
  /// One step; false if the simulation itself failed.
  bool advance();
  /// Does something to the line, before the next step.
  Problems act(const std::string& text);
  Problems act(const scenario::Stimulus& stimulus);
  [[nodiscard]] loop::Simulation& simulation() { return view_->simulation(); }

  void happened(const record::RecordedEvent& event) override;
  /// From now on seen() tells whether such an event has happened; "" = any. A problem if nothing reports it.
  Problems await(const std::string& event);
  [[nodiscard]] bool seen() const { return seen_; }

  /// Has an asker's channels sampled by take_samples(), and the programs watched if it wants that.
  Problems want(Asker asker, const Sample& sample);
  void leave(Asker asker);
  [[nodiscard]] const std::map<Asker, Sample>& wanted() const { return wanted_; }
  void take_samples();
  /// The values of these channels now, in their units; none after a problem.
  Problems values_of(const std::vector<std::string>& names, std::vector<double>& values) {
    return view_->values_of(names, values);
  }

  /// What is to be seen now, and what has come since it was told last.
  void tell(News& news);
  [[nodiscard]] record::Outcome outcome() { return view_->simulation().outcome(); }
  std::shared_ptr<const LineDescription> describe();

 private:
  LineRun(const Line::Options& options, const LineRun* before, Problems& problems);
  [[nodiscard]] bool looks_like(const LineRun& other) const;
  void choose_samples();
  void count(const std::vector<std::string>& names, int by);
  [[nodiscard]] bool is_of_this(const Moment& moment) const;
  void come_to(const Moment& moment);
  void do_again(const Inbox& inbox);
  void begin_record(const std::filesystem::path& folder, const Moment* from);
  void keep_moment();
  [[nodiscard]] Problems not_there_yet(Time time, const char* asked) const;
  void watch_programs();
  [[nodiscard]] double largest_used(const loop::Target& target) const;
  [[nodiscard]] std::optional<bool> is_push_button(const loop::Target& target) const;
  [[nodiscard]] double usual_of(const loop::Target& target) const;
  void describe_programs(LineDescription& told);

  // What was done before where it is gone on from: those from `again_` on are to be done again.
  std::vector<scenario::Stimulus> acts_;
  std::vector<Finding> notes_;  ///< of how it was read
  Replay replay_;               ///< of nothing, unless it goes on from a session; reading it fills those
  std::size_t again_ = 0;
  Time again_until_ = 0;
  std::filesystem::path session_;  ///< where that is recorded, "" = nowhere
  scenario::Scenario& scenario_ = replay_.scenario;
  int number_;
  std::vector<std::string> parts_;
  std::string machine_;
  std::unique_ptr<SessionRecord> record_;  ///< looks at the simulation
  std::unique_ptr<LineView> view_;
  std::unique_ptr<Past> past_;
  Moment from_;  ///< that come_back() found
  Time next_reached_ = 0;
  // What has happened since it was told last, the latest of it.
  std::deque<record::RecordedEvent> done_;    ///< by the timeline
  std::deque<record::RecordedEvent> events_;  ///< the others
  std::size_t events_left_out_ = 0;
  std::optional<std::string> awaited_;
  bool seen_ = false;
  std::map<Asker, Sample> wanted_;
  std::map<std::string, int> wanted_names_;               ///< by how many askers
  bool chosen_anew_ = false;                              ///< not sampled so yet
  std::vector<const std::function<double()>*> readings_;  ///< of `sample_names_`
  std::shared_ptr<const std::vector<std::string>> sample_names_;
  News::Samples samples_;
};

}  // namespace drycut::sim::live
