#include "devices/lx3vp/ecamtbx.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::devices::lx3vp {

namespace {

/// Rows inside each piece: one for every curved piece, each further one where rows are farthest apart.
std::optional<std::vector<int>> share(const CamProfile& profile, int resolution) {
  std::vector<int> inside(profile.pieces.size(), 0);
  int left = resolution - static_cast<int>(profile.pieces.size()) - 1;
  bool curved = false;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (!ratio_of(profile.pieces[i]).is_curved()) continue;
    curved = true;
    inside[i] = 1;
    --left;
  }
  if (left < 0) return {};
  while (curved && left-- > 0) {
    std::size_t widest = inside.size();
    double gap = 0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const double apart = profile.pieces[i].length / (inside[i] + 1);
      if (inside[i] == 0 || apart <= gap * (1 + 1e-12)) continue;  // of equal ones the first
      gap = apart;
      widest = i;
    }
    ++inside[widest];
  }
  return inside;
}

/// Nearest pulse, halves away from 0 even where rounding has left a little less than half.
std::int64_t nearest_pulse(double position) {
  constexpr double noise = 1e-7;
  return std::llround(position + std::copysign(noise, position));
}

class ProfileRows {
 public:
  ProfileRows(const CamProfile& profile, const TableEnd& end) : profile_(profile), end_(end) {}

  /// Adds the row at a master position; false if it is the row before.
  bool add(double master) {
    const auto rounded =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(nearest_pulse(master), 0, end_.master));
    if (!rows_.empty() && rows_.back().master == rounded) return false;
    rows_.push_back({rounded, slave_at(rounded)});
    return true;
  }
  std::vector<CamTableRow> finish() {
    add(end_.master);
    rows_.back().slave = end_.slave;
    return std::move(rows_);
  }

 private:
  [[nodiscard]] std::int32_t slave_at(std::int32_t master) const {
    return static_cast<std::int32_t>(nearest_pulse(at(profile_, master).position));
  }
  const CamProfile& profile_;
  TableEnd end_;
  std::vector<CamTableRow> rows_;
};

/// A master position that is a row, strictly inside a piece after rounding.
bool has_row_inside(const CamPiece& piece, double place) {
  const auto row = nearest_pulse(place);
  return row > nearest_pulse(piece.master) && row < nearest_pulse(piece.master + piece.length);
}

}  // namespace

std::optional<std::vector<CamTableRow>> sample_rows(const CamProfile& profile, const TableEnd& end,
                                                    int resolution) {
  if (end.master <= 0) return {};
  const auto inside = share(profile, resolution);
  if (!inside) return {};
  ProfileRows rows(profile, end);
  for (std::size_t i = 0; i < profile.pieces.size(); ++i) {
    const auto& piece = profile.pieces[i];
    rows.add(piece.master);
    bool filled = !ratio_of(piece).is_curved();
    for (int n = 1; n <= (*inside)[i]; ++n) {
      const double place = piece.master + piece.length * n / ((*inside)[i] + 1);
      rows.add(place);
      filled = filled || has_row_inside(piece, place);
    }
    if (!filled) return {};
  }
  return rows.finish();
}

double largest_deviation(const EcamResult& result) {
  constexpr int points = 16;
  double most = 0;
  for (std::size_t i = 1; i < result.rows.size(); ++i) {
    const auto& from = result.rows[i - 1];
    const auto& to = result.rows[i];
    const double length = static_cast<double>(to.master) - from.master;
    const double rise = static_cast<double>(to.slave) - from.slave;
    for (int n = 0; n <= points; ++n) {
      const double part = static_cast<double>(n) / points;
      const double law = at(result.profile, from.master + part * length).position;
      most = std::max(most, std::abs(from.slave + part * rise - law));
    }
  }
  return most;
}

}  // namespace drycut::devices::lx3vp
