#include "sim/studies/sweep/store.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include "base/json.hpp"
#include "sim/studies/override_json.hpp"

namespace drycut::sim::studies {

namespace {

using Overrides = std::vector<scenario::Override>;

constexpr std::size_t key_digits = 16;

}  // namespace

PointStore::PointStore(const std::filesystem::path& file, cluster::Workers workers)
    : workers_(std::move(workers)), lines_(file, "", [this](std::string_view line) -> std::string {
        std::uint64_t key = 0;
        if (line.size() <= key_digits) return {};
        std::from_chars(line.data(), line.data() + key_digits, key, 16);
        const std::string row(line.substr(key_digits + 1));
        if (!parse_row(row)) return {};
        rows_[key] = row;
        return std::string(line);
      }) {}

std::vector<PointRow> PointStore::rows(const PointQuestion& question, const std::vector<Overrides>& points,
                                       const StudyProgress& progress) {
  std::vector<PointRow> rows(points.size());
  std::vector<std::uint64_t> keys(points.size());
  std::unordered_map<std::uint64_t, std::size_t> asked;
  std::vector<std::size_t> twins;  // points that are asked already
  std::size_t done = 0;
  std::mutex mutex;
  const auto ask = [&](std::size_t i) -> std::optional<cluster::Ask> {
    auto point = std::make_shared<PointScenario>(read_point(question, points[i]));
    keys[i] = point->fingerprint;
    const std::lock_guard lock(mutex);
    const auto known = rows_.find(point->fingerprint);
    if (known != rows_.end()) {
      rows[i] = parse_row(known->second).value();
      progress(++done, points.size());
      return {};
    }
    if (!asked.emplace(point->fingerprint, i).second) {
      twins.push_back(i);
      return {};
    }
    return cluster::Ask{json_text(record::json_of(points[i])),
                        [&question, point] { return row_text(run_point(question, *point)); }};
  };
  const auto take = [&](std::size_t i, const cluster::WorkerAnswer& answer) {
    const std::lock_guard lock(mutex);
    if (!answer.lost.empty()) {
      rows[i] =
          PointRow{PointRow::Verdict::lost,
                   answer.lost,
                   {},
                   std::vector<double>(question.columns.size(), std::numeric_limits<double>::quiet_NaN())};
      std::string what;
      for (const auto& override : points[i]) what += fmt::format("{}={} ", override.path, override.value);
      lost_.push_back(what + "was lost: " + answer.lost);
      return progress(++done, points.size());
    }
    // As it is read back: numbers of as many digits, whoever has run it.
    rows[i] = parse_row(answer.text).value();
    rows_.emplace(keys[i], answer.text);
    lines_.add(fmt::format("{:0{}x},{}", keys[i], key_digits, answer.text));
    ++(rows[i].verdict == PointRow::Verdict::refused ? refused_ : simulated_);
    progress(++done, points.size());
  };
  workers_.run({"point", json_text(record::json_of(question)), points.size(), ask, take});
  for (const auto i : twins) {
    rows[i] = rows[asked.at(keys[i])];
    progress(++done, points.size());
  }
  return rows;
}

std::function<std::string(const std::string&)> point_answerer(const std::string& text) {
  const auto question = question_in<PointQuestion>(text);
  return [question](const std::string& ask) {
    Overrides overrides;
    record::take_json(json_from(ask), overrides);
    return row_text(run_point(*question, read_point(*question, overrides)));
  };
}

}  // namespace drycut::sim::studies
