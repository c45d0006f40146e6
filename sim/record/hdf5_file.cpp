#include "sim/record/hdf5_file.hpp"

#include <array>
#include <fstream>
#include <string_view>

#include "base/built_in_library.hpp"

extern "C" const char drycut_hdf5_begin[];
extern "C" const char drycut_hdf5_end[];

namespace drycut::sim::record {

namespace {

const Hdf5Library& hdf5_library() {
  static const auto& library = *static_cast<const Hdf5Library*>(load_built_in_library(
      "drycut_hdf5", {drycut_hdf5_begin, static_cast<std::size_t>(drycut_hdf5_end - drycut_hdf5_begin)}));
  return library;
}

}  // namespace

std::unique_ptr<Observer> hdf5_writer(const Recording& recording, const std::filesystem::path& file,
                                      const About& about) {
  return hdf5_library().writer(recording, file, about);
}

void add_outcome(const std::filesystem::path& file, const Outcome& outcome) {
  hdf5_library().add_outcome(file, outcome);
}

bool is_hdf5(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;  // a FIFO would be waited for
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::array<char, signature.size()> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  return std::string_view(begin.data(), begin.size()) == signature;
}

std::string hdf5_version() { return hdf5_library().version(); }

bool names_drycut(const std::filesystem::path& file) { return hdf5_library().names_drycut(file); }

Record read_hdf5(const std::filesystem::path& file, Problems& problems, const SeverityOf& severity_of) {
  if (is_hdf5(file)) return hdf5_library().read(file, problems, severity_of);
  problems.push_back({"record.not-a-record"_code, file.string(), 1, 1, "it is no HDF5 file",
                      "name a file that drycut wrote: trace.h5"});
  return {};
}

}  // namespace drycut::sim::record
