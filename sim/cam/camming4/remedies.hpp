#pragma once
#include <string>

#include "sim/cam/camming4/run.hpp"

namespace drycut::sim {

/// What went wrong and what would be right, with the sector's own numbers.
struct CamAdvice {
  std::string text;
  std::string remedy;
};
/// Of an error or a warning of the engine (000 1.3, 1.4). `visit` is the sector it came in, nullptr if that
/// was never entered.
CamAdvice advice_on(const CamEngineEvent& event, const CamVisit* visit, const CamTable& table,
                    const CamDuty& duty);

}  // namespace drycut::sim
