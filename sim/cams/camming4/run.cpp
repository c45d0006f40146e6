#include "sim/cams/camming4/run.hpp"

#include <algorithm>
#include <cmath>

#include "devices/axis/position.hpp"
#include "devices/camming4/cam.hpp"

namespace drycut::sim::cams {

namespace {

using devices::camming4::Cam;
using devices::camming4::CamLimits;
using devices::camming4::CamSample;
using devices::camming4::CamStep;
using devices::camming4::CodeClass;
using devices::camming4::Column;
using devices::camming4::GrainResolution;
using devices::camming4::Point;
using devices::camming4::Row;
using devices::camming4::Sector;

double to_um(const Point& point, const GrainResolution& axis) {
  const double grains = static_cast<double>(point.bits) * static_cast<double>(axis.measure) +
                        static_cast<double>(point.part) + point.fraction;
  return grains / static_cast<double>(axis.pulse);
}

/// The first count at or behind a point.
std::int64_t count_at(const Point& point) { return point.bits + (point.part > 0 || point.fraction > 0); }

CamLimits limits_of(const CammingTable& table) {
  CamLimits limits;
  const double max_um = table.maxvel * um_per_second(table);
  if (table.maxvel > 0 && table.taccmax > 0) limits.acceleration = max_um * 100 / table.taccmax;
  if (table.maxvel > 0 && table.tdecmax > 0) limits.deceleration = max_um * 100 / table.tdecmax;
  return limits;
}

/// The engine with the counters that a device would keep around it, the slave exactly where theory wants it.
class Walk {
 public:
  Walk(const CammingTable& table, const CamDuty& duty, int passes) : table_(table), passes_(passes) {
    for (int number = 1; number <= devices::camming4::cam_rows; ++number) {
      const Row& row = table.sector(number).row;
      cam_.write(number, Column::codeG, row.codeG);
      cam_.write(number, Column::codeQm, row.codeQm);
      cam_.write(number, Column::codeQs, row.codeQs);
      cam_.write(number, Column::codeQma, row.codeQma);
      cam_.write(number, Column::codeQsa, row.codeQsa);
      cam_.write(number, Column::codeM, row.codeM);
    }
    cam_.set(table.settings);
    cam_.set(limits_of(table));
    if (duty.master_speed) master_um_per_s_ = *duty.master_speed * um_per_second(table);
  }

  CamRun run() {
    run_.passes = 1;
    run_.drawn = 64;
    cam_.start({});
    leave(1, 0);
    while (!over_) {
      if (run_.visits.size() >= CamRun::most_visits)
        finish(CamRun::End::cut_short);
      else if (cam_.step().waiting)
        wait();
      else if (cam_.sector().kind == Sector::Kind::gearing)
        gear();
      else
        leave(cam_.step().row + 1, count_at(sector_end()));
    }
    run_.law = law_of(run_.visits, run_.shown);
    run_.lets_go = run_.end == CamRun::End::ended && run_.shown == run_.visits.size();
    if (master_um_per_s_ > 0) run_.master_speed = master_um_per_s_;
    return std::move(run_);
  }

 private:
  [[nodiscard]] Point sector_end() const {
    return moved(cam_.master_origin(), cam_.sector().master, table_.settings.master.measure);
  }

  /// One sampling: the master goes to `count`.
  const CamStep& sample(std::int64_t count) {
    const auto& settings = table_.settings;
    using devices::camming4::add;
    using devices::camming4::multiply;
    master_grains_ = add(master_grains_, multiply(count - master_, settings.master.measure));
    master_ = count;
    const CamStep& step = cam_.advance({master_, master_grains_, slave_, slave_grains_, master_um_per_s_});
    master_grains_ -= step.master_shift;
    slave_grains_ =
        add(slave_grains_, multiply(step.slave_bits - slave_, settings.slave.measure) - step.slave_shift);
    slave_ = step.slave_bits;
    return step;
  }

  /// The sampling at `count` leaves what runs for row `next` and what follows it.
  void leave(int next, std::int64_t count) {
    const double speed = run_.visits.empty() ? 0 : run_.visits.back().exit_speed();
    const Passage passage = walk_rows(next);
    const CamStep& step = sample(count);
    close_visit();
    for (int i = passage.rounds_before(step.error.row); i > 0; --i) come_round();
    note_events(step, speed);
    if (step.error.code != 0)
      finish(CamRun::End::failed);
    else if (step.ended) {
      run_.end_speed = speed;
      finish(CamRun::End::ended);
    } else if (pass_ > passes_ + 1)
      finish(CamRun::End::came_round);
    else
      open_visit(step);
  }

