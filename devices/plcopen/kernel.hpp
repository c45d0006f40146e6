#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/plcopen/axis.hpp"
#include "devices/plcopen/cam_table.hpp"

namespace drycut::devices::plcopen {

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
  Axis* axis(AxisRef ref) {
    return ref.number < 0 || ref.number >= axes() ? nullptr
                                                  : axes_[static_cast<std::size_t>(ref.number)].get();
  }
  [[nodiscard]] const Axis* axis(AxisRef ref) const {
    return ref.number < 0 || ref.number >= axes() ? nullptr
                                                  : axes_[static_cast<std::size_t>(ref.number)].get();
  }

  /// Adds or replaces a table; see CamTables::add. 240010 if a coupling locks the one that is there.
  ErrorId add_table(McCamTable table);
  /// See CamTables::write. 240010 if a coupling locks the table.
  ErrorId write_table(std::uint16_t id, std::size_t line, int column, double value);
  /// A longer change of the table; MC_CamIn refuses it until its end. 240010 if a coupling locks it.
  ErrorId begin_table_change(std::uint16_t id);
  void end_table_change(std::uint16_t id) { tables_.end_change(id); }
  [[nodiscard]] const CamTables& tables() const { return tables_; }

  /// Gives `axis` a command: at once, or when its turn has come. `again` is the ticket of MC_CamIn's own
  /// coupling, if it has one: a non-periodic pass under way is then given one pass more instead of being
  /// engaged anew. 44000 if too many commands wait, 65019 if there is no such mode.
  Order give(AxisRef axis, const Request& request, BufferMode mode = BufferMode::aborting,
             std::uint64_t again = 0);
  /// MC_SetPosition, see Axis::set_position. 44020 while a slave follows the axis: it would leap.
  ErrorId set_position(AxisRef axis, double position, bool relative);
  /// MC_Phasing: shifts the apparent master of the slave; does not take the axis from its coupling.
  Order phase(AxisRef master, AxisRef slave, double shift, const Dynamics& dynamics);

  /// One cycle: actual values, setpoints (masters before slaves), position controllers.
  void cycle();

  void visit(StateArchive& archive);

 private:
  [[nodiscard]] bool locked(std::uint16_t table) const;
  [[nodiscard]] bool follows(const Axis& slave, const Axis& master) const;
  [[nodiscard]] Order check_axes(AxisRef master, AxisRef slave) const;
  /// What is wrong with a request whatever the axis does; its turn may come later.
  [[nodiscard]] Order check(AxisRef axis, const Request& request) const;
  Order start(AxisRef axis, const Request& request, std::uint64_t again, std::uint64_t ticket);
  Order cam_in(const CamInRequest& request, std::uint64_t again, std::uint64_t ticket);
  Order gear_in(const GearInRequest& request, std::uint64_t ticket);
  void start_waiting(AxisRef axis);
  [[nodiscard]] Order check_cam(const CamInRequest& request, const McCamTable& table,
                                Interpolation interpolation) const;
  ErrorId check_curve(const CamInRequest& request, const CamCurve& curve) const;
  void refresh(Axis& slave);
  void set_points(std::size_t number);

  std::int64_t cycle_ns_;
  std::vector<std::unique_ptr<Axis>> axes_;  ///< which stay where they are
  std::vector<bool> moved_;
  CamTables tables_;
};

}  // namespace drycut::devices::plcopen
