#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/fmi/host/frame.hpp"

namespace drycut::sim::fmi::host {

/// The values of variables of one type, which an FMU takes and gives by one call. Its numbers have places in
/// a list that has those of all types.
class VariableGroup {
 public:
  VariableGroup() = default;
  virtual ~VariableGroup() = default;
  VariableGroup(const VariableGroup&) = delete;
  VariableGroup& operator=(const VariableGroup&) = delete;
  virtual void add(const SharedVariable& variable, std::size_t place) = 0;
  virtual void set(void* instance, const double* numbers) = 0;
  virtual void get(void* instance, double* numbers) = 0;
};

/// A foreign FMU in this process, of either standard: its library, and one instance. All that it refuses
/// throws std::runtime_error with a sentence.
class LoadedModel {
 public:
  explicit LoadedModel(const LoadRequest& load);
  ~LoadedModel();
  LoadedModel(const LoadedModel&) = delete;
  LoadedModel& operator=(const LoadedModel&) = delete;

  void step(double at, double size, std::span<const double> inputs);
  /// All outputs, an element each.
  [[nodiscard]] const std::vector<double>& outputs();
  [[nodiscard]] std::vector<std::byte> save();
  void restore(std::span<const std::byte> state);

 private:
  using Groups = std::vector<std::pair<NumberKind, std::unique_ptr<VariableGroup>>>;
  void* function(const std::string& name);
  [[nodiscard]] std::string state_name(std::string name) const;
  /// `fmi2DoStep`, with whatever arguments it has.
  template <class... Arguments>
  int call(const char* name, Arguments... arguments);
  template <class... Arguments>
  void require(const char* name, Arguments... arguments);
  VariableGroup& group_of(Groups& groups, NumberKind kind);
  template <class T>
  std::unique_ptr<VariableGroup> make_group(NumberKind kind);
  std::size_t add(Groups& groups, const std::vector<SharedVariable>& variables);
  void make_instance(const LoadRequest& load);
  void set_parameters(const LoadRequest& load);
  void initialise();
  [[nodiscard]] bool asks_to_end() const;
  void find_unknown(const std::vector<SharedVariable>& variables);

  int version_;
  bool keeps_state_;
  void* library_ = nullptr;
  void* instance_ = nullptr;
  bool begun_ = false;
  std::optional<double> ended_at_ = {};  // [s], where it has asked for the end
  void* step_ = nullptr;
  Groups inputs_;
  Groups outputs_;
  std::vector<double> values_;  // of the outputs
};

}  // namespace drycut::sim::fmi::host
