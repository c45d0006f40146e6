#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/state_archive.hpp"
#include "sim/fmi/machine/fmi_model.hpp"

namespace drycut::sim::fmi {

// What the library is of, a machine or a line: in of_machine.cpp or of_line.cpp, of which each library has
// one.
/// The file in the folder of resources.
std::string_view resource_name();
/// From its bytes; `resources`: the folder. Throws std::exception if it is none.
std::unique_ptr<FmiSource> source_of(const std::string& bytes, const std::filesystem::path& resources);

/// An instance of the FMU, of either standard: what both ask of it, in their order of calls. Everything that
/// cannot be done throws, a Refusal where the importer may go on; nothing of it is shared between instances.
class Component {
 public:
  using Type = FmiVariable::Type;

  /// `resources`: the FMU's folder of that name; `token`: of the description that the importer has read.
  Component(const std::filesystem::path& resources, std::string_view token);

  /// The number of a variable of one of two types.
  [[nodiscard]] double number(std::uint32_t reference, Type type, Type or_type);
  /// The text of a word, until the next change of it.
  [[nodiscard]] const char* word(std::uint32_t reference);
  /// Takes the value. A parameter that is fixed holds until the next reset, and only before the first step.
  void set(std::uint32_t reference, const FmiValue& value, Type type, Type or_type);

  /// `start` [s]: the importer's time of the machine's beginning.
  void begin_at(double start);
  void enter_initialisation();
  void exit_initialisation();
  void terminate();
  void reset();

  /// Steps from `at` by `size` [s], a whole number of the scene's steps. `early`: an event of the machine may
  /// end it before; true if one did.
  bool step(double at, double size, bool early);
  /// [s], of the importer
  [[nodiscard]] double time() const { return start_ + seconds(machine_->time()); }

  /// All of it, to be kept in memory or in a file, and restored in any process that has this FMU loaded.
  [[nodiscard]] StateArchive::Bytes save();
  /// Throws BadState where it is none of this FMU, or was changed; nothing has changed then.
  void restore(std::span<const std::byte> state);

 private:
  enum class Phase : std::uint8_t { instantiated, initialising, stepping, terminated };

  [[nodiscard]] const FmiVariable& variable(std::uint32_t reference, Type type, Type or_type) const;
  void require(Phase phase, std::string_view what) const;
  /// Of a communication step [s]. Throws a Refusal where it is no whole multiple.
  [[nodiscard]] std::int64_t steps_in(double size) const;
  void rebuild();
  void apply(std::uint32_t reference, const FmiValue& value);

  std::string token_;
  std::unique_ptr<FmiSource> source_;
  double h_ = 0;  // a step of the scene [s]
  Phase phase_ = Phase::instantiated;
  double start_ = 0;
  FmiModel::Given parameters_ = {};  // in place of the resolved ones
  FmiModel::Given inputs_ = {};      // set before the first step, for a machine that is built anew
  bool stale_ = false;               // a parameter was given since the machine was built
  std::unique_ptr<FmiModel> machine_;
};

}  // namespace drycut::sim::fmi
