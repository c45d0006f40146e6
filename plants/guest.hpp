#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "plants/plant.hpp"

namespace drycut::plants {

/// A variable of a model that others have written.
struct GuestVariable {
  enum class Role : std::uint8_t { input, output, parameter };
  enum class Type : std::uint8_t { real, whole, flag, word };
  std::string name;
  std::string meaning;
  Role role = Role::output;
  Type type = Type::real;
  /// Of what is recorded and set; "" = pure number. A number of the model is in the unit after
  /// number * factor + offset, which in SI is number * si_factor + si_offset.
  std::string unit = {};
  bool is_voltage = false;
  double factor = 1;
  double offset = 0;
  double si_factor = 1;
  double si_offset = 0;
  double start = 0;             ///< the model's own number
  std::string start_word = {};  ///< of a word
  double min = -1e300;          ///< in `unit`
  double max = 1e300;

  [[nodiscard]] double in_unit(double number) const { return number * factor + offset; }
  [[nodiscard]] double in_si(double number) const { return number * si_factor + si_offset; }
  [[nodiscard]] double from_si(double si) const { return (si - si_offset) / si_factor; }
};

/// A running one. Whatever goes wrong with it throws std::exception with a sentence.
class GuestModel {
 public:
  GuestModel() = default;
  virtual ~GuestModel() = default;
  GuestModel(const GuestModel&) = delete;
  GuestModel& operator=(const GuestModel&) = delete;

  /// Begins the step from `at` by `size` [s] with these inputs, and does not wait for its end.
  virtual void begin_step(double at, double size, std::span<const double> inputs) = 0;
  /// Waits for it, and takes the outputs.
  virtual void end_step(std::span<double> outputs) = 0;
  /// Between two steps, of a model that keeps its state.
  virtual std::vector<std::byte> save() = 0;
  virtual void restore(std::span<const std::byte> state) = 0;
};

/// What a model says of itself. Who can read and start one is not known here.
class GuestType {
 public:
  GuestType() = default;
  virtual ~GuestType() = default;
  GuestType(const GuestType&) = delete;
  GuestType& operator=(const GuestType&) = delete;

  /// "FMI 2.0, model Drive, by Dymola"
  [[nodiscard]] virtual const std::string& origin() const = 0;
  [[nodiscard]] virtual const std::vector<GuestVariable>& variables() const = 0;
  [[nodiscard]] virtual bool keeps_state() const = 0;
  /// Its steps must be whole multiples of this [s]; 0 = they may have any length.
  [[nodiscard]] virtual double fixed_step() const = 0;

  struct Start {
    /// Parameters that are not as the model has them, by their places among the variables: a number of the
    /// model's own, or a word.
    std::vector<std::pair<std::size_t, std::variant<double, std::string>>> parameters;
    double time_limit = 0;  ///< for each answer [s]
    int memory_limit = 0;   ///< [MB]
  };
  /// A model that has begun, and its outputs at time zero. Throws std::exception with a sentence.
  virtual std::unique_ptr<GuestModel> start(const Start& start, std::span<double> outputs) const = 0;
};

/// A foreign model in a line: a drive, a load, a controller. Inputs are held over each of its steps, and its
/// outputs are seen from the end of the step on.
///
/// An input is a setting; one in volts or without a unit is a reference as well, a switch a command, a whole
/// number a count of pulses. An output is a channel; a switch is a signal as well, a number without a unit
/// an encoder. A switch X with the outputs X.rises and X.rise_time [s] beside it shows edges where they were
/// inside the step; an X.latch beside them is what the encoder counted then, whose name X has but for the
/// last part ("encoder.index"). Drycut's own FMUs have them.
class Guest : public Plant {
 public:
  /// `type` may be null: then it has no variables. What fails is told to the world; in the run with `name`
  /// and time, and as the event `failed`.
  Guest(World& world, std::string name, std::shared_ptr<const GuestType> type, const GuestType::Start& start,
        double every);

  void drive(double h) override;
  void sense(double h) override;
  void visit(StateArchive& archive) override;
  std::vector<Port> ports() override;
  std::vector<Channel> channels() override;
  std::vector<Setting> settings() override;
  std::vector<EventType> event_types() override;
  [[nodiscard]] bool has_failed() const { return failed_; }

 private:
  struct Input {
    const GuestVariable* variable;
    double value = 0;  // the model's own number
    ReferencePort reference = {};
    CommandPort command = {};
    PulsePort pulses = {};
    [[nodiscard]] bool is_reference() const;
    void set(double si);
    [[nodiscard]] double si() const;
    [[nodiscard]] double own() const;
    void visit(StateArchive& archive);
  };
  struct Output {
    const GuestVariable* variable;
    double value = 0;  // the model's own number, as it is shown now
    EncoderPort encoder = {};
    SignalPort signal = {};
    const Output* rises = nullptr;
    const Output* rise_time = nullptr;
    const Output* latch = nullptr;
    Output* latched = nullptr;  // the encoder that it latches
    double rises_before = 0;
    [[nodiscard]] bool is_encoder() const;
    void visit(StateArchive& archive);
  };
  void find_edges();
  void show_signal(Output& output, double begin, double h);
  /// `at` [s] of the run.
  template <class Act>
  void guarded(double at, const Act& act);
  void settle(double at);
  [[nodiscard]] std::int64_t steps_of(double h) const;

  World* world_;
  std::string name_;
  std::shared_ptr<const GuestType> type_;
  double every_;    // [s], 0 = the scene's step
  double now_ = 0;  // [s], where it steps or was kept last
  std::unique_ptr<GuestModel> model_;
  std::deque<Input> inputs_;
  std::deque<Output> outputs_;
  std::vector<double> sent_;
  std::vector<double> answer_;  // outputs that are seen from the end of the step on
  std::int64_t steps_ = 0;      // of the scene, since the start
  bool waits_ = false;          // for the answer
  bool failed_ = false;
};

/// The parameters of a guest: where it is, how it steps, what it may take; and the model's own.
class GuestDefinition : public PlantDefinition {
 public:
  /// What its file says, before the parameters are read; `name` of the plant, for messages.
  void open(std::shared_ptr<const GuestType> type, std::string name);
  [[nodiscard]] const GuestType* type() const { return type_.get(); }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] std::string& file() { return file_; }
  /// [s], where the scene steps by `h`
  [[nodiscard]] double step(double h) const { return every_ > 0 ? every_ : h; }

  Parameters parameters() override;
  std::vector<Objection> objections(double h) override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;

 private:
  struct Given {
    std::size_t variable;
    std::variant<double, int, bool, std::string> value;
    std::variant<double, int, bool, std::string> start;
  };
  std::string name_;
  std::string file_;
  double every_ = 0;
  double time_limit_ = 10;
  int memory_limit_ = 1024;
  std::shared_ptr<const GuestType> type_;
  std::deque<Given> given_;
};

}  // namespace drycut::plants
