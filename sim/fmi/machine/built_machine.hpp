#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "plants/plant.hpp"
#include "plants/world.hpp"
#include "sim/fmi/machine/resolved.hpp"

namespace drycut::sim::fmi {

/// What an importer asked for and does not get, in a sentence; nothing has changed.
class Refusal : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A variable of the FMU: one row for both standards, its description, its documentation and who gets and
/// sets it. Its value reference is its place in the table.
struct FmiVariable {
  enum class Type {
    real,
    whole,  ///< 32 bits
    count,  ///< 64 bits; in FMI 2.0, which has none of that size, a Real, exact to 2^53
    flag,
    word,
  };
  enum class Role {
    time,
    parameter,       ///< fixed once the initialisation is over
    live_parameter,  ///< changes in mid-run, too: tunable
    input,
    output,
  };
  std::string name;
  std::string meaning;
  Type type = Type::real;
  Role role = Role::output;
  std::string unit = {};  ///< in which people read it; "" = pure number
  bool in_si = false;     ///< the number itself is in SI, whatever `unit` is
  bool ranged = false;    ///< `min` and `max` hold, in `unit`
  bool integral = false;  ///< a real that takes whole numbers only
  double min = 0;
  double max = 0;
  std::vector<std::string> choices = {};  ///< of a word
  std::function<double()> get = {};
  std::function<void(double)> set = {};  ///< of what can be set; it is in its range
  std::string* word = nullptr;
};

/// The plants of a resolved machine, built and stepped without a controller, and the table of their
/// variables: parameters as `parameters.knife.circumference`, plugs and channels as scenarios name them, what
/// the timeline sets as `set.web.speed`, faults as `fault.knife.encoder.stuck`, events as `knife.cut.count`,
/// `.time` and their values. A channel that has the name of a plug is `knife.home.channel`.
class BuiltMachine {
 public:
  /// Values of parameters in place of the resolved ones, by place in the table.
  using Given = std::map<std::uint32_t, FmiValue>;

  /// Throws Refusal with what the plants object to.
  explicit BuiltMachine(const ResolvedMachine& resolved, const Given& given = {});
  BuiltMachine(const BuiltMachine&) = delete;
  BuiltMachine& operator=(const BuiltMachine&) = delete;
  ~BuiltMachine();

  [[nodiscard]] const std::vector<FmiVariable>& variables() const { return variables_; }
  /// The variable, if `value` is of its kind and range; throws Refusal. Whoever sets it looks here first.
  [[nodiscard]] const FmiVariable& checked(std::uint32_t reference, const FmiValue& value) const;

  /// One step of the scene: inputs are taken at its beginning, outputs are those at its end.
  void step();
  /// An event happened in the last step.
  [[nodiscard]] bool had_event() const { return had_event_; }
  /// Why it cannot go on, "" while all is well.
  [[nodiscard]] const std::string& failure() const { return world_.failure(); }
  [[nodiscard]] Time time() const { return time_; }

  /// All that changes from step to step, live parameters among it.
  void visit(StateArchive& archive);

 private:
  struct NamedDefinition;
  struct Signal;
  struct Happening;

  void define(const ResolvedMachine& resolved);
  void build();
  void refuse_objections();
  void add(FmiVariable variable);
  void add_parameters(std::size_t plant);
  void bind_live_parameters(std::size_t plant);
  void add_plugs(const std::string& name, plants::Plant& plant);
  void add_signal(const std::string& name, const plants::Port& port, const std::vector<plants::Port>& ports);
  void add_settings(const std::string& name, plants::Plant& plant);
  void add_events(std::size_t plant);
  void take_events(std::size_t plant, double begin);

  Time step_;
  double h_;  // [s]
  Time time_ = 0;
  std::map<std::string, SiScale> units_;
  std::vector<NamedDefinition> definitions_;
  plants::World world_;
  std::vector<std::unique_ptr<plants::Plant>> plants_;
  std::vector<FmiVariable> variables_;
  std::map<std::string, std::uint32_t> names_;
  std::vector<std::unique_ptr<Signal>> signals_;
  std::vector<std::unique_ptr<Happening>> happenings_;
  std::vector<std::unique_ptr<double>> faults_;  // as they were acted last
  bool had_event_ = false;
};

}  // namespace drycut::sim::fmi