  void note_events(const CamStep& step, double speed) {
    const auto note = [&](bool error, const devices::camming4::CamEvent& event) {
      const bool entered = step.running && event.row == step.row;
      run_.events.push_back(
          {error, event.code, event.row, pass_, run_.visits.size() + (entered ? 1 : 0), speed});
    };
    for (int i = 0; i < step.warning_count; ++i) note(false, step.warnings[static_cast<std::size_t>(i)]);
    if (step.error.code != 0) note(true, step.error);
  }

  /// Rows without master space as the engine will do them, true for those that lead back.
  struct Passage {
    std::vector<std::pair<int, bool>> rows;

    /// How often they lead round, up to a row that fails; 0 = none does.
    [[nodiscard]] int rounds_before(int failed) const {
      const auto end = std::find_if(rows.begin(), rows.end(), [&](auto row) { return row.first == failed; });
      return static_cast<int>(std::count_if(rows.begin(), end, [](auto row) { return row.second; }));
    }
  };

  Passage walk_rows(int number) {
    constexpr std::size_t most = 32;  // the engine refuses more than 9 and 4
    Passage passage;
    while (passage.rows.size() < most && number >= 1 && number <= devices::camming4::cam_rows) {
      const Row& row = cam_.row(number);
      const auto* code = devices::camming4::find_code(row.codeG);
      if (code == nullptr || code->what == CodeClass::start_sync) break;
      if (code->what == CodeClass::movement && !is_empty_movement(*code, row)) break;
      passage.rows.emplace_back(number, false);
      if (code->what == CodeClass::end) break;
      int next = number + 1;
      if (code->what == CodeClass::jump) next = row.codeQm;
      if (code->what == CodeClass::loop) next = 1;
      if (code->what == CodeClass::conditional_jump && row.codeQma < row.codeQs)
        next = row.codeQm;
      else
        passage.rows.back().second = next <= number;
      number = next;
    }
    if (passage.rows.empty()) return passage;
    run_.passages.push_back({{}, pass_, run_.visits.size()});
    for (const auto& row : passage.rows) run_.passages.back().rows.push_back(row.first);
    return passage;
  }

  void open_visit(const CamStep& step) {
    CamVisit visit;
    visit.row = step.row;
    visit.pass = pass_;
    visit.waiting = step.waiting;
    if (!step.waiting) visit.sector = cam_.sector();
    visit.master_start = to_um(cam_.master_origin(), table_.settings.master);
    visit.slave_start = to_um(cam_.slave_origin(), table_.settings.slave);
    run_.visits.push_back(std::move(visit));
    open_ = true;
  }

  /// The engine stands at the end of the visit: its origins are the visit's end.
  void close_visit() {
    if (!open_) return;
    CamVisit& visit = run_.visits.back();
    visit.master_length = to_um(cam_.master_origin(), table_.settings.master) - visit.master_start;
    visit.slave_length = to_um(cam_.slave_origin(), table_.settings.slave) - visit.slave_start;
    open_ = false;
  }

  void come_round() {
    // What the device's counts show at the exact boundary.
    const auto shown = [](std::int64_t grains, const Point& origin, std::int64_t count,
                          const GrainResolution& axis) {
      const double ahead = static_cast<double>(origin.bits - count) * static_cast<double>(axis.measure) +
                           static_cast<double>(origin.part) + origin.fraction;
      return (static_cast<double>(grains) + ahead) / static_cast<double>(axis.pulse);
    };
    const double master = shown(master_grains_, cam_.master_origin(), master_, table_.settings.master);
    const double slave = shown(slave_grains_, cam_.slave_origin(), slave_, table_.settings.slave);
    if (pass_ > 1) {
      run_.master_growth = master - master_shown_;
      run_.slave_growth = slave - slave_shown_;
    }
    master_shown_ = master;
    slave_shown_ = slave;
    if (pass_ == passes_) show_all();
    ++pass_;
  }

  /// What ran so far is what was asked for.
  void show_all() {
    run_.shown = run_.visits.size();
    run_.passes = std::min(pass_, passes_);
  }

  // Sector 160: the master goes on to the quota; above it at the start, it would have to come back first.
  void wait() {
    const auto& axis = table_.settings.master;
    const std::int64_t quota = devices::camming4::multiply(cam_.row(cam_.step().row).codeQm, axis.pulse);
    const std::int64_t missing = quota - master_grains_;
    if (missing < 0) {
      close_visit();
      finish(CamRun::End::held);
      return;
    }
    leave(cam_.step().row + 1, master_ + (missing + axis.measure - 1) / axis.measure);
  }

