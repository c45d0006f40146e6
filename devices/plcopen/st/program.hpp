#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "devices/cards.hpp"
#include "devices/problem.hpp"

// Structured Text (IEC 61131-3) as a cam application on a PLCopen controller uses it.
namespace drycut::devices::plcopen::st {

struct Compiled;

/// A compiled file: one PROGRAM with its types, functions and function blocks. Cheap to copy.
class Program {
 public:
  /// A name in the text and where it stands.
  struct Name {
    std::string name;
    int line = 0;
    int column = 0;
  };
  /// A BOOL at an input %IXbyte.bit or an output %QXbyte.bit.
  struct Located {
    std::string name;
    Address address;
    int line = 0;
    int column = 0;
  };

  Program();
  explicit Program(std::shared_ptr<const Compiled> compiled);

  /// Axes that VAR_EXTERNAL names.
  [[nodiscard]] const std::vector<Name>& externals() const;
  [[nodiscard]] const std::vector<Located>& located() const;
  /// Cam table files that initial values and assignments of MC_CAM_REF.File name.
  [[nodiscard]] const std::vector<Name>& tables() const;
  /// True if it has an instance of this motion block ("MC_CamIn").
  [[nodiscard]] bool has_motion_block(std::string_view name) const;
  [[nodiscard]] const Compiled& compiled() const { return *compiled_; }

 private:
  std::shared_ptr<const Compiled> compiled_;
};

/// Compiles one file. All its faults go to `problems` in the order of the text; the result may be run only if
/// there is none.
Program compile(std::string_view text, const std::string& file, Problems& problems);

}  // namespace drycut::devices::plcopen::st
