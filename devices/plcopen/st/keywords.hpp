#pragma once
#include <string_view>

namespace drycut::devices::plcopen::st {

/// Words of the language, any case: no name may be one of them.
bool is_keyword(std::string_view word);
/// END_IF, ELSE, UNTIL and the like: where a statement that was given up must end.
bool closes_block(std::string_view word);
/// Which of them a word is that is none, as ENDIF and ELSEIF; "" if it is like none.
std::string_view meant_closer(std::string_view word);
/// PROGRAM, FUNCTION, TYPE and the like.
bool opens_unit(std::string_view word);
/// The standard blocks TON, TOF, TP, R_TRIG, F_TRIG, SR, RS, CTU, CTD, CTUD, and standard functions, as
/// Structured Text with the pins of CODESYS and TwinCAT.
std::string_view standard_blocks();

}  // namespace drycut::devices::plcopen::st
