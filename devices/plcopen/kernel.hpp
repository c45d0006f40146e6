#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "devices/plcopen/axis.hpp"
#include "devices/plcopen/cam_table.hpp"

namespace drycut::devices::plcopen {

/// Bits of MC_CamIn.StartMode (004 "startmode"). The first three have no effect: ramp-in and absolute are
/// always used.
enum StartMode : std::uint32_t {
  hli_ci_ramp_in = 0x01,
  hli_ci_absolute = 0x02,
  hli_ci_relative = 0x04,
  hli_ci_lock_table = 0x08,
  hli_ci_f_periodic = 0x10,
  hli_ci_endless_positive = 0x20,
  hli_ci_endless_negative = 0x40,
};
struct StartModeRow {
  std::string_view name;
  std::uint32_t bit = 0;
  std::string_view meaning;
};
inline constexpr std::array start_mode_table{
    StartModeRow{"HLI_CI_RAMP_IN", hli_ci_ramp_in, "no effect: always"},
    StartModeRow{"HLI_CI_ABSOLUTE", hli_ci_absolute, "no effect: always"},
    StartModeRow{"HLI_CI_RELATIVE", hli_ci_relative, "no effect"},
    StartModeRow{"HLI_CI_LOCK_TABLE", hli_ci_lock_table, "the table cannot be written while coupled"},
    StartModeRow{"HLI_CI_F_PERIODIC", hli_ci_f_periodic, "endless; without it one pass for each Execute"},
    StartModeRow{"HLI_CI_ENDLESS_POSITIVE", hli_ci_endless_positive,
                 "the cam turns the slave on in positive direction"},
    StartModeRow{"HLI_CI_ENDLESS_NEGATIVE", hli_ci_endless_negative,
                 "the cam turns the slave on in negative direction"},
};

/// Inputs of MC_CamIn, without its edge.
struct CamInRequest {
  AxisRef master;
  AxisRef slave;
  double master_offset = 0;
  double slave_offset = 0;
  double master_scaling = 1;
  double slave_scaling = 1;
  std::uint32_t start_mode = 0;
  std::uint16_t table = 0;
  std::uint32_t interpolation = static_cast<std::uint32_t>(Interpolation::table_defined);
};

/// Inputs of MC_GearIn.
struct GearInRequest {
  AxisRef master;
  AxisRef slave;
  std::int32_t numerator = 1;
  std::uint32_t denominator = 1;
  Dynamics dynamics;
  std::uint32_t mode = 0;
};
inline constexpr std::uint32_t gear_on_actual_values = 0x80;

/// The axes of a controller, its cam tables and their cycle. Function blocks give their commands between two
/// cycles.
class MotionKernel {
 public:
  static constexpr std::int64_t default_cycle_ns = 2'000'000;
  explicit MotionKernel(std::int64_t cycle_ns = default_cycle_ns) : cycle_ns_(cycle_ns) {}

  [[nodiscard]] std::int64_t cycle_ns() const { return cycle_ns_; }
  AxisRef add_axis(std::string name, const AxisParameters& parameters);
  /// By its name, any case; not connected if there is none.
  [[nodiscard]] AxisRef find_axis(std::string_view name) const;
  [[nodiscard]] int axes() const { return static_cast<int>(axes_.size()); }
  /// nullptr if the reference is not one of this kernel's.
  Axis* axis(AxisRef ref);
  [[nodiscard]] const Axis* axis(AxisRef ref) const;

  /// Adds or replaces a table; see CamTables::add. 240010 if a coupling locks the one that is there.
  ErrorId add_table(CamTable table);
  /// See CamTables::write. 240010 if a coupling locks the table.
  ErrorId write_table(std::uint16_t id, std::size_t line, int column, double value);
  /// A longer change of the table; MC_CamIn refuses it until its end. 240010 if a coupling locks it.
  ErrorId begin_table_change(std::uint16_t id);
  void end_table_change(std::uint16_t id) { tables_.end_change(id); }
  [[nodiscard]] const CamTables& tables() const { return tables_; }

  /// MC_CamIn, MC_GearIn. `again` is the ticket of the block's own coupling, if it has one: a non-periodic
  /// pass under way is then given one pass more instead of being engaged anew.
  Order cam_in(const CamInRequest& request, std::uint64_t again = 0);
  Order gear_in(const GearInRequest& request);
  /// MC_SetPosition, see Axis::set_position. 44020 while a slave follows the axis: it would leap.
  ErrorId set_position(AxisRef axis, double position, bool relative);
  /// MC_Phasing: shifts the apparent master of the slave; does not take the axis from its coupling.
  ErrorId phase(AxisRef master, AxisRef slave, double shift, const Dynamics& dynamics);

  /// One cycle: actual values, setpoints (masters before slaves), position controllers.
  void cycle();

 private:
  [[nodiscard]] bool locked(std::uint16_t table) const;
  [[nodiscard]] bool follows(const Axis& slave, const Axis& master) const;
  ErrorId check_axes(AxisRef master, AxisRef slave) const;
  ErrorId check_cam(const CamInRequest& request, const CamTable& table, Interpolation interpolation) const;
  ErrorId check_curve(const CamInRequest& request, const CamCurve& curve) const;
  void refresh(Axis& slave);
  void set_points(std::size_t number);

  std::int64_t cycle_ns_;
  std::deque<Axis> axes_;
  std::vector<bool> moved_;
  CamTables tables_;
};

}  // namespace drycut::devices::plcopen
