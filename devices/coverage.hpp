#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drycut::devices {

/// What a program's instructions come to while they are counted, by their places in it.
struct Counts {
  std::vector<std::uint64_t> passed;   ///< how often each was executed
  std::vector<std::uint64_t> refused;  ///< how often its condition did not hold

  Counts() = default;
  explicit Counts(std::size_t instructions) : passed(instructions), refused(instructions) {}
};

/// How often the places of programs ran, whatever their language.
struct Coverage {
  using Count = std::uint64_t;
  /// A decision's ways: how often each was taken. All 0: it was never come by.
  using Ways = std::vector<Count>;

  struct File {
    std::map<int, Count> lines;                              ///< those that can run
    std::map<int, std::vector<Ways>> decisions;              ///< by line, in the order of the text
    std::map<std::pair<int, std::string>, Count> functions;  ///< by line and name

    /// A statement of a line: it ran as often as the one of them that ran most.
    void line(int number, Count count);
  };
  std::map<std::string, File> files;  ///< by the names that messages have

  /// Counts are added up.
  void add(const Coverage& other);
};

/// Of a file, for people.
struct CoverageFigures {
  std::size_t lines = 0;
  std::size_t lines_run = 0;
  std::size_t ways = 0;
  std::size_t ways_taken = 0;
  std::string
      never;  ///< lines that never ran: "3, 7-9"; what cannot run between two of them does not part them
};
CoverageFigures figures_of(const Coverage::File& file);

/// First line of what lcov_text() gives.
inline constexpr std::string_view lcov_header = "TN:drycut";
/// As lcov has it (geninfo(1)): TN, SF, FN, FNDA, BRDA, DA. A decision that was never come by has '-'.
std::string lcov_text(const Coverage& coverage);

/// Whether a unit of this name is a test: TEST_ begins it, in any case. What tests consist of is not covered.
bool is_test(std::string_view name);

}  // namespace drycut::devices
