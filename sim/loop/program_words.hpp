#pragma once
#include <string>
#include <vector>

#include "devices/controller.hpp"

namespace drycut::sim::loop {

/// The text without comments, in small letters: of QCL and IL from ';' on, of Structured Text // and (* *).
std::string program_words(const devices::ProgramText& program);

/// A line of a program, from 1, without its comment; "" = there is none.
std::string code_of(const devices::ProgramText& program, int number);

/// A program with its words, which are taken out of the text once.
struct ReadProgram {
  devices::ProgramText program;
  std::string words;
};
std::vector<ReadProgram> read_programs(devices::Controller& controller);

/// How sure it is to be that a program works or reads a terminal: what cannot be told counts as named, or a
/// group of terminals does not name each of them.
enum class Named { perhaps, surely };
/// A program names a terminal, or what the configuration calls it.
bool is_named(const std::string& terminal, const std::vector<ReadProgram>& programs, Named how);
/// A counter of an LX3VP, which its program has to name and does not.
bool is_unread(const std::string& terminal, const std::vector<ReadProgram>& programs);
/// The name that a program has for a terminal, of the configuration, of AT; "" = none.
std::string name_in_program(const std::string& terminal, const std::vector<ReadProgram>& programs);

/// A program of Structured Text calls a block of that type, in small letters, with that axis.
bool calls_block(const std::vector<ReadProgram>& programs, const std::string& type, const std::string& axis);

/// A QCL program gives PRESET for that axis; "" = for any.
bool presets(devices::Controller& controller, const std::string& axis);

/// The lines of programs that switch an output on, as the end of a phrase: ", by saw.mod:88, SETOUT
/// ofTrouble"; "" where none is found.
std::string switched_on_by(devices::Controller& controller, const std::string& terminal);

}  // namespace drycut::sim::loop
