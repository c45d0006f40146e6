#include "sim/cams/camming4/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "devices/camming4/cam.hpp"
#include "devices/camming4/messages.hpp"
#include "sim/cams/judge.hpp"

namespace drycut::sim::cams {

namespace {

namespace camming4 = devices::camming4;
using camming4::CodeClass;
using camming4::Row;
using devices::CamOrder;
using Grade = CamFinding::Grade;

class CammingJudge {
 public:
  CammingJudge(const CammingTable& table, const CamDuty& duty, const CamRun& run)
      : table_(table), duty_(duty), run_(run) {
    if (duty.master_speed) master_ = *duty.master_speed * um_per_second(table);
  }

  std::vector<CamFinding> findings() {
    judge_passages();
    judge_events();
    for (std::size_t i = 0; i < run_.visits.size(); ++i) judge_visit(run_.visits[i], i + 1);
    judge_frequencies();
    judge_travel();
    judge_end();
    judge_unreached();
    remark_on_end();
    std::stable_sort(found_.begin(), found_.end(),
                     [](const auto& a, const auto& b) { return a.order < b.order; });
    std::vector<CamFinding> findings;
    for (auto& entry : found_) findings.push_back(std::move(entry.finding));
    return findings;
  }

 private:
  static constexpr std::size_t last = SIZE_MAX;

  /// `order`: number of sectors begun before or with it.
  void add(Code kind, std::size_t order, Grade grade, int code, int row, int pass, std::string text,
           CamRemedy remedy = {}) {
    if (!told_.emplace(grade, code, row, grade == Grade::error || grade == Grade::warning ? "" : text).second)
      return;
    found_.push_back({order, {kind, grade, code, where(row, pass), std::move(text), std::move(remedy)}});
  }

  /// "sector 4 (135 DZC) in pass 2", "" for row 0.
  [[nodiscard]] std::string where(int row, int pass) const {
    if (row <= 0) return "";
    auto text = fmt::format("sector {}", row);
    const int codeG = table_.sector(row).row.codeG;
    if (codeG > 0) text += fmt::format(" ({})", code_text(codeG));
    if (pass > 1) text += fmt::format(" in pass {}", pass);
    return text;
  }

  void judge_events() {
    for (const auto& event : run_.events) {
      const CamVisit* visit = nullptr;
      if (event.visits > 0 && event.visits <= run_.visits.size() &&
          run_.visits[event.visits - 1].row == event.row)
        visit = &run_.visits[event.visits - 1];
      const int row_before = event.visits > 1 ? run_.visits[event.visits - 2].row : 0;
      auto advice = advice_on(event, visit, row_before, table_, duty_);
      add("cam.device"_code, event.visits, event.error ? Grade::error : Grade::warning, event.number,
          event.row, event.pass, std::move(advice.text), std::move(advice.remedy));
    }
  }

  // 000 1.10, limitations 1 and 2, are stricter than what raises error 1 (000 1.2.11, 1.2.12; D31).
  void judge_passages() {
    constexpr std::ptrdiff_t most_zero = 7;
    constexpr std::ptrdiff_t most_updates = 3;
    constexpr std::ptrdiff_t error_zero = 9;
    constexpr std::ptrdiff_t error_updates = 4;
    for (const auto& passage : run_.passages) {
      const auto updates = std::count_if(passage.rows.begin(), passage.rows.end(), [&](int row) {
        const auto* code = camming4::find_code(table_.sector(row).row.codeG);
        return code != nullptr && code->what == CodeClass::count_update;
      });
      const auto zero = static_cast<std::ptrdiff_t>(passage.rows.size()) - updates;
      if (zero > most_zero && zero <= error_zero)
        add("cam.manual-limits"_code, passage.visits, Grade::caution, 0, passage.rows.front(), passage.pass,
            fmt::format("{} rows without master space in sequence", zero),
            fmt::format("the manual's limits (1.10) allow {}", most_zero));
      if (updates > most_updates && updates <= error_updates)
        add("cam.manual-limits"_code, passage.visits, Grade::caution, 0, passage.rows.front(), passage.pass,
            fmt::format("{} count updates in sequence", updates),
            fmt::format("the manual's limits (1.10) allow {}", most_updates));
    }
  }

