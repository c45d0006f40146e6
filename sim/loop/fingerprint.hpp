#pragma once
#include <cstdint>
#include <string_view>

namespace drycut::sim::scenario {
struct Scenario;
}

namespace drycut::sim::loop {

/// Tells whether a run would be the same as an earlier one. FNV-1a: the same on every machine.
class Fingerprint {
 public:
  void add(std::string_view text);
  /// All that a run of it depends on: every value in force, its variables, and the texts of its controller's
  /// files.
  void add(const scenario::Scenario& scenario);
  /// The program itself, to the byte: another build may compute something else.
  void add_program();
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  void byte(unsigned char c);
  std::uint64_t value_ = 14695981039346656037ULL;
};

}  // namespace drycut::sim::loop
