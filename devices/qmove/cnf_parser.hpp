#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/scanner.hpp"
#include "devices/qmove/cnf.hpp"

namespace drycut::devices::qmove {

/// Reads the lines of a .CNF one by one; a fault costs its line, never the rest. Used by
/// parse_configuration.
class CnfParser : private Complaints {
 public:
  CnfParser(const std::string& file, std::span<const CatalogueEntry> catalogue, Problems& problems);
  Configuration parse(std::string_view text);

 private:
  enum class Section : std::uint8_t {
    none,     ///< before the first keyword
    unknown,  ///< after a keyword that is none: its entries cannot be judged
    constants,
    system,
    global,
    system_arrays,
    global_arrays,
    timers,
    groups,
    bus,
    inputs,
    outputs,
    devices,
    end
  };
  struct Keyword {
    std::string_view word;
    Section section;
  };
  static const std::vector<Keyword>& keywords();
  static std::vector<std::string> section_names();
  /// Where in a datagroup the lines are.
  enum class GroupPart : std::uint8_t { name, recipes, statics, steps, stepped };

  bool keyword(const Words& words);
  void entry(const Words& words);
  void constant(const Words& words);
  void scalar(const Words& words, bool retentive);
  void array(const Words& words, bool retentive);
  void timer(const Words& words);
  void group_line(const Words& words);
  void group_name(const Words& words);
  void group_count(const Words& words, std::size_t first, GroupPart next);
  void group_variable(const Words& words);
  void close_groups();
  void slot(const Words& words);
  void terminal(const Words& words, Kind kind);

  void device(const Words& words);
  std::optional<std::size_t> device_type(const Word& word);
  std::optional<Resource> resource(const Field& field, const Word& word, const DeviceType& type);
  std::optional<Resource> number_resource(const Field& field, const Word& word, const DeviceType& type);
  void sole_output(const Address& address, const Word& word);
  void check_bus();

  bool no_more_than(const Words& words, std::size_t count, const std::string& form);
  bool declare(const Word& name);
  std::optional<Size> size(const Word& word);
  std::optional<int> count(const Word& word, std::string_view of_what);
  bool reserve(std::int64_t cells, const Word& word);

  std::span<const CatalogueEntry> catalogue_;
  Configuration configuration_;
  Section section_ = Section::none;
  GroupPart group_part_ = GroupPart::name;
  std::map<std::string, Place> declared_;
  /// Slots that addresses name, checked against BUS at the end because BUS may stand anywhere.
  struct SlotUse {
    int slot;
    Word word;
  };
  std::vector<SlotUse> slot_uses_;
  std::map<Address, Place> outputs_;  ///< that have a name or a device
  bool bus_seen_ = false;
  bool bus_faulty_ = false;  ///< a row of it could not be read
  Place bus_place_;
  bool said_after_end_ = false;
  std::int64_t cells_ = 0;
  Place last_ = {1, 1};
};

}  // namespace drycut::devices::qmove
