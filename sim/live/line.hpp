#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/live/inbox.hpp"
#include "sim/live/line_view.hpp"
#include "sim/live/session.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim::live {

// Machine seconds a second.
inline constexpr double least_pace = 1e-4;
inline constexpr double most_pace = 1e4;

/// How well the line keeps its pace, since it last began to run.
struct Punctuality {
  std::uint64_t cycles = 0;
  std::uint64_t late = 0;  ///< of them, by more than a millisecond
  double worst = 0;        ///< [s]
  double dropped = 0;      ///< machine was too slow: so much was not made good [s]
};

/// What became of a request.
struct Answer {
  Asker asker = 0;
  Problems problems = {};  ///< none: done
};

/// What the line tells, thirty times a second.
struct News : Sight {
  int run = 0;  ///< number of the run: each restart is another one
  Time time = 0;
  bool running = false;
  double pace = 1;
  std::string failure;      ///< the simulation itself cannot go on
  std::string record_lost;  ///< why the record has ended while the line goes on, "" = it has not
  Punctuality punctuality;
  std::vector<record::RecordedEvent> events;  ///< since the last news
  std::size_t events_left_out = 0;            ///< there were so many more
  struct Samples {
    std::shared_ptr<const std::vector<std::string>> names;  ///< in their order
    std::vector<Time> times;
    std::vector<double> rows;  ///< a row a time
  };
  Samples samples;                                    ///< since the last news
  std::optional<devices::ProgramPositions> programs;  ///< if anybody wants to know
  std::optional<record::Outcome> outcome;             ///< of the checks as if it ended now; twice a second
};

/// What was to be seen at a time that the run has behind it.
struct Seen : Sight {
  int run = 0;
  Time time = 0;
  std::vector<double> read;                           ///< the values that were asked for
  std::optional<devices::ProgramPositions> programs;  ///< if they were asked for
  record::Outcome outcome;                            ///< of the checks as if it had ended then
};

/// What there is to see and to set; of one run.
struct LineDescription {
  std::string process;  ///< another one each time that the program is started
  int run = 0;
  std::string title;
  std::string scenario;
  Time step = 0;
  Time duration = 0;
  struct Target {
    std::string name;
    std::string unit;
    std::optional<devices::ValueRange> range;
    bool of_panel = false;
    std::optional<bool> push = {};  ///< a switch of the panel: on while it is pressed, if the scenario says
    double used = 0;                ///< the largest amount that the scenario itself gives it, in `unit`
  };
  std::vector<Target> targets;     ///< switches of the panel, then settings of plants
  std::vector<std::string> lamps;  ///< of the panel
  struct Fault {
    std::string component;
    std::string name;
    std::string unit;
    std::string meaning;
    devices::ValueRange range;
  };
  std::vector<Fault> faults;
  struct Channel {
    std::string name;
    std::string unit;
    bool writable = false;
    std::optional<devices::ValueRange> range = {};  ///< of one that can be written
  };
  std::vector<Channel> channels;  ///< all that can be sampled
  struct Plant {
    std::string name;
    std::string type;
    std::string web;  ///< that it works on, "" = none
    bool cuts = false;
  };
  std::vector<Plant> plants;
  std::string controller;           ///< its kind: "qmove"; "" = none
  scenario::OpcuaSection opcua;     ///< as the scenario has it
  std::vector<std::string> parts;   ///< of the machine, in order of the poses
  std::string machine;              ///< they and their meshes as a .glb
  std::vector<std::string> checks;  ///< names
  std::vector<devices::ProgramText> programs;
  std::vector<std::string> notes;
};

/// A line that runs in real time in a thread of its own: the same loop as of `drycut run`, which is told what
/// to do and tells what it sees. All functions may be called from any thread.
class Line {
 public:
  struct Options {
    std::filesystem::path scenario;  ///< "" with a session
    std::vector<scenario::Override> set = {};
    /// A recorded session to go on from, in place of a scenario.
    struct From {
      std::filesystem::path session;  ///< its file
      std::optional<Time> at;         ///< absent = where it ended
    };
    std::optional<From> from = {};
    double pace = 1;                    ///< 0 = as fast as it goes
    bool running = true;                ///< from the beginning on
    std::filesystem::path record = {};  ///< folder of sessions, each run in a new one: 1, 2 ...; "" = none
  };
  /// Who is told what the line has to say, in its thread.
  struct Listener {
    std::function<void(std::shared_ptr<const News>)> news;
    std::function<void(std::shared_ptr<const LineDescription>)> described;  ///< of each run
    std::function<void(std::vector<Answer>)> answered;
  };

  /// Puts the scenario together; run() may be called if there are no problems.
  Line(Options options, Problems& problems);
  ~Line();
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  /// Runs until stop() is called, in the calling thread. Throws std::runtime_error if retentive values cannot
  /// be kept.
  void run(Listener listener);
  /// The present run: until run() is called, and in a Visit.
  [[nodiscard]] LineRun& present() { return *run_; }
  /// The folder of the present run's record, "" = none; once run() has returned.
  [[nodiscard]] const std::filesystem::path& record() const;
  /// Why the record of a run ended before it did, "" = none did; once run() has returned.
  [[nodiscard]] const std::string& record_lost() const { return record_lost_; }
  void stop() { inbox_.stop(); }
  /// False if the line is busy: too much of what was asked waits already, see Inbox.
  bool ask(Request request) { return inbox_.put(std::move(request)); }

 private:
  using Clock = std::chrono::steady_clock;

  /// Does what has been asked, as much as there is time for; false if the line is to stop.
  bool take_mail();
  void act_on(const Request& request);
  Problems keep_retentive(const char* asked);
  Problems restart();
  Problems go_on(Time from);
  /// Says which run it is now.
  void begin_again();
  void go(bool on);
  void cycle();
  /// It runs by the clock.
  [[nodiscard]] bool keeps_pace() const { return running_ && pace_ != 0 && !until_event_; }
  void keep_pace();
  void begin_pace();
  void await_cycle();
  void be_first(bool first);
  void tell();
  void tell_soon();
  void answer();
  void end_run();
  [[nodiscard]] Time cycle_time() const;

  Options options_;
  std::unique_ptr<LineRun> run_;
  Listener listener_;
  Inbox inbox_;
  bool running_ = false;
  double pace_ = 1;
  std::optional<Time> until_;               ///< stands still then
  std::optional<std::string> until_event_;  ///< or behind such an event
  Clock::time_point begun_;                 ///< where the pace is measured from
  Time begun_at_ = 0;
  Clock::time_point due_;  ///< the next cycle
  bool behind_ = false;    ///< the last one was late
  bool first_ = false;     ///< its thread goes before the others of the machine
  Clock::time_point next_news_;
  int news_ = 0;
  Punctuality punctuality_;
  std::vector<Answer> answers_;
  std::string record_lost_;
};

}  // namespace drycut::sim::live
