#pragma once
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/json.hpp"
#include "base/problem.hpp"
#include "sim/record/json.hpp"

namespace drycut::sim::studies {

/// The file that a study goes on from, which grows by a line a run: one that was interrupted, or killed,
/// finds there what it had. Each line ends with a checksum of the rest, so that damage costs the lines that
/// it is in and no others.
class KeptLines {
 public:
  /// Takes a sound line of an earlier study, without its checksum; returns it as it is to be kept, "" = not.
  using Take = std::function<std::string(std::string_view line)>;
  /// Reads what is in the file behind `first`, which it begins with, else nothing; what is cut short or
  /// damaged is left out. Throws std::runtime_error if the file cannot be written.
  KeptLines(const std::filesystem::path& file, std::string_view first, const Take& take);
  /// Writes a line at once.
  void add(std::string_view line);

 private:
  std::ofstream stream_;
};

/// The question of a study, as its text has come to another machine: read and prepared. Throws
/// std::runtime_error if it is none.
template <typename Question>
std::shared_ptr<const Question> question_in(const std::string& text) {
  auto question = std::make_shared<Question>();
  record::take_json(json_from(text), *question);
  Problems problems;
  prepare(*question, problems);
  if (!problems.empty()) throw std::runtime_error(to_string(problems.front()));
  return question;
}

}  // namespace drycut::sim::studies
