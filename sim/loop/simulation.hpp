#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "plants/plant.hpp"
#include "plants/world.hpp"
#include "sim/loop/bus.hpp"
#include "sim/loop/cam_doubt.hpp"
#include "sim/loop/causes.hpp"
#include "sim/loop/state_bytes.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

class CamRecorder;
struct Captions;
class Checks;
class Directions;
class Disturbances;
class Inputs;
class Links;
class DriveJudge;
class Hunting;
struct KnownEvent;
class Names;
struct OpenTerminals;
struct Reading;
class Remarks;
class Shutter;
struct Snapshot;
class Standing;
struct Strobe;
class Timeline;
class Unasked;
class Watch;
class Whereabouts;

/// A scenario put together: controller, plants, wires, stimuli, checks; then run. One object is one run,
/// always from time zero in a fresh world.
class Simulation {
 public:
  /// Puts `scenario` together. Everything that does not fit is reported in `problems`; run() may be called
  /// only if there are none. `scenario` must outlive the simulation.
  Simulation(const scenario::Scenario& scenario, Problems& problems);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Writes trace.csv and events.csv, here and while it runs; before run().
  void write_to(const std::filesystem::path& trace, const std::filesystem::path& events);
  /// The same into any other files; `folder` has room for what waits for pictures of the run.
  void write_to(std::unique_ptr<record::Observer> files, const std::filesystem::path& folder);
  /// Keeps nothing for pictures of the run: no rows, no events, no poses. Before run().
  void keep_nothing();
  /// Keeps what the controller's cams play, for pictures of it; before run(). What `judge` has against them
  /// is part of the outcome.
  void follow_cams(CamJudge judge = {}, bool keeps_samples = true);
  /// What was kept; nullptr if nothing was asked for.
  [[nodiscard]] const CamRecorder* cams() const { return cams_.get(); }

  /// Ends it where it is, as a failure of its own; while it runs, of `progress`.
  void stop(const std::string& why) {
    if (failure_.empty()) failure_ = why;
  }

  /// Has `keep` called every so often while it runs; before run(). `plain`: it draws nothing, which states
  /// say.
  void keep_states(Time every, bool plain, std::function<void()> keep) {
    keep_every_ = every;
    keep_plain_ = plain;
    keep_ = std::move(keep);
  }

  /// Runs to the end of the scenario. `progress` is told the simulated time now and then.
  record::Outcome run(const std::function<void(Time)>& progress = {});

  // For whoever works at the machine while it runs, in place of run().
  /// What is recorded of time zero; advance() does it else.
  void begin() {
    if (time_ > 0 || next_record_ > 0) return;
    for (auto* observer : steppers_) observer->stepped(time_);
    record();
  }
  /// One step; false if the simulation itself failed, now or before.
  bool advance() {
    begin();
    if (failure_.empty()) step();
    return failure_.empty();
  }
  /// Adds an observer, which must outlive the simulation. It hears of what happens from now on.
  void add(record::Observer& observer) { observers_.push_back(&observer); }
  /// Tells one more every step, which costs time in each; before the first one. It outlives the simulation.
  void tell_steps(record::Observer& observer) { steppers_.push_back(&observer); }
  /// Takes an entry of the timeline more, before the step at which it is due: at() in the future, or now. The
  /// run is the same as if it had stood behind the scenario's own. False, and nothing taken, if it does not
  /// fit.
  bool act(const scenario::Stimulus& stimulus, Problems& problems);
  // Any moment again.
  /// All that has changed since time zero.
  void visit(StateArchive& archive);
  /// The moment as it is now, to be kept anywhere. `journal`: rows, events, poses of pictures and samples of
  /// cams go there, those that are not in it yet.
  [[nodiscard]] StateArchive::Bytes save(StateArchive::Journal* journal = nullptr);
  /// Comes back to such a moment of this scenario and build, or of a scenario with other values if `others`
  /// is set; this simulation may have come to any other moment. What was recorded until then comes back from
  /// the journal, into the files too. Throws BadState, and has changed nothing, if the bytes are no such
  /// state; if the scenario is another, it may have changed.
  void restore(std::span<const std::byte> state, std::span<const std::byte> journal = {},
               bool others = false);

  /// What came of the run, if it ended now.
  [[nodiscard]] record::Outcome outcome();
  [[nodiscard]] Time time() const { return time_; }
  [[nodiscard]] const std::string& failure() const { return failure_; }
  [[nodiscard]] Bus& bus() { return bus_; }
  [[nodiscard]] Names& names() { return *names_; }
  /// Sampling time of what drives the analogue output; 0 if nothing does.
  [[nodiscard]] Time output_period(const devices::Address& analogue) const {
    return controller_ ? controller_->output_period(analogue) : 0;
  }

  /// Nullptr if the scenario has none.
  [[nodiscard]] const devices::Controller* controller() const { return controller_.get(); }
  [[nodiscard]] devices::Controller* controller() { return controller_.get(); }

