#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "plants/plant.hpp"
#include "sim/fmi/machine/resolved.hpp"
#include "sim/time.hpp"

namespace drycut {
class StateArchive;
}

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

/// What an FMU steps, a machine or a line, with the table of its variables.
class FmiModel {
 public:
  /// Values of parameters in place of those that it was resolved with, by place in the table.
  using Given = std::map<std::uint32_t, FmiValue>;

  FmiModel() = default;
  virtual ~FmiModel();
  FmiModel(const FmiModel&) = delete;
  FmiModel& operator=(const FmiModel&) = delete;

  [[nodiscard]] const std::vector<FmiVariable>& variables() const { return variables_; }
  /// The variable, if `value` is of its kind and range; throws Refusal. Whoever sets it looks here first.
  [[nodiscard]] const FmiVariable& checked(std::uint32_t reference, const FmiValue& value) const;

  /// One step of the scene: inputs are taken at its beginning, outputs are those at its end.
  virtual void step() = 0;
  /// An event happened in the last step.
  [[nodiscard]] virtual bool had_event() const = 0;
  /// Why it cannot go on, "" while all is well.
  [[nodiscard]] virtual const std::string& failure() const = 0;
  [[nodiscard]] virtual Time time() const = 0;
  /// All that changes from step to step, live parameters among it.
  virtual void visit(StateArchive& archive) = 0;

 protected:
  /// Adds it, if none has its name.
  void add(FmiVariable variable);
  [[nodiscard]] FmiVariable& variable_called(const std::string& name) {
    return variables_.at(names_.at(name));
  }
  [[nodiscard]] bool has_variable(const std::string& name) const { return names_.contains(name); }

  std::map<std::string, SiScale> units_;  ///< of the ranges

 private:
  std::vector<FmiVariable> variables_;
  std::map<std::string, std::uint32_t> names_;
};

/// An output.
FmiVariable fmi_output(std::string name, std::string meaning, FmiVariable::Type type, std::string unit,
                       std::function<double()> get);
/// "parameters." + `name`, of this row: its number is in SI. Who sets it is not said yet.
FmiVariable fmi_parameter(const std::string& name, const plants::Parameter& row);
/// What the timeline sets, or a fault: in SI, a Boolean where it is on or off.
FmiVariable fmi_setting(std::string name, std::string meaning, std::string_view unit, double min, double max,
                        bool whole);

/// What an FMU carries in its resources, from which models are built, as often as parameters change.
class FmiSource {
 public:
  FmiSource() = default;
  virtual ~FmiSource();
  FmiSource(const FmiSource&) = delete;
  FmiSource& operator=(const FmiSource&) = delete;
  [[nodiscard]] virtual Time step() const = 0;
  /// Throws Refusal where the values do not go together.
  [[nodiscard]] virtual std::unique_ptr<FmiModel> build(const FmiModel::Given& given) const = 0;
};

}  // namespace drycut::sim::fmi
