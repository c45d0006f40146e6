#pragma once
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {

/// A device of its own for each command and each write, brought into one of the situations of a machine.
class Machine : public Camming4Test {
 public:
  void TestBody() override {}
  using Camming4Test::command;
  using Camming4Test::device;
  using Camming4Test::diagnostics;
  using Camming4Test::get;
  using Camming4Test::order;
  using Camming4Test::row;
  using Camming4Test::set;
  using Camming4Test::start;
  using Camming4Test::tick;
  using Camming4Test::ticks;
  using Camming4Test::word;
  using Camming4Test::write;

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
    for (const std::string& name : symbol_names(device.type()))
      if (name != "st_warning" && name != "wrncode" && name != "wrnvalue") all[name] = get(name);
    all["DAC"] = word();
    return all;
  }
};

struct Situation {
  const char* name;
  std::function<void(Machine&)> bring;
};

inline const std::vector<Situation>& situations() {
  static const std::vector<Situation> all = {
      {"not initialised", [](Machine&) {}},
      {"at rest", [](Machine& m) { m.start(); }},
      {"loop open", [](Machine& m) { m.command("INIT"); }},
      {"emergency",
       [](Machine& m) {
         m.start();
         m.command("EMRG");
       }},
      {"regulation off",
       [](Machine& m) {
         m.start();
         m.command("REGOFF");
       }},
      {"calibration",
       [](Machine& m) {
         m.start();
         m.command("CALON");
       }},
      {"moving",
       [](Machine& m) {
         m.start();
         m.command("MANFW");
         m.ticks(60);
       }},
      {"in a cam",
       [](Machine& m) {
         m.row(1, {154, 1000, 1000});
         m.row(2, {137, 1});
         m.start();
         m.command("STARTCAM");
         m.ticks(30, 10);
       }},
      {"preset search",
       [](Machine& m) {
         m.start();
         m.command("PRESET");
         m.ticks(60);
       }},
      {"master's preset search",
       [](Machine& m) {
         m.start();
         m.command("PRESETM");
       }},
      {"error",
       [](Machine& m) {
         m.start();
         m.command("STARTCAM");
         m.command("RESUME");
       }},
  };
  return all;
}

}  // namespace drycut::devices::camming4
