#pragma once
#include <map>
#include <string>
#include <vector>

#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {

/// A device of its own for each command and each write, brought into one of the situations of a machine.
class Machine : public Camming4Test {
 public:
  /// "init !emrg still": the states as the manual abbreviates them.
  bool holds(const std::string& conditions) {
    std::istringstream words(conditions);
    for (std::string word; words >> word;) {
      const bool off = word.front() == '!';
      if (get("st_" + word.substr(off ? 1 : 0)) == (off ? 1 : 0)) return false;
    }
    return true;
  }
  /// Every value and state of the device but the report of a refused command.
  std::map<std::string, std::int32_t> everything() {
    std::map<std::string, std::int32_t> all;
    for (const std::string& name : symbol_names(device->type()))
      if (name != "st_warning" && name != "wrncode" && name != "wrnvalue") all[name] = get(name);
    all["DAC"] = word();
    return all;
  }
};

struct Situation {
  const char* name;
  const char* script;
};

inline constexpr Situation situations[] = {
    {"not initialised", ""},
    {"at rest", "INIT LOOPON"},
    {"loop open", "INIT"},
    {"emergency", "INIT LOOPON EMRG"},
    {"regulation off", "INIT LOOPON REGOFF"},
    {"calibration", "INIT LOOPON CALON"},
    {"moving", "INIT LOOPON MANFW +60"},
    {"in a cam", "codeG1=154 codeQm1=1000 codeQs1=1000 codeG2=137 codeQm2=1 INIT LOOPON STARTCAM +30*10"},
    {"preset search", "INIT LOOPON PRESET +60"},
    {"master's preset search", "INIT LOOPON PRESETM"},
    {"error", "INIT LOOPON STARTCAM RESUME"},
};

}  // namespace drycut::devices::camming4
