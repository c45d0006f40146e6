// drycut work BUNDLE, which --help does not list: what a cluster's machines run for `--on`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>

#include "sim/cli/commands.hpp"
#include "sim/cli/verb.hpp"
#include "sim/studies/cluster/bundle.hpp"
#include "sim/studies/faults/study.hpp"
#include "sim/studies/sweep/store.hpp"
#include "sim/studies/tune/trials.hpp"

namespace drycut::sim::cli {

namespace {

/// A line at once: a kill loses only what is under way.
void say(const Json& line) { std::cout << json_text(line) << '\n' << std::flush; }

/// Answers the items on standard input, a line each:
///   {"item": 3, "ask": ...}                            in
///   {"item": 3}                                        out: it is under way
///   {"item": 3, "answer": "...", "seconds": 0.02}      out: it is done
///   {"end": true}, {"refused": WHY}                    out, last: all are done; this program must not answer
/// A run that throws ends the process, as one that crashes does.
int work(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  if (!stream) {
    fmt::print(stderr, "{}:1:1: there is no such file; `drycut sweep --on` makes it [file.missing]\n",
               file.string());
    return bad_input;
  }
  FileSet files;
  const UseFiles use(files);
  const auto bundle = cluster::read_bundle(bytes.view(), files);
  if (!bundle.refused.empty()) {
    say({{"refused", bundle.refused}});
    return bad_input;
  }
  const auto answer = bundle.kind == "trial"   ? studies::trial_answerer(bundle.question)
                      : bundle.kind == "fault" ? studies::fault_answerer(bundle.question)
                                               : studies::point_answerer(bundle.question);
  for (std::string line; std::getline(std::cin, line);) {
    const auto item = json_from(line);
    say({{"item", item.at("item")}});
    const auto begin = std::chrono::steady_clock::now();
    const auto text = answer(item.at("ask").get<std::string>());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    say({{"item", item.at("item")}, {"answer", text}, {"seconds", took.count()}});
  }
  say({{"end", true}});
  return all_passed;
}

}  // namespace

namespace {

void work_options(CLI::App& command, int& status) {
  const auto file = std::make_shared<std::filesystem::path>();
  command.add_option("bundle", *file, "What all of it has in common, as --on stages it")->required();
  command.callback([file, &status] {
    try {
      status = work(*file);
    } catch (const std::exception& error) {
      status = print_failure(fmt::format("{}: {}", file->string(), error.what()));
    }
  });
}

}  // namespace

Verb work_verb() {
  return {"work",         "Run what a study asks on standard input, for clusters", {}, {}, work_options,
          Verb::Shown::no};  // for the engines of --on
}

}  // namespace drycut::sim::cli
