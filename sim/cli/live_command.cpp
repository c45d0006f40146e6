#include "sim/cli/live_command.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <memory>
#include <optional>
#include <random>
#include <thread>

#include "base/plain_text.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/run_command.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/live/line.hpp"
#include "sim/live/modbus/server.hpp"
#include "sim/live/opcua_gateway.hpp"
#include "sim/live/port.hpp"
#include "sim/live/server.hpp"
#include "sim/live/session.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/archive.hpp"

namespace drycut::sim::cli {

namespace {

/// Calls `act` when the program is told to end, from a thread of its own; as long as it lives, the signals
/// do nothing else.
class OnEnd {
 public:
  explicit OnEnd(const std::function<void()>& act) {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    thread_ = std::thread([this, act] {
      int which = 0;
      sigwait(&signals_, &which);
      act();
    });
  }
  ~OnEnd() {
    pthread_kill(thread_.native_handle(), SIGINT);  // in case nobody has
    thread_.join();
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  OnEnd(const OnEnd&) = delete;
  OnEnd& operator=(const OnEnd&) = delete;

 private:
  sigset_t signals_{};
  sigset_t before_{};
  std::thread thread_;
};

std::optional<double> read_pace(const std::string& text, Problems& problems) {
  if (text == "max") return 0;
  double pace = 0;
  const auto* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, pace);
  if (read.ec == std::errc() && read.ptr == end && pace >= live::least_pace && pace <= live::most_pace)
    return pace;
  problems.push_back(
      {"option.out-of-range"_code, "--pace", 1, 1, fmt::format("'{}' is no pace", text),
       fmt::format("machine seconds a second, from {} to {}, or max", live::least_pace, live::most_pace)});
  return {};
}

bool is_own(const std::string& address) { return address == "127.0.0.1" || address == "::1"; }

std::string make_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", random());
  return token;
}

void print_modbus(const std::string& address, int port) {
  fmt::print("Modbus TCP: {} port {}\n", address, port);
  if (!is_own(address))
    fmt::print(
        "WARNING: Modbus knows no token and no password. Whoever reaches {} port {} reads and writes the "
        "controller.\n",
        address, port);
}

std::filesystem::path session_in(const std::filesystem::path& given) {
  return std::filesystem::is_directory(given) ? given / live::session_file : given;
}

/// "out/today/1@12.5 s"
std::optional<live::Line::Options::From> read_from(const std::string& text, Problems& problems) {
  const auto mark = text.rfind('@');
  if (mark == std::string::npos || std::filesystem::exists(text)) return {{session_in(text), {}}};
  scenario::Findings findings({"--from"});
  const auto at = scenario::read_time({text.substr(mark + 1), {1, static_cast<int>(mark) + 2, 0}, {}},
                                      "the time to go on from", scenario::Sign::not_negative, findings);
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  if (!at) return {};
  return {{session_in(text.substr(0, mark)), at}};
}

/// What is to run: a scenario, or a session from a time on.
live::Line::Options line_options(const LiveOptions& options, Problems& problems) {
  live::Line::Options wanted{.scenario = options.scenario,
                             .set = overrides_of(options.set, problems),
                             .pace = read_pace(options.pace, problems).value_or(1),
                             .running = !options.paused,
                             .record = options.record};
  if (options.from.empty() == options.scenario.empty())
    problems.push_back({"option.missing"_code, "drycut live", 1, 1,
                        options.from.empty() ? "neither a scenario nor a session"
                                             : "both a scenario and a session, which has its own",
                        "drycut live SCENARIO, or drycut live --from DIR@12.5s"});
  if (options.from.empty()) return wanted;
  if (!options.set.empty())
    problems.push_back({"option.does-not-apply"_code, "--set", 1, 1, "a session has its own values",
                        "drycut replay --to-scenario makes a scenario of it"});
  wanted.from = read_from(options.from, problems);
  return wanted;
}

/// The nearest folder above that is there must take another one; nothing is made yet.
void check_record(const std::filesystem::path& folder, Problems& problems) {
  if (folder.empty()) return;
  std::error_code ignored;
  auto there = std::filesystem::absolute(folder, ignored).lexically_normal();
  while (!std::filesystem::exists(there, ignored) && there.has_relative_path()) there = there.parent_path();
  if (!std::filesystem::is_directory(there, ignored))
    problems.push_back({"file.not-writable"_code, "--record", 1, 1,
                        fmt::format("{} is a file", there.string()), "name a folder"});
  else if (access(there.c_str(), W_OK | X_OK) != 0)
    problems.push_back({"file.not-writable"_code, "--record", 1, 1,
                        fmt::format("nothing can be written in {}: {}", there.string(), std::strerror(errno)),
                        "name another folder"});
}

/// The line on its wires until it is told to end.
int run_line(const LiveOptions& options, const std::filesystem::path& opcua, live::Line& line) {
  const OnEnd end([&] { line.stop(); });
  const auto token = is_own(options.listen) ? "" : make_token();
  live::Server server({options.listen, static_cast<std::uint16_t>(options.port), token}, line);
  std::optional<live::modbus::ModbusServer> modbus;
  if (options.modbus)
    modbus.emplace(
        live::modbus::ModbusServer::Options{options.listen, static_cast<std::uint16_t>(*options.modbus)},
        line);
  std::optional<live::OpcuaGateway> gateway;
  if (options.opcua) {
    const auto port = live::free_port(options.listen, static_cast<std::uint16_t>(*options.opcua));
    gateway.emplace(live::OpcuaGateway::Options{opcua, server.url(), options.listen, port, token});
  }
  fmt::print("the line: {} (open it in a browser; Ctrl-C ends it)\n", server.url());
  if (modbus) print_modbus(options.listen, modbus->port());
  std::fflush(stdout);
  if (options.ready) options.ready(server.url());
  int run_without_record = 0;
  const auto tell_loss = [&](const live::News& news) {
    if (news.record_lost.empty() || std::exchange(run_without_record, news.run) == news.run) return;
    fmt::print(stderr, "drycut live: the record has ended at {} s, the line goes on: {}\n",
               record::seconds_text(news.time), printable(news.record_lost));
  };
  line.run({[&](auto news) {
              tell_loss(*news);
              server.tell(std::move(news));
            },
            [&](auto description) { server.describe(std::move(description)); },
            [&](auto answers) { server.answer(std::move(answers)); }});
  if (!options.record.empty() && !line.record().empty())
    fmt::print("again, to the byte: drycut replay {}\n", line.record().string());
  if (line.record_lost().empty()) return interrupted_status;
  fmt::print(stderr, "drycut live: not all of it is recorded: {}\n", printable(line.record_lost()));
  return simulation_failed;
}

}  // namespace

