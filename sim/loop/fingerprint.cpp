#include "sim/loop/fingerprint.hpp"

#include <dlfcn.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <vector>

#include "base/state_archive.hpp"
#include "sim/loop/files_read.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

void Fingerprint::add(std::string_view text) {
  for (const char c : text) byte(static_cast<unsigned char>(c));
  byte(0);
}

void Fingerprint::add(const scenario::Scenario& scenario) {
  add(expand(scenario));
  for (const auto& [name, bytes] : read_files_of(scenario)) add(bytes);
}

namespace {

/// Of the file that this code is in: the program, or Python's extension.
std::uint64_t program_fingerprint() {
  Fingerprint hash;
  hash.add(DRYCUT_VERSION);
  Dl_info found{};
  if (dladdr(reinterpret_cast<const void*>(&program_fingerprint), &found) == 0) return hash.value();
  // Of the program itself the name may be that of the command line.
  const std::filesystem::path named = found.dli_fname;
  std::ifstream file(named.extension() == ".so" ? named : "/proc/self/exe", std::ios::binary | std::ios::ate);
  std::vector<std::byte> bytes(file ? static_cast<std::size_t>(file.tellg()) : 0);
  file.seekg(0).read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  hash.add(std::to_string(StateArchive::sum_of(bytes)));  // of some 30 MB, for every run
  return hash.value();
}

}  // namespace

void Fingerprint::add_program() {
  static const std::uint64_t program = program_fingerprint();
  add(std::to_string(program));
}

void Fingerprint::byte(unsigned char c) {
  constexpr std::uint64_t prime = 1099511628211ULL;
  value_ = (value_ ^ c) * prime;
}

}  // namespace drycut::sim::loop
