#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "devices/axis/analogue_positioner.hpp"
#include "devices/camming4/cam.hpp"
#include "devices/camming4/table.hpp"

namespace drycut::devices {
struct CamMoment;
struct CamTable;
}  // namespace drycut::devices

namespace drycut::devices::camming4 {

/// The calculations that follow writes of parameters, spread over samples as the manual's table says (000
/// 1.4); an event of the interrupt input waits for those that were asked for before it.
///
/// Of several writes the manual says nothing. Reading: one calculation comes after the other, so their
/// samples add up; what belongs to one calculation is done once, however much of it was written: a row of the
/// cam table, a ratio (measure and pulse, measurem and pulsem), the scale of speeds (decpt and unitvel). A
/// write of what is being calculated begins that one anew.
class Recalculation {
 public:
  /// A write of `variable`, for a cam table's variable of `row` (0-based).
  void written(int variable, int row);
  /// One sample of calculating.
  void sample();
  /// Samples until all is done.
  [[nodiscard]] int left() const { return left_; }
  void visit(StateArchive& archive);

 private:
  std::array<std::uint8_t, table::variables.size() + cam_rows> of_each_{};  ///< samples left, by calculation
  int left_ = 0;                                                            ///< their sum
};

/// An edge of an armed input: where the axes were, to the count.
struct Capture {
  std::int64_t slave = 0;  ///< totals [bits x4]
  std::int64_t master = 0;
  std::int64_t start = 0;         ///< master's origin of a cam that it starts
  std::optional<int> delay = {};  ///< samples of recalculation that it waits for, once sampled
  bool late = false;              ///< it waited (warning 8)

  void visit(StateArchive& archive);
};

/// The CAMMING4 device: a positioner and a cam generator on one slave axis (000 1; spec qem.md 8).
class Camming4 final : public axis::AnaloguePositioner<camming4_type> {
 public:
  /// `resources` as the .CNF record gives them, in the order of DeviceType::fields; terminals that the cards
  /// lack are added.
  Camming4(const Resources& resources, Cards& cards);

  void interrupt(int line, bool rising) override;
  void power_up() override;
  [[nodiscard]] std::optional<CamAxis> cam_axis() override;
  void visit(StateArchive& archive) override;

 protected:
  void latch() override;
  void initialise() override;
  void execute(int command) override;
  void step() override;
  bool may_write(Symbol symbol, std::int32_t value) override;
  void written(Symbol symbol, std::int32_t value) override;
  bool may_execute(int command) override;
  void refused(int command) override;

 private:
  /// The terminals of the record; nullptr or line 0 where the .CNF says X.X or X.
  struct Terminals {
    std::array<const Counter*, 2> master = {};  ///< A and B
    const DigitalInput* enable_master = nullptr;
    const DigitalInput* input = nullptr;
    const DigitalInput* interrupt_level = nullptr;
    DigitalOutput* output = nullptr;
    int zero_line_master = 0;
    int function_line = 0;
  };

  // Parameters (camming4_parameters.cpp).
  void recompute();
  void load_table();
  void write_row(Symbol symbol, std::int32_t value);
  void write_position(VariableRow variable, std::int32_t value);
  void check_resolution(VariableRow measure, VariableRow pulse, axis::Resolution resolution);

  // Commands (camming4_commands.cpp).
  void start_cam(std::int64_t master);
  void stop_cam();
  void leave_cam();
  void emergency();
  void rest();
  void fail(int code, int row);
  void warn(int code, int row);

  // The cam as others see it (camming4_cam_axis.cpp).
  [[nodiscard]] CamMoment cam_moment() const;
  [[nodiscard]] std::shared_ptr<const devices::CamTable> cam_table() const;

  // Inputs and presets (camming4_inputs.cpp).
  void sample_inputs();
  void run_function(int function, const Capture& capture, std::string_view subject);
  void function_start(const Capture& capture, std::string_view subject);
  void report_refusal(std::string_view what, std::string_view subject);
  void sample_master_preset();

  // The periodic step (camming4.cpp).
  void step_cam();
  void step_recovery();
  void reset_recovery();
  void regulate();
  void publish();
  void drive_output();
  [[nodiscard]] double master_speed(std::int64_t bits) const;
  [[nodiscard]] double proven_way() const;
  [[nodiscard]] double master_rate() const;
  [[nodiscard]] double cam_speed() const;
  [[nodiscard]] axis::Demand straight_demand() const;
  [[nodiscard]] std::int64_t master_raw() const;

  Terminals terminals_;

  axis::Transducer master_;
  axis::Quota master_quota_;
  axis::Resolution master_resolution_;
  axis::FrequencyMeter master_frequency_;
  int master_window_ms_ = 240;
  /// Totals of the last samples. The master's speed is taken over all of them: one bit more or less in a
  /// sample is no acceleration.
  std::array<std::int64_t, 16> master_history_{};
  std::size_t master_history_next_ = 0;
  std::int64_t master_way_ = 0;    ///< over the history [bits x4]
  std::int64_t master_moved_ = 0;  ///< in the last sample [bits x4]
  double master_rate_ = 0;         ///< at the cam's last step, smoothed [bits x4 a sample]

  Cam cam_;
  CamStart cam_start_;            ///< of the last cam
  std::uint64_t cam_starts_ = 0;  ///< so far
  std::int64_t slip_ = 0;         ///< LOOPON in a cam: the axis runs so far off its table [bits x4]
  bool slip_due_ = false;
  axis::Profile recovery_;             ///< RSV: the correction that runs beside the cam
  std::int64_t recovery_due_ = 0;      ///< [Um] not yet begun
  std::int64_t recovery_running_ = 0;  ///< [Um]
  std::int64_t recovery_done_ = 0;     ///< [Um] since the cam began
  double recovery_way_ = 0;            ///< of the running correction [bits x4]

  bool enable_master_was_ = true;            ///< a preset without search needs a release first
  bool master_released_ = false;             ///< prsmodem 1: the enable was released, a zero pulse loads
  std::optional<std::int64_t> zero_master_;  ///< total at a zero pulse since the last sample

  bool input_was_ = false;
  std::optional<Capture> capture_;  ///< of the interrupt input, to be run at the next sample
  Recalculation recalculation_;
  int inhibit_stop_ms_ = 0;  ///< functions 11 and 12
};

std::unique_ptr<Device> make_camming4(const Resources& resources, Cards& cards);

}  // namespace drycut::devices::camming4
