#pragma once
#include <string>

#include "sim/output_folder.hpp"
#include "sim/record/verdict.hpp"
#include "sim/studies/bode/advice.hpp"

namespace drycut::sim::studies {

std::string advice_text(const FilterAdvice& advice);
record::Verdict verdict_of(const FilterAdvice& advice);
void write_advice_report(const FilterAdvice& advice, const scenario::Scenario& scenario,
                         OutputFolder& folder);

}  // namespace drycut::sim::studies
