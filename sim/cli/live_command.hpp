#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/cli/commands.hpp"

namespace drycut::sim::cli {

struct LiveOptions {
  std::filesystem::path scenario;
  std::string from;  ///< a session to go on from, in place of a scenario: "out/today/1@12.5 s"
  std::vector<std::string> set;
  int port = 8080;                 ///< 0 = any free one
  std::optional<int> modbus = {};  ///< port of the controller's Modbus TCP, 0 = any free one; absent: none
  std::string pace = "1";          ///< machine seconds a second, or "max"
  bool paused = false;             ///< stands still at time zero
  std::string listen =
      "127.0.0.1";               ///< address; from another one than this machine's own a token is demanded
  std::filesystem::path record;  ///< folder for the session; "" = none
  std::optional<int> opcua;      ///< port of an OPC UA gateway, 0 = any free one
  std::function<void(const std::string& url)> ready = {};  ///< is told where the page is
};
/// drycut live: until SIGINT, SIGTERM or SIGHUP, then 130; 2 bad input, or it cannot listen there or record
/// there; 3 if the record ended before the line
int live_scenario(const LiveOptions& options);

struct ReplayOptions {
  std::filesystem::path session;  ///< a session's folder, or its file
  std::filesystem::path out = "out/replay";
  std::filesystem::path to_scenario;  ///< is written in place of a run; "" = run
  bool pictures = true;
  bool force = false;  ///< a file that drycut did not write is replaced too
};
/// drycut replay: as drycut run
int replay_session(const ReplayOptions& options);

}  // namespace drycut::sim::cli
