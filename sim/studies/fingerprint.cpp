#include "sim/studies/fingerprint.hpp"

#include "sim/file.hpp"
#include "sim/loop/controller_loader.hpp"

namespace drycut::sim::studies {

void Fingerprint::add(std::string_view text) {
  for (const char c : text) byte(static_cast<unsigned char>(c));
  byte(0);
}

void Fingerprint::add(const scenario::Scenario& scenario) {
  add(expand(scenario));
  Problems ignored;  // what cannot be read is told by whoever runs it
  for (const auto& name : loop::controller_files(scenario))
    add(read_file(scenario.file.parent_path() / name.text, ignored).value_or(""));
}

void Fingerprint::byte(unsigned char c) {
  constexpr std::uint64_t prime = 1099511628211ULL;
  value_ = (value_ ^ c) * prime;
}

}  // namespace drycut::sim::studies
