#pragma once
#include "devices/plcopen/coupling_blocks.hpp"
#include "devices/plcopen/movement_blocks.hpp"
#include "devices/plcopen/reading_blocks.hpp"

// All function blocks, each with PLCopen's own pin names. Times are those of the caller's task: outputs
// change in call().
