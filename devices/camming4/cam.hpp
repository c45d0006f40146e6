#pragma once
#include <array>
#include <cstdint>
#include <limits>

#include "devices/camming4/sector.hpp"

namespace drycut::devices::camming4 {

inline constexpr int cam_rows = 128;

/// The columns of the cam table.
enum class Column : std::uint8_t { codeG, codeQm, codeQs, codeQma, codeQsa, codeM };

/// Where a cam starts: the master's exact count at the command, or the count latched at the interrupt's
/// edge; the slave's theoretical position.
struct CamStart {
  std::int64_t master_count = 0;  ///< [bits x4]
  std::int64_t slave_bits = 0;    ///< [bits x4]
  double slave_fraction = 0;      ///< of a bit, 0 <= fraction < 1

  void visit(StateArchive& archive);
};

/// What the cam needs at every sampling. `grains` of a position: 1 Um = `pulse` grains, 1 bit = `measure`
/// grains (exact.hpp), so positm = trunc(master_grains / pulsem) and posit = trunc(slave_grains / pulse).
struct CamSample {
  std::int64_t master_count = 0;   ///< goes on across counter updates and changes of mtype [bits x4]
  std::int64_t master_grains = 0;  ///< positm's grains at master_count
  std::int64_t slave_count = 0;    ///< any count of the slave, on the scale of CamStart::slave_bits [bits x4]
  std::int64_t slave_grains = 0;   ///< posit's grains at slave_count
  double master_speed = 0;         ///< present, for warnings 1 and 2 at a sector's entry [master Um/s]
  double proven_speed = 0;  ///< the same inside a sector: what no single bit makes greater [master Um/s]
  double master_way = 0;    ///< in one sampling, for error 4 [bits x4]; 0 = not known, not judged
};

/// The slave's largest gradients, for warnings 1 and 2 only [slave Um/s2]: maxvel/taccmax, maxvel/tdecmax.
struct CamLimits {
  double acceleration = std::numeric_limits<double>::infinity();
  double deceleration = std::numeric_limits<double>::infinity();

  void visit(StateArchive& archive);
};

/// What one sampling of the cam gives.
struct CamStep {
  bool running = false;         ///< st_camex
  bool ended = false;           ///< row 136 was met in this sampling
  bool waiting = false;         ///< in sector 160, before its quota
  int row = 0;                  ///< rowex, 0 = no cam
  std::int32_t codeM = 0;       ///< codeMex
  std::int64_t slave_bits = 0;  ///< theoretical position, whole bits x4 (rounded down)
  double slave_fraction = 0;    ///< and the rest of it, 0 <= fraction < 1 [bits x4]
  double ratio = 0;             ///< speed, slave Um per master Um; 0 while the slave is held at a boundary
  CamEvent error;               ///< the cam has stopped where it was
  std::array<CamEvent, 8> warnings{};
  int warning_count = 0;
  std::int64_t master_shift = 0;  ///< to take off positm's grains (counter updates, LOOP, gearing)
  std::int64_t slave_shift = 0;   ///< to take off posit's grains
  std::int64_t recovery = 0;      ///< RSV: correction to superimpose [slave Um]
  int recovery_row = 0;
  struct ReadOut {
    int row = 0;
    std::int32_t codeQma = 0;

    void visit(StateArchive& archive);
  };
  std::array<ReadOut, 24> read_outs{};  ///< codeQma values that the cam wrote into its table (170-175, 190)
  int read_out_count = 0;

  void visit(StateArchive& archive);
};

/// The cam generator of CAMMING4 (spec qem.md 8.4-8.8; 000 1.2): a table of sectors run against a master
/// count. A plain value: a copy runs on its own. Exact: sector boundaries are whole grains (exact.hpp) that
/// are never rounded, so the slave does not drift however long the cam loops.
class Cam {
 public:
  /// Resolutions and decpt; only while no cam runs.
  void set(const CamSettings& settings);
  void set(const CamLimits& limits) { limits_ = limits; }

  /// A row of the table, `number` 1..128.
  [[nodiscard]] const Row& row(int number) const { return table_[static_cast<std::size_t>(number - 1)]; }
  /// Writes the table, any time. A write to the row after the running one waits for the next time that row
  /// is reached. The caller asks refuses() first.
  void write(int number, Column column, std::int32_t value);
  /// Error 5 if it is written: the row runs (of a gearing codeQs and codeQsa may be).
  [[nodiscard]] bool refuses(int number, Column column) const;

