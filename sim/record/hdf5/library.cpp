#include <H5public.h>
#include <fmt/format.h>

#include "sim/record/hdf5/faces.hpp"

namespace drycut::sim::record {
namespace {

std::string version_of_hdf5() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace
}  // namespace drycut::sim::record

extern "C" __attribute__((visibility("default"))) const drycut::sim::record::Hdf5Library drycut_library;
const drycut::sim::record::Hdf5Library drycut_library = {
    drycut::sim::record::write_hdf5, drycut::sim::record::add_outcome_to, drycut::sim::record::says_drycut,
    drycut::sim::record::read_from, drycut::sim::record::version_of_hdf5};
