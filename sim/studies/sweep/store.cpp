#include "sim/studies/sweep/store.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "sim/file.hpp"
#include "sim/studies/override_json.hpp"
#include "sim/studies/proven_line.hpp"

namespace drycut::sim::studies {

namespace {

using nlohmann::json;
using Overrides = std::vector<scenario::Override>;

constexpr std::size_t key_digits = 16;

/// What prepare() has not found out.
std::string text_of(const PointQuestion& question) {
  auto figures = json::array();
  for (const auto& figure : question.figures) figures.push_back({figure.name, figure.term});
  return json{{"file", question.file.string()},
              {"text", question.text},
              {"set", question.set},
              {"figures", figures},
              {"rated", question.rated}}
      .dump();
}

}  // namespace

PointStore::PointStore(const std::filesystem::path& file, cluster::Workers workers)
    : workers_(std::move(workers)) {
  std::string kept;
  std::ifstream old(file, std::ios::binary);
  for (std::string line; std::getline(old, line) && !old.eof();) {
    std::uint64_t key = 0;
    const auto whole = unharmed(line);
    if (!whole || whole->size() <= key_digits) continue;
    std::from_chars(whole->data(), whole->data() + key_digits, key, 16);
    const std::string row(whole->substr(key_digits + 1));
    if (!parse_row(row)) continue;
    rows_[key] = row;
    kept += line + "\n";
  }
  old.close();
  write_file(file, kept);
  stream_.exceptions(std::ios::failbit | std::ios::badbit);
  stream_.open(file, std::ios::binary | std::ios::app);
}

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
    return cluster::Ask{json(points[i]).dump(),
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
    stream_ << proven(fmt::format("{:0{}x},{}", keys[i], key_digits, answer.text)) + '\n' << std::flush;
    ++(rows[i].verdict == PointRow::Verdict::refused ? refused_ : simulated_);
    progress(++done, points.size());
  };
  workers_.run({"point", text_of(question), points.size(), ask, take});
  for (const auto i : twins) {
    rows[i] = rows[asked.at(keys[i])];
    progress(++done, points.size());
  }
  return rows;
}

std::function<std::string(const std::string&)> point_answerer(const std::string& text) {
  const auto asked = json::parse(text);
  auto question = std::make_shared<PointQuestion>();
  question->file = asked.at("file").get<std::string>();
  question->text = asked.at("text").get<std::string>();
  question->set = asked.at("set").get<Overrides>();
  question->rated = asked.at("rated").get<std::string>();
  for (const auto& figure : asked.at("figures"))
    question->figures.push_back({figure.at(0).get<std::string>(), figure.at(1).get<std::string>()});
  Problems problems;
  prepare(*question, problems);
  if (!problems.empty()) throw std::runtime_error(to_string(problems.front()));
  return [question](const std::string& ask) {
    return row_text(run_point(*question, read_point(*question, json::parse(ask).get<Overrides>())));
  };
}

}  // namespace drycut::sim::studies
