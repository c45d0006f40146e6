#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plants/plant.hpp"
#include "plants/world.hpp"
#include "sim/fmi/machine/fmi_model.hpp"

namespace drycut::sim::fmi {

/// The plants of a resolved machine, built and stepped without a controller, and the table of their
/// variables: parameters as `parameters.knife.circumference`, plugs and channels as scenarios name them, what
/// the timeline sets as `set.web.speed`, faults as `fault.knife.encoder.stuck`, events as `knife.cut.count`,
/// `.time` and their values. A channel that has the name of a plug is `knife.home.channel`.
class BuiltMachine : public FmiModel {
 public:
  /// Throws Refusal with what the plants object to.
  explicit BuiltMachine(const ResolvedMachine& resolved, const Given& given = {});
  ~BuiltMachine() override;
  BuiltMachine(const BuiltMachine&) = delete;
  BuiltMachine& operator=(const BuiltMachine&) = delete;

  void step() override;
  [[nodiscard]] bool had_event() const override { return had_event_; }
  [[nodiscard]] const std::string& failure() const override { return world_.failure(); }
  [[nodiscard]] Time time() const override { return time_; }
  void visit(StateArchive& archive) override;

 private:
  struct NamedDefinition;
  struct Signal;
  struct Happening;

  void define(const ResolvedMachine& resolved);
  void build();
  void refuse_objections();
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
  std::vector<NamedDefinition> definitions_;
  plants::World world_;
  std::vector<std::unique_ptr<plants::Plant>> plants_;
  std::vector<std::unique_ptr<Signal>> signals_;
  std::vector<std::unique_ptr<Happening>> happenings_;
  std::vector<std::unique_ptr<double>> faults_;  // as they were acted last
  bool had_event_ = false;
};

/// The machine that an FMU carries as resources/machine.json.
class MachineSource : public FmiSource {
 public:
  explicit MachineSource(ResolvedMachine resolved) : resolved_(std::move(resolved)) {}
  [[nodiscard]] Time step() const override { return resolved_.step; }
  [[nodiscard]] std::unique_ptr<FmiModel> build(const FmiModel::Given& given) const override {
    return std::make_unique<BuiltMachine>(resolved_, given);
  }

 private:
  ResolvedMachine resolved_;
};

}  // namespace drycut::sim::fmi