  /// STARTCAM: row 1 from the next advance(). The codeQma of all 190 rows becomes 0.
  void start(const CamStart& start);
  /// Leaves the cam at once (STOPCAM, EMRG); the last step keeps position and ratio.
  void stop();
  /// One sampling. Without a cam it gives the last position, held.
  const CamStep& advance(const CamSample& sample);
  [[nodiscard]] const CamStep& step() const { return step_; }
  [[nodiscard]] bool running() const { return step_.running; }

  /// The sector that runs, for validation: sample its law with at(). Only while step().running and not
  /// step().waiting. Its place on the axes is exact.
  [[nodiscard]] const Sector& sector() const { return sectors_[static_cast<std::size_t>(current_ - 1)]; }
  [[nodiscard]] const Point& master_origin() const { return master_origin_; }
  [[nodiscard]] const Point& slave_origin() const { return slave_origin_; }

  void visit(StateArchive& archive);

 private:
  enum class State : std::uint8_t { idle, entering, waiting, moving };

  // Rows (cam_rows.cpp).
  void run_rows(int number, const CamSample& sample);
  int execute(int number, const CamSample& sample);
  int enter(const Code& code, const Row& row, int number, const CamSample& sample);
  int wait_for_quota(const Row& row, int number, const CamSample& sample);
  int jump_to(std::int32_t target, int from);
  int conditional_jump(const Row& row, int number);
  void update_counts(const Row& row, const CamSample& sample);
  void close_loop();
  Row take(int number);
  void fetch_next(int number);
  void end();

  // Following the master (cam.cpp).
  void follow(const CamSample& sample);
  void gear(const CamSample& sample);
  void go_back(const CamSample& sample);
  void leave_forward(const CamSample& sample);
  void run_laps(std::int64_t laps);
  void change_ratio(std::int32_t slave);
  void rebase(std::int64_t master_count);
  void wrap_counts(const CamSample& sample);
  bool quota_passed(const CamSample& sample);
  CamMotion show(double m);
  void run_to(const Space& length, const CamSample& sample);
  void pass_boundary(const Space& beyond, bool backwards, const CamSample& sample);
  [[nodiscard]] bool over_too_soon(const Space& left, const CamSample& sample) const;
  void hold(const Point& slave);
  [[nodiscard]] Space covered(std::int64_t master_count) const;
  [[nodiscard]] double master_um(const Space& length) const;
  [[nodiscard]] Sector& current() { return sectors_[static_cast<std::size_t>(current_ - 1)]; }
  [[nodiscard]] Row& stored(int number) { return table_[static_cast<std::size_t>(number - 1)]; }
  [[nodiscard]] std::int64_t master_value(const Point& point, const CamSample& sample) const;
  [[nodiscard]] std::int64_t slave_value(const Point& point, const CamSample& sample) const;

  int fail(int code, int number);
  void warn(int code, int number);
  void read_out(int number, double um);

  CamSettings settings_;
  CamLimits limits_;
  std::array<Row, cam_rows> table_{};
  std::array<Sector, cam_rows> sectors_{};  ///< as last entered, for a master that comes back
  CamStep step_;

  State state_ = State::idle;
  int current_ = 1;      ///< row that runs
  Row next_;             ///< the row after it, as it was when the running row was entered
  int next_row_ = 0;     ///< 0 = not fetched
  Point master_origin_;  ///< start of the running sector
  Point slave_origin_;
  Point loop_master_;  ///< where the spaces that LOOP takes off begin
  Point loop_slave_;
  double speed_ = 0;            ///< exit speed of the last movement sector
  Softening softening_;         ///< of the change that the last sector began
  bool softening_due_ = false;  ///< the last sector asked for one
  bool beginning_ = false;      ///< no movement, no jump, no 160, no 180 since the start
  bool jumped_ = false;         ///< since the last movement
  bool adjacent_ = false;       ///< the last row was the movement before
  bool armed_ = false;          ///< the master has been below the quota of 160
  std::int64_t quota_ = 0;      ///< of 160 [grains]
  int zero_rows_ = 0;           ///< in sequence
  int update_rows_ = 0;
  std::int64_t last_master_ = 0;
  double inside_ = 0;       ///< samplings since the master passed into the running sector
  bool came_back_ = false;  ///< it came over the sector's end
  bool told_gain_ = false;  ///< warning 1 was given for the running sector
  bool told_loss_ = false;  ///< warning 2 was
  std::int64_t laps_ = 0;   ///< of a gearing
  bool regeared_ = false;   ///< its ratio has changed, its way back is lost
};

}  // namespace drycut::devices::camming4
