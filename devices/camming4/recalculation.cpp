#include "devices/camming4/camming4.hpp"

#include <algorithm>
#include <iterator>

namespace drycut::devices::camming4 {
namespace {

/// A variable's calculation: its samples, and the variable that stands for all of one calculation (000 1.4).
struct Calculation {
  VariableRow variable;
  int samples;
  VariableRow shared;
};

constexpr Calculation calculations[] = {
    {"codeG", 1, "codeG"},       {"codeQm", 1, "codeG"},        {"codeQs", 1, "codeG"},
    {"codeQma", 1, "codeG"},     {"codeQsa", 1, "codeG"},       {"maxpos", 1, "maxpos"},
    {"minpos", 1, "minpos"},     {"prspos", 1, "prspos"},       {"prsposm", 1, "prsposm"},
    {"toll", 1, "toll"},         {"tacc", 1, "tacc"},           {"tdec", 1, "tdec"},
    {"taccmax", 1, "taccmax"},   {"tdecmax", 1, "tdecmax"},     {"syncrange", 1, "syncrange"},
    {"pgain", 1, "pgain"},       {"feedfw", 1, "feedfw"},       {"integt", 1, "integt"},
    {"derivt", 1, "derivt"},     {"tbfm", 2, "tbfm"},           {"tbf", 3, "tbf"},
    {"maxvel", 5, "maxvel"},     {"decpt", 6, "decpt"},         {"unitvel", 6, "decpt"},
    {"pulsem", 130, "measurem"}, {"measurem", 130, "measurem"}, {"pulse", 139, "measure"},
    {"measure", 139, "measure"},
};

}  // namespace

void Recalculation::written(int variable, int row) {
  const auto* const found = std::ranges::find(calculations, VariableRow{variable}, &Calculation::variable);
  if (found == std::end(calculations)) return;
  const std::size_t number = found->shared == "codeG"
                                 ? table::variables.size() + static_cast<std::size_t>(row)
                                 : static_cast<std::size_t>(found->shared);
  left_ += found->samples - of_each_[number];
  of_each_[number] = static_cast<std::uint8_t>(found->samples);
}

void Recalculation::sample() {
  if (left_ == 0) return;
  --left_;
  --*std::ranges::find_if(of_each_, [](std::uint8_t samples) { return samples > 0; });
}

}  // namespace drycut::devices::camming4