  // A gearing turns for ever. It is shown for one lap and then left as a program would, if anything follows.
  void gear() {
    const int row = cam_.step().row;
    const std::int64_t end = count_at(sector_end());
    for (const std::int64_t count : {master_ + (end - master_) / 2, end}) {
      const CamStep& step = sample(count);
      if (step.error.code == 0) continue;
      close_visit();
      note_events(step, run_.visits.back().exit_speed());
      finish(CamRun::End::failed);
      return;
    }
    if (std::find(run_.released.begin(), run_.released.end(), row) == run_.released.end())
      run_.released.push_back(row);
    if (!table_.has(row + 1)) {
      close_visit();
      finish(CamRun::End::geared);
      return;
    }
    cam_.write(row, Column::codeQsa, 0);
    leave(row + 1, end);
    if (!over_ && cam_.step().row != row) cam_.write(row, Column::codeQsa, 2);
  }

  void finish(CamRun::End end) {
    run_.end = end;
    over_ = true;
    close_visit();
    if (pass_ <= passes_) show_all();
  }

  const CammingTable& table_;
  int passes_;
  double master_um_per_s_ = 0;
  Cam cam_;
  CamRun run_;
  int pass_ = 1;
  bool over_ = false;
  bool open_ = false;
  std::int64_t master_ = 0;
  std::int64_t master_grains_ = 0;
  std::int64_t slave_ = 0;
  std::int64_t slave_grains_ = 0;
  double master_shown_ = 0;
  double slave_shown_ = 0;
};

}  // namespace

std::vector<devices::CamPiece> CamVisit::pieces() const {
  devices::CamPiece piece{master_start, master_length, slave_start, row, devices::CamRamp{.length = 1}};
  if (waiting) return {piece};
  if (sector.kind == Sector::Kind::arc_x || sector.kind == Sector::Kind::arc_y) {
    const bool x = sector.kind == Sector::Kind::arc_x;
    piece.law = devices::CamArc{sector.arc, x ? devices::ArcAxis::x : devices::ArcAxis::y};
    if (master_length <= 0) piece.length = sector.arc.length;
    return {piece};
  }
  std::vector<devices::CamPiece> pieces;
  const auto& law = sector.law;
  const double whole = master_length > 0 ? master_length : law.length;
  for (int i = 0; i < law.count; ++i) {
    auto ramp = law.ramps[static_cast<std::size_t>(i)];
    const double end = i + 1 < law.count ? law.ramps[static_cast<std::size_t>(i) + 1].from : whole;
    piece.master = master_start + ramp.from;
    piece.length = end - ramp.from;
    ramp.start -= ramp.from;
    piece.law = ramp;
    pieces.push_back(piece);
  }
  return pieces;
}

devices::CamLaw law_of(const std::vector<CamVisit>& visits, std::size_t count) {
  devices::CamLaw law;
  while (count > 0 && visits[count - 1].master_length <= 0) --count;
  for (std::size_t i = 0; i < count; ++i) {
    const CamVisit& visit = visits[i];
    for (auto& piece : visit.pieces())
      if (piece.master == visit.master_start || piece.master < visit.master_end())
        law.pieces.push_back(std::move(piece));
    law.master_length = visit.master_end();
    law.slave_length = visit.slave_start + visit.slave_length;
  }
  return law;
}

double peak_speed(const CamVisit& visit) { return peak_of(visit.pieces(), devices::CamOrder::velocity); }

double peak_gradient(const CamVisit& visit) {
  return peak_of(visit.pieces(), devices::CamOrder::acceleration);
}

devices::CamExtremes reach_of(const CamVisit& visit) {
  const double start = visit.slave_start;
  if (visit.master_length <= 0) return {start, start};
  const auto reach = reach_of(visit.pieces());
  return {std::min(start, reach.low), std::max(start, reach.high)};
}

double um_per_second(const CammingTable& table) {
  return devices::axis::um_per_second(table.settings.decpt, table.unitvel);
}

std::string speed_unit(const CammingTable& table) {
  return std::string(table.settings.decpt == 0 ? "Um" : "unit") + (table.unitvel == 1 ? "/s" : "/min");
}

CamRun run_cam(const CammingTable& table, const CamDuty& duty, int passes) {
  return Walk(table, duty, passes).run();
}

}  // namespace drycut::sim::cams
