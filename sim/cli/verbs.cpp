#include "sim/cli/verb.hpp"

namespace drycut::sim::cli {

// A verb is a file of its own and its name here, twice.
using Row = Verb();
Row run_verb, live_verb, replay_verb, check_verb, test_verb, cam_verb, design_verb, tune_verb, sweep_verb,
    envelope_verb, size_verb, faults_verb, bode_verb, compare_verb, fit_verb, why_verb, index_verb,
    convert_verb, fmu_verb, import_verb, devices_verb, plants_verb, new_verb, help_verb, reference_verb,
    work_verb;

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = {
      run_verb(),       live_verb(),    replay_verb(),  check_verb(),    test_verb(),  cam_verb(),
      design_verb(),    tune_verb(),    sweep_verb(),   envelope_verb(), size_verb(),  faults_verb(),
      bode_verb(),      compare_verb(), fit_verb(),     why_verb(),      index_verb(), convert_verb(),
      fmu_verb(),       import_verb(),  devices_verb(), plants_verb(),   new_verb(),   help_verb(),
      reference_verb(), work_verb()};
  return all;
}

}  // namespace drycut::sim::cli