  void judge_visit(const CamVisit& visit, std::size_t order) {
    if (visit.waiting) return;
    const auto tell = [&](Code kind, Grade grade, int code, std::string text, CamRemedy remedy) {
      add(kind, order, grade, code, visit.row, visit.pass, std::move(text), std::move(remedy));
    };
    const auto tell_all = [&](std::vector<CamFinding> passed) {
      for (auto& limit : passed)
        tell(limit.kind, limit.grade, 0, std::move(limit.text), std::move(limit.remedy));
    };
    const double gradient = peak_gradient(visit);
    if (master_ > 0) {
      judge_sampling(visit, tell);
      tell_all(passed_limits(motion_, CamOrder::velocity, peak_speed(visit)));
      tell_all(passed_limits(motion_, CamOrder::acceleration, gradient,
                             [&](double limit) { return gradient_remedy(visit, table_, gradient, limit); }));
    }
    judge_change_of_ratio(visit.sector.row, tell);
  }

  /// Once, where it is worst: the transducers are wrong, not the sectors.
  void judge_frequencies() {
    const auto& axes = table_.settings;
    const double bits = static_cast<double>(axes.slave.pulse * axes.master.measure) /
                        static_cast<double>(axes.slave.measure * axes.master.pulse);
    double most = 1.5 * within;
    std::size_t worst = run_.visits.size();
    for (std::size_t i = 0; i < run_.visits.size(); ++i) {
      const double times = peak_speed(run_.visits[i]) * bits;
      if (times <= most) continue;
      most = times * within;
      worst = i;
    }
    if (worst == run_.visits.size()) return;
    const auto& visit = run_.visits[worst];
    add("cam.resolution"_code, worst + 1, Grade::caution, 0, visit.row, visit.pass,
        fmt::format("the slave's transducer gives {} times as many bits as the master's; 1.5 is the most",
                    number(peak_speed(visit) * bits)),
        "use a finer transducer on the master or a coarser one on the slave (manual 1.6)");
  }

  /// Once for each end, where the slave is farthest.
  void judge_travel() {
    if (!table_.travel.is_given() || run_.visits.empty()) return;
    struct Place {
      double slave = 0;
      std::size_t visit = 0;
    };
    Place low;
    Place high;
    for (std::size_t i = 0; i < run_.visits.size(); ++i) {
      const auto reach = reach_of(run_.visits[i]);
      if (reach.low < low.slave) low = {reach.low, i};
      if (reach.high > high.slave) high = {reach.high, i};
    }
    for (auto& fault : travel_faults(table_.travel, low.slave, high.slave, {"minpos", "maxpos", "Um", ""})) {
      const auto place = (fault.above ? high : low).visit;
      const auto& visit = run_.visits[place];
      add("cam.travel"_code, place + 1, Grade::limit, 0, visit.row, visit.pass, std::move(fault.text),
          std::move(fault.remedy));
    }
  }

  [[nodiscard]] CamRemedy sampling_remedy(const camming4::Sector& sector, double length) const {
    const auto column = master_column(sector.row);
    const double least = least_master_space(table_, duty_, sector.kind == camming4::Sector::Kind::gearing);
    const bool is_arc = column.name == nullptr;
    auto remedy = slower_master(is_arc ? "" : fmt::format("give it at least {} Um, or ", whole(least)),
                                length * 1000 / table_.TCamp / um_per_second(table_), speed_unit(table_));
    if (!is_arc) remedy.cures.push_back({sector.number, column.name, least - column.other});
    return remedy;
  }

  template <typename Tell>
  void judge_sampling(const CamVisit& visit, const Tell& tell) {
    const double advance = master_ * table_.TCamp / 1000;
    // What the device runs in one piece: of a gearing a lap.
    const double length = visit.sector.kind == camming4::Sector::Kind::gearing
                              ? static_cast<double>(visit.sector.row.codeQm)
                              : visit.master_length;
    if (length * within >= advance) return;
    tell("cam.device"_code, Grade::error, 4,
         fmt::format("master space too small: {} Um are over in {} ms, less than a sampling time of {} ms",
                     number(length), number(length / master_ * 1000), table_.TCamp),
         sampling_remedy(visit.sector, length));
  }

  template <typename Tell>
  void judge_change_of_ratio(const Row& row, const Tell& tell) {
    if (row.codeG != 154 && row.codeG != 254) return;
    if (row.codeQma > 4)
      tell("cam.value"_code, Grade::caution, 0, fmt::format("codeQma {} softens nothing", row.codeQma),
           "give 0 for none or 1 to 4 for 1/2 to 1/5 of the smaller sector");
    if (row.codeQsa < 0 || row.codeQsa > 2)
      tell("cam.value"_code, Grade::caution, 0,
           fmt::format("codeQsa {} has no meaning and acts as 0", row.codeQsa),
           "give 0 movement follows, 1 axis stationary next, 2 gearing");
  }

