#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "devices/plcopen/axis.hpp"

namespace drycut::devices::plcopen {

class MotionKernel;

/// MC_CAM_REF: a table by its file's name, which wins, or by its id.
struct CamRef {
  std::string file;
  std::uint16_t id = 0;
};

enum class PinDirection : std::uint8_t { in_out, input, output };

/// Where the value of a pin lives in its block: BOOL, INT, UINT, DINT, DWORD or UDINT, LREAL, AXIS_REF or
/// MC_CAM_REF.
using PinValue = std::variant<bool*, std::int16_t*, std::uint16_t*, std::int32_t*, std::uint32_t*, double*,
                              AxisRef*, CamRef*>;

/// One pin of a block's face; `type` is the name that IEC 61131-3 or PLCopen gives it.
struct Pin {
  std::string_view name;
  std::string_view type;
  PinDirection direction = PinDirection::input;
  std::string_view meaning;
};

/// A function block as a program sees it: pins by name and a call a task cycle. A block keeps its command's
/// ticket between calls; it must be called once each task cycle, as PLCopen's blocks must.
class FunctionBlock {
 public:
  FunctionBlock() = default;
  virtual ~FunctionBlock() = default;
  FunctionBlock(const FunctionBlock&) = default;
  FunctionBlock& operator=(const FunctionBlock&) = default;

  /// Reads the inputs, gives and watches the command, writes the outputs.
  virtual void call(MotionKernel& kernel) = 0;

  /// What it keeps from call to call, its pins apart.
  virtual void visit(StateArchive& archive);

  /// The axis that an error of the last call is about.
  AxisRef about;
};

/// What a program keeps a pin's value in: BOOL, numbers and the number of an AXIS_REF as they are, LREAL by
/// its bits. An MC_CAM_REF has several: the file's name, with a 0 behind it, and the id.
using PinCell = std::int64_t;
inline constexpr std::size_t cam_file_length = 80;
inline constexpr std::size_t cam_file_cells = cam_file_length / sizeof(PinCell) + 1;

/// A kind of function block: its name, its pins in the order of declaration, how to make one, and where the
/// value of its pin `number` is.
struct BlockType {
  std::string_view name;
  std::string_view meaning;
  std::span<const Pin> pins;
  std::unique_ptr<FunctionBlock> (*make)();
  PinValue (*pin)(FunctionBlock& block, std::size_t number);
  /// All inputs at once, and all outputs; the cells are those of all pins in their order.
  void (*take_inputs)(FunctionBlock& block, const PinCell* cells);
  void (*give_outputs)(const FunctionBlock& block, PinCell* cells);
};

/// All function blocks. A Structured Text front finds "MC_CamIn" here, makes an instance for each declared
/// variable and binds the pins by name.
std::span<const BlockType> block_types();
/// By name, any case; nullptr if there is none.
const BlockType* find_block_type(std::string_view name);
/// Number of the pin called `name`, any case; -1 if there is none.
int find_pin(const BlockType& type, std::string_view name);

}  // namespace drycut::devices::plcopen
