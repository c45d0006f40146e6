#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "base/text.hpp"
#include "devices/cards.hpp"
#include "devices/plcopen/modbus_map.hpp"

// Structured Text (IEC 61131-3) as a cam application on a PLCopen controller uses it.
namespace drycut::devices::plcopen::st {

struct Compiled;

/// A compiled program: PROGRAMs with their types, functions and function blocks. Cheap to copy. A line is
/// counted over all of its files, see SourceLines.
class Program {
 public:
  /// A name in the text and where it stands.
  struct Name {
    std::string name;
    int line = 0;
    int column = 0;
  };
  /// A BOOL at an input %IXbyte.bit or an output %QXbyte.bit, or a bit of a number at several.
  struct Located {
    std::string name;
    Address address;
    int line = 0;
    int column = 0;
    int bit = -1;  ///< of the number; -1: it is a BOOL
  };

  /// A variable AT %M, or an array of them from there on.
  struct InMemory {
    std::string name;  ///< with its program's, where there are several
    MemoryPlace place;
    ModbusFormat format = ModbusFormat::int16;
    std::optional<std::int64_t> low;  ///< of an array, its first index
    int count = 1;
    int line = 0;
    int column = 0;
  };

  /// A TASK of a CONFIGURATION.
  struct Task {
    std::string name;
    int line = 0;
    int column = 0;
    std::int64_t interval_ns = 0;       ///< 0: it runs at the rising edge of its SINGLE
    int priority = 0;                   ///< 0 runs first
    std::vector<std::string> programs;  ///< where a scenario names them
  };
  /// A program that runs: a PROGRAM of a CONFIGURATION, or without one each PROGRAM under its own name.
  struct Instance {
    std::string name;
    int line = 0;
    int column = 0;
    int task = -1;  ///< of tasks(); -1: the controller's own task
  };

  Program();
  explicit Program(std::shared_ptr<const Compiled> compiled);

  /// Axes that VAR_EXTERNAL names.
  [[nodiscard]] const std::vector<Name>& externals() const;
  [[nodiscard]] const std::vector<Located>& located() const;
  [[nodiscard]] const std::vector<InMemory>& in_memory() const;
  /// Cam table files that initial values and assignments of MC_CAM_REF.File name.
  [[nodiscard]] const std::vector<Name>& tables() const;
  [[nodiscard]] const std::vector<Task>& tasks() const;
  [[nodiscard]] const std::vector<Instance>& instances() const;
  /// True if a CONFIGURATION says what runs.
  [[nodiscard]] bool has_configuration() const;
  /// True if it has an instance of this motion block ("MC_CamIn").
  [[nodiscard]] bool has_motion_block(std::string_view name) const;
  [[nodiscard]] const std::vector<SourceFile>& files() const;
  [[nodiscard]] const SourceLines& lines() const;
  /// A problem at a line of all files.
  [[nodiscard]] Problem problem_at(Code code, int line, int column, std::string what,
                                   std::string remedy) const;
  /// What is no fault and hardly meant, whatever is set from outside: "file:line:column: ...".
  [[nodiscard]] std::vector<Finding> notes() const;
  [[nodiscard]] const Compiled& compiled() const { return *compiled_; }

 private:
  std::shared_ptr<const Compiled> compiled_;
};

/// Whose Structured Text a program is written in, where IEC 61131-3 (third edition) and CODESYS differ.
enum class StDialect : std::uint8_t { iec, codesys };
inline constexpr std::array<std::string_view, 2> dialect_names{"iec", "codesys"};

struct CompileOptions {
  bool library = false;                   ///< it may have no PROGRAM: then there is nothing to run
  bool tests = false;                     ///< what runs are its tests: see tests.hpp
  std::optional<StDialect> dialect = {};  ///< not given: CODESYS's; where it matters that is noted
};

/// Compiles the files of a program, one at least, whose order is of no account. All its faults go to
/// `problems` in the order of the files and of their texts; the result may be run only if there is none.
Program compile(std::span<const SourceFile> files, const CompileOptions& options, Problems& problems);
/// The same of one file.
Program compile(std::string_view text, const std::string& file, Problems& problems,
                const CompileOptions& options = {});

}  // namespace drycut::devices::plcopen::st