  /// What a reader should know that is no fault: terminals that are declared only, how the controller is set
  /// up, remarks of it during the run.
  [[nodiscard]] std::vector<Finding> notes() const;
  /// Those of them that are known before the run: how the controller is set up.
  [[nodiscard]] const std::vector<Finding>& notes_of_setup() const { return notes_of_setup_; }
  /// What may be a slip: wires that nothing works or that are missing. Known before the run, and part of its
  /// outcome.
  [[nodiscard]] const std::vector<Finding>& warnings() const { return warnings_; }
  /// The controller's values as they are now, by name, with units; rows of cam tables only where they are not
  /// 0.
  [[nodiscard]] std::vector<Reading> controller_values();
  /// The controller's retentive values as they are now, as text.
  [[nodiscard]] std::string retentive_state() const {
    return controller_ ? controller_->retentive_state() : "";
  }
  [[nodiscard]] const record::Recording& recording() const { return recording_; }
  /// The same, given away after run().
  [[nodiscard]] record::Recording take_recording() { return std::move(recording_); }
  [[nodiscard]] const std::vector<Snapshot>& snapshots() const;
  /// What turned too far from the frame before to be seen as it turns, a frame each.
  [[nodiscard]] std::vector<std::optional<Strobe>> strobes() const;
  /// When the event happened that the frames are about [s]; absent if they are about none.
  [[nodiscard]] std::optional<double> frames_event() const;
  [[nodiscard]] const std::vector<NamedPlant>& plants() const { return named_; }
  /// Units of the caption channels.
  [[nodiscard]] const std::vector<std::string>& caption_units() const;
  /// Events that the plants can report.
  [[nodiscard]] const std::vector<KnownEvent>& known_events() const { return known_events_; }
  /// With those of timeline and controller.
  [[nodiscard]] const std::vector<KnownEvent>& all_events() const { return all_events_; }

 private:
  void load_controller(Problems& problems);
  void build_plants(Problems& problems);
  void check_periods(Problems& problems) const;
  void delay_outputs(Problems& problems);
  void check_panel(Problems& problems) const;

  void compare_with_machine();
  void look_after_program();
  /// What the run knows besides of why it failed by `until` [s].
  [[nodiscard]] Causes::Known known(const CamJudgement& cams, double until);
  /// Of the parameters that the program has set.
  [[nodiscard]] std::vector<Finding> contradicting_parameters() const;
  /// What may be a slip in a run that was sound else: tasks that ended at once, values set in vain.
  void warn_of_program(std::vector<Finding>& warnings);
  /// Switches that nobody pressed.
  [[nodiscard]] std::string unpressed() const;
  [[nodiscard]] std::optional<Finding> line_of_grip() const;
  [[nodiscard]] std::optional<std::pair<double, Finding>> search_that_met_a_stop() const;

  [[nodiscard]] const StateArchive::Bytes& begun_state() const;
  void tell_files();
  void run_to_end(const std::function<void(Time)>& progress);
  void step();
  void add_share(record::RecordedEvent& event) const;
  [[nodiscard]] bool has_events() const;
  void collect_events();
  void record();
  void snapshot();

  const scenario::Scenario& scenario_;
  Time step_;
  double h_;  ///< [s]
  Time time_ = 0;

  std::unique_ptr<devices::Controller> controller_;
  plants::World world_;
  std::vector<std::unique_ptr<plants::Plant>> plants_;
  std::vector<NamedPlant> named_;
  Bus bus_;
  std::unique_ptr<Names> names_;
  std::unique_ptr<Watch> watch_;
  std::unique_ptr<Disturbances> disturbances_;  ///< nullptr without any
  std::unique_ptr<Inputs> inputs_;              ///< likewise
  std::unique_ptr<Links> links_;                ///< nullptr without any
  std::unique_ptr<Timeline> timeline_;
  std::unique_ptr<Checks> checks_;
  std::unique_ptr<DriveJudge> drives_;
  std::unique_ptr<Unasked> unasked_;
  record::Recording recording_;
  std::unique_ptr<record::Observer> files_;
  std::unique_ptr<CamRecorder> cams_;
  CamJudge judge_cams_;
  std::size_t events_seen_ = 0;
  Time next_record_ = 0;
  Time keep_every_ = never;
  bool keep_plain_ = false;
  std::function<void()> keep_;
  std::unique_ptr<Shutter> shutter_;
  std::vector<plants::Part> parts_;  ///< of all plants, from the first shot on
  std::unique_ptr<Captions> captions_;
  std::unique_ptr<Remarks> remarks_;
  Causes causes_;
  // Nullptr without a controller.
  std::unique_ptr<Directions> directions_;
  std::unique_ptr<Hunting> hunting_;
  std::unique_ptr<Standing> standing_;
  std::unique_ptr<Whereabouts> whereabouts_;
  std::vector<record::Observer*> observers_;  ///< all of them, in the order in which they are told
  std::vector<record::Observer*> steppers_;   ///< those that are told every step
  std::vector<KnownEvent> known_events_;      ///< of the plants
  std::vector<KnownEvent> all_events_;        ///< with those of timeline and controller
  std::string failure_;
  std::vector<Finding> notes_of_setup_;
  std::unique_ptr<OpenTerminals> open_;
  std::vector<Finding> doubts_of_program_;
  std::vector<Finding> warnings_;
  std::vector<Finding> contradictions_;      ///< of controller and machine; among those notes too
  mutable StateArchive::Bytes begun_state_;  ///< how all its states begin, once that was asked for
  std::size_t state_size_ = 0;               ///< of the last one
  std::string program_error_;                ///< first run-time error of the controller's program
};

}  // namespace drycut::sim::loop
