#include "sim/studies/size/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.hpp"

namespace drycut::sim::studies {

namespace {

/// " at length=500 mm"; " as the scenario is"
std::string behind(const std::string& corner) {
  if (corner.empty()) return "";
  return fmt::format(" {}{}", corner.starts_with(scenario_itself) ? "" : "at ", corner);
}

std::string left_words(const Sized& one) {
  return fmt::format("{:.0f} % left of {}{}", one.reserve, one.nearest, behind(one.hardest));
}

std::string nearest_words(const Candidate& candidate, const Sized& one) {
  const auto& distance = one.distance;
  const auto name = name_of(candidate);
  if (distance.unknown > 0)
    return fmt::format("{}, of which nobody can say how much it is short{}: {}", name, behind(one.where),
                       one.reason);
  if (distance.short_by > 0)
    return fmt::format("{}, {:.{}f} % short of {}{}", name, distance.short_by, distance.short_by < 1 ? 2 : 0,
                       distance.rating, behind(distance.corner));
  return fmt::format("{}, short of no rating, but {}{}", name, one.reason, behind(one.where));
}

std::string inertia_note(const SizeResult& result) {
  if (result.choices.most_inertia_ratio) return "";
  std::set<std::string> motors;
  std::set<std::string> usual;
  std::size_t heavy = 0;
  for (const auto& candidate : result.candidates) {
    if (candidate.limit_from == Candidate::LimitFrom::nobody) continue;
    motors.insert(candidate.motor);
    if (candidate.limit_from == Candidate::LimitFrom::usage) usual.insert(candidate.motor);
    if (candidate.is_too_heavy()) ++heavy;
  }
  if (usual.empty() && heavy == 0) return "";
  auto text = fmt::format("load over rotor inertia: at most what the maker allows");
  if (!usual.empty())
    text += fmt::format("; {:.0f}, as usual, for {} of {}, of which the catalogue has no such value",
                        usual_inertia_ratio, usual.size(), counted(std::ssize(motors), "motor"));
  if (heavy > 0)
    text += fmt::format("; {} beyond it", counted(static_cast<std::int64_t>(heavy), "candidate"));
  return text + "; --inertia-ratio 15 sets another limit, off none";
}

}  // namespace

bool fits(const Sized& one) { return one.kind == Sized::Kind::fits || one.kind == Sized::Kind::close; }

std::size_t count_fitting(const SizeResult& result) {
  return static_cast<std::size_t>(std::count_if(result.sized.begin(), result.sized.end(), fits));
}

std::string best_words(const SizeResult& result) {
  if (result.order.empty()) return "nothing was tried";
  const auto best = result.order.front();
  const auto& candidate = result.candidates[best];
  const auto& one = result.sized[best];
  if (fits(one)) return fmt::format("first: {}, {}", name_of(candidate), left_words(one));
  const auto none = result.choices.all_motors ? std::string("no motor of the catalogue fits")
                                              : std::string("no motor that was tried fits");
  if (one.kind == Sized::Kind::ruled_out)
    return fmt::format("{}; nearest: {}, ruled out{}: {}", none, name_of(candidate), behind(one.where),
                       one.reason);
  return fmt::format("{}; nearest: {}", none, nearest_words(candidate, one));
}

std::string candidate_words(const Candidate& candidate, const Sized& one) {
  const auto name = name_of(candidate);
  if (fits(one)) return fmt::format("{}: {}; motor's values {}", name, left_words(one), candidate.values);
  return fmt::format("{} {}{}: {}", name,
                     one.kind == Sized::Kind::ruled_out ? "is ruled out" : "does not fit", behind(one.where),
                     one.reason);
}

std::vector<Finding> size_notes(const SizeResult& result) {
  auto notes = result.choices.notes;
  if (auto inertia = inertia_note(result); !inertia.empty())
    notes.emplace_back("size.inertia-limit"_code, std::move(inertia));
  if (!result.choices.gears.empty())
    notes.emplace_back(
        "size.gear-unchanged"_code,
        fmt::format("stiffness, play{} are those of the scenario behind every gear: a gear of another ratio "
                    "has its own",
                    result.choices.has_gear_kinds() ? " and friction" : ", friction and efficiency"));
  return notes;
}

}  // namespace drycut::sim::studies
