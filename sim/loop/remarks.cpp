#include "sim/loop/remarks.hpp"

#include <fmt/format.h>

#include "base/state_archive.hpp"
#include "base/text.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

void Remarks::happened(const record::RecordedEvent& event) {
  constexpr std::size_t shown = 5;
  signs_.take(event);
  if (event.text.empty() || event.source == "timeline") return;
  ++count_;
  const bool urgent = is_of_program(event.event);  // stands before remarks on values
  if ((urgent ? urgent_ : remarks_.size()) >= shown) return;
  const auto place = urgent ? urgent_++ : remarks_.size();
  remarks_.insert(
      remarks_.begin() + static_cast<std::ptrdiff_t>(place),
      {"controller.remark"_code, fmt::format("{} at {} s: {}: {}", event.source,
                                             record::seconds_text(event.time), event.event, event.text)});
  if (remarks_.size() > shown) remarks_.pop_back();
}

std::vector<Finding> Remarks::notes() const {
  auto notes = remarks_;
  if (count_ > remarks_.size())
    notes.emplace_back("controller.remark"_code, fmt::format("and {} more, see events.csv",
                                                             counted(count_ - remarks_.size(), "remark")));
  return notes;
}

void Remarks::visit(StateArchive& archive) { STATE(archive, remarks_, urgent_, count_, signs_); }

}  // namespace drycut::sim::loop