int live_scenario(const LiveOptions& options) {
  Problems problems;
  const auto wanted = line_options(options, problems);
  check_record(options.record, problems);
  std::optional<live::Line> line;
  std::filesystem::path opcua;
  if (options.opcua) opcua = live::find_opcua_gateway(problems);
  if (problems.empty()) line.emplace(wanted, problems);
  if (problems.empty() && options.modbus) {
    if (const auto lacking = live::modbus::lacking(*line); !lacking.empty())
      problems.push_back(
          {"live.no-modbus"_code, "--modbus", 1, 1, "the controller has no Modbus", "it takes " + lacking});
  }
  try {
    if (problems.empty()) return run_line(options, opcua, *line);
  } catch (const live::CannotListen& taken) {
    problems.push_back(taken.problem);
  } catch (const std::exception& error) {
    return print_failure("drycut live: " + drycut::words_of(error));
  }
  print_problems(problems);
  return bad_input;
}

int replay_session(const ReplayOptions& options) {
  const auto session = session_in(options.session);
  if (options.to_scenario.empty()) {
    RunOptions run;
    run.scenarios = {session};
    run.out = options.out;
    run.pictures = options.pictures;
    return run_scenarios(run);
  }
  Problems problems;
  check_output("--to-scenario", options.to_scenario.string(), {session, "session"}, {options.force},
               problems);
  std::string text;
  std::vector<Finding> notes;
  if (problems.empty()) text = live::scenario_of_session(session, options.to_scenario, notes, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  write_file(options.to_scenario, text);
  for (const auto& note : notes) fmt::print("  note {}\n", printable(to_string(note)));
  fmt::print("scenario: {}\n", options.to_scenario.string());
  return all_passed;
}

namespace {

void live_options(CLI::App& command, int& status) {
  const auto chosen = std::make_shared<LiveOptions>();
  auto& options = *chosen;
  command.add_option("scenario", options.scenario, "Scenario file (.yaml)");
  command.add_option(
      "--from", options.from,
      "In place of a scenario: a session's folder, to go on from its end, or from a time in it "
      "(out/today/1@12.5s)");
  command.add_option("--port", options.port, "Of the page; 0 = any free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command
      .add_option("--modbus", options.modbus,
                  "Port where the controller answers Modbus TCP as the real one does; 0 = any free one")
      ->check(CLI::Range(0, 65535));
  command.add_option("--pace", options.pace, "Machine seconds a second, or max: as fast as it goes")
      ->capture_default_str();
  command.add_flag("--paused", options.paused, "Stand still at time zero");
  command
      .add_option("--listen", options.listen,
                  "Address to listen on; from another machine the page needs the token that is printed then")
      ->capture_default_str();
  command
      .add_option("--opcua", options.opcua,
                  "Port of an OPC UA server of the line, such as 4840; 0 = any free one (needs make opcua)")
      ->check(CLI::Range(0, 65535));
  command.add_option(
      "--record", options.record,
      "Folder for what came from outside, trace.csv and events.csv: drycut replay runs it again");
  add_set(command, options.set, "scenario");
  command.callback([chosen, &status] { status = live_scenario(*chosen); });
}

}  // namespace

Verb live_verb() {
  return {
      "live",
      "Run a scenario in real time with a page in the browser: the machine, the operator's panel, a scope\n"
      "It runs until Ctrl-C: status 130. Status 3: not all of it could be recorded.",
      {"drycut live scenes/rotary_knife_mc_emergency.yaml",
       "drycut live my_line.yaml --record out/today --pace 0.1", "drycut live --from out/today/1@12.5s"},
      {"scenario", {FileKind::scenario}},
      live_options};
}

namespace {

void replay_options(CLI::App& command, int& status) {
  const auto chosen = std::make_shared<ReplayOptions>();
  auto& options = *chosen;
  command.add_option("session", options.session, "Folder of the session, or its session.yaml")->required();
  add_out(command, options.out, "Directory for the results");
  add_no_pictures(command, options.pictures, "No frames, plots or report");
  command.add_option("--to-scenario", options.to_scenario,
                     "Write it as a scenario with a timeline, and run nothing");
  add_force(command, options.force);
  command.callback([chosen, &status] { status = replay_session(*chosen); });
}

}  // namespace

Verb replay_verb() {
  return {"replay",
          "Run a recorded live session again, to the byte: traces, events, checks, pictures and a report",
          {"drycut replay out/today/1", "drycut replay out/today/1 --to-scenario today.yaml"},
          {"session", {FileKind::session, FileKind::session_folder}},
          replay_options};
}

}  // namespace drycut::sim::cli
