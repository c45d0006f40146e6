#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "base/text.hpp"
#include "devices/device.hpp"
#include "devices/qmove/catalogue.hpp"

namespace drycut::devices::qmove {

/// The words of the language: no variable, device or label may have such a name.
const std::vector<std::string>& reserved_words();
bool is_reserved(std::string_view word);

// The configuration unit of a QMOVE project (spec qem.md §3): what the program's names stand for.

/// CONST: a number with a name; a value with a decimal point is a single, else a long.
struct CnfConstant {
  std::string name;
  double value = 0;
  bool real = false;
  Place place;
};

/// SYSTEM (retentive) and GLOBAL (zeroed at each start): one value.
struct Scalar {
  std::string name;
  Size size = Size::L;
  bool retentive = false;
  Place place;
};

/// ARRSYS (retentive) and ARRGBL (zeroed at each start): values 1..length.
struct Array {
  std::string name;
  Size size = Size::L;
  int length = 0;
  bool retentive = false;
  Place place;
};

/// TIMER: assigning n starts n ms; reads 1 when they have elapsed (spec D7).
struct CnfTimer {
  std::string name;
  Place place;
};

/// A variable of a datagroup.
struct GroupVariable {
  std::string name;
  Size size = Size::L;
  Place place;
};

/// DATAGROUP: retentive recipes. Static variables exist once a recipe, name[recipe]; step variables once a
/// step of each recipe, name[recipe, step]; both indexes from 1.
struct DataGroup {
  std::string name;
  int recipes = 0;
  int steps = 0;
  std::vector<GroupVariable> statics;
  std::vector<GroupVariable> stepped;
  Place place;
};

/// BUS: a slot and its card; card empty = nothing plugged in.
struct Slot {
  int number = 0;
  std::string card;
  std::string firmware;
  Place place;
};

/// INPUT and OUTPUT: a flag with a name at a terminal.
struct Terminal {
  std::string name;
  Address address;
  Place place;
};

/// INTDEVICE: a device, its type (index into the catalogue) and its terminals in the order of its fields.
struct DeviceRecord {
  std::string name;
  std::size_t type = 0;
  Resources resources;
  Place place;
};

/// A .CNF file, each entry with its place.
struct Configuration {
  std::string file;
  std::string text;
  std::vector<CnfConstant> constants;
  std::vector<Scalar> scalars;
  std::vector<Array> arrays;
  std::vector<CnfTimer> timers;
  std::vector<DataGroup> groups;
  std::vector<Slot> slots;
  std::vector<Terminal> inputs;
  std::vector<Terminal> outputs;
  std::vector<DeviceRecord> devices;
  std::vector<Finding> notes;  ///< what a reader should know that is no fault: "file:line:column: ..."
};

/// Reads a .CNF text. `file_name` is only for messages. Device types are those of `catalogue`, which the
/// records refer to by index. All faults are appended to `problems` in the order of the text; what was
/// sound is in the result, so that modules can still be checked against it.
Configuration parse_configuration(std::string_view text, const std::string& file_name,
                                  std::span<const CatalogueEntry> catalogue, Problems& problems);

}  // namespace drycut::devices::qmove
