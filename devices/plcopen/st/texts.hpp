#pragma once
#include <span>
#include <string>
#include <string_view>

#include "devices/plcopen/st/code.hpp"

// The functions of STRING as CODESYS has them: places count from 1, and what lies outside of a text is cut
// off.
namespace drycut::devices::plcopen::st {

/// LEFT, RIGHT, MID, CONCAT, INSERT, DELETE and REPLACE of one or more texts; `numbers` are L and P as far as
/// the function has them.
std::string edited(TextOp op, std::span<const std::string_view> texts, std::span<const Cell> numbers);
/// Where `wanted` begins in `text`, from 1; 0 if nowhere.
Cell found(std::string_view text, std::string_view wanted);
/// '5', '-1.5', 'TRUE', 'T#1s500ms', 'D#1996-08-15': X_TO_STRING.
std::string text_of(Basic basic, Cell value);
/// The number, time or date that the text begins with, else 0: STRING_TO_X.
Cell value_of(Basic basic, std::string_view text);

}  // namespace drycut::devices::plcopen::st