  void judge_end() {
    const std::size_t order = run_.visits.size();
    const int pass = run_.visits.empty() ? 1 : run_.visits.back().pass;
    if (run_.end == CamRun::End::ended && !camming4::is_standstill(run_.end_speed))
      add("cam.no-ramp"_code, order, Grade::caution, 0, run_.passages.back().rows.back(), pass,
          fmt::format("releases the slave at ratio {}: it stops without a ramp", number(run_.end_speed)),
          "end the sector before it at standstill (135)");
    const auto grows = [&](double growth, const camming4::GrainResolution& axis, const char* name) {
      if (std::abs(growth) < (1 - 1e-6) / static_cast<double>(axis.pulse)) return;
      add("cam.leaves-range"_code, last - 1, Grade::caution, 0, 0, pass,
          fmt::format("{} grows by {} Um each time round and leaves its range in the end", name,
                      number(growth)),
          "take it off before the jump (139), or end the loop with 138");
    };
    grows(run_.master_growth, table_.settings.master, "positm");
    grows(run_.slave_growth, table_.settings.slave, "posit");
  }

  void judge_unreached() {
    std::set<int> reached;
    for (const auto& visit : run_.visits) reached.insert(visit.row);
    for (const auto& passage : run_.passages) reached.insert(passage.rows.begin(), passage.rows.end());
    for (const auto& event : run_.events) reached.insert(event.row);
    std::string rows;
    for (int number = 1; number <= camming4::cam_rows; ++number) {
      if (!table_.has(number) || reached.contains(number)) continue;
      rows += (rows.empty() ? "" : ", ") + std::to_string(number);
      judge_alone(number);
    }
    if (!rows.empty())
      add("cam.not-judged"_code, last, Grade::remark, 0, 0, 1,
          fmt::format("the cam did not reach sector {}", rows));
  }

  /// What is wrong with a row whatever runs before it.
  void judge_alone(int number) {
    const Row& row = table_.sector(number).row;
    const auto* code = camming4::find_code(row.codeG);
    if (code == nullptr) return;
    int error = 0;
    if ((code->what == CodeClass::jump || code->what == CodeClass::conditional_jump) &&
        (row.codeQm < 1 || row.codeQm > camming4::cam_rows))
      error = 6;
    if (code->what == CodeClass::movement && !is_empty_movement(*code, row))
      error = make_sector(*code, row, number, table_.settings, {}).error;
    if (error == 0) return;
    auto advice = advice_on({true, error, number, 1, 0, 0}, nullptr, 0, table_, duty_);
    add("cam.device"_code, last - 1, Grade::caution, 0, number, 1,
        fmt::format("not reached; it would raise error {}: {}", error, advice.text),
        std::move(advice.remedy));
  }

  void remark_on_end() {
    const auto remark = [&](std::string text) {
      add("cam.remark"_code, last, Grade::remark, 0, 0, 1, std::move(text));
    };
    for (const int row : run_.released)
      add("cam.remark"_code, last, Grade::remark, 0, row, 1,
          "a gearing runs until the program writes codeQsa 0 or 1; shown for one lap of codeQm");
    switch (run_.end) {
      case CamRun::End::failed:
        remark("the error stops the cam; what would come after it was not run");
        break;
      case CamRun::End::held:
        remark("the cam stays in sector 160 without end; what follows it was not run");
        break;
      case CamRun::End::cut_short:
        add("cam.not-judged"_code, last - 1, Grade::caution, 0, 0, 1,
            fmt::format("the cam was left after {} sectors; what would come after them was not judged",
                        CamRun::most_visits),
            "validate it with fewer jumps in 190");
        break;
      default:
        break;
    }
  }

  struct Entry {
    std::size_t order;
    CamFinding finding;
  };
  const CammingTable& table_;
  const CamDuty& duty_;
  const CamRun& run_;
  const CamMotionWords motion_ = motion_of(table_, duty_, run_);
  double master_ = 0;  ///< [Um/s], 0 = not given
  std::vector<Entry> found_;
  std::set<std::tuple<Grade, int, int, std::string>> told_;
};

}  // namespace

std::string code_text(int code) {
  const auto* found = camming4::find_code(code);
  return found == nullptr ? std::to_string(code) : fmt::format("{} {}", code, found->mnemonic);
}

std::vector<CamFinding> judge(const CammingTable& table, const CamDuty& duty, const CamRun& run) {
  return CammingJudge(table, duty, run).findings();
}

}  // namespace drycut::sim::cams
