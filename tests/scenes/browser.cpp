#include "tests/scenes/browser.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <map>
#include <stdexcept>

#include "renders/process.hpp"

extern char** environ;  // NOLINT: POSIX gives the environment to hand on under this name

namespace drycut {
namespace {

using nlohmann::json;

constexpr int patience = 60'000;  // a browser that is silent for so long has died [ms]

/// Ends of a pipe with numbers above those that the browser wants as its own (3 and 4).
std::array<int, 2> pipe_above() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe to the browser");
  for (int& end : ends) {
    const int low = end;
    end = fcntl(low, F_DUPFD_CLOEXEC, 20);
    close(low);
  }
  return ends;
}

pid_t start(std::vector<std::string> words, const std::string& home, int in, int out) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, in, 3);
  posix_spawn_file_actions_adddup2(&actions, out, 4);
  // A group of its own, so that its helpers end with it.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::string own_home = "HOME=" + home;
  std::vector<char*> environment = {own_home.data()};
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (!std::string_view(*entry).starts_with("HOME=")) environment.push_back(*entry);
  environment.push_back(nullptr);
  pid_t child = -1;
  const int status =
      posix_spawnp(&child, arguments[0], &actions, &attributes, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (status != 0) throw std::runtime_error("the browser does not start");
  return child;
}

std::string decoded(const std::string& base64) {
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : base64) {
    const auto digit =
        std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
    if (digit == std::string_view::npos) break;
    bits = bits << 6U | static_cast<unsigned>(digit);
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> static_cast<unsigned>(count -= 8) & 255U);
  }
  return bytes;
}

}  // namespace

bool Browser::is_installed() {
  try {
    return renders::run_process({"chromium", "chromium", {"--version"}}).good;
  } catch (const std::runtime_error&) {
    return false;
  }
}

Browser::Browser(const std::filesystem::path& folder) {
  const auto calls = pipe_above();
  const auto answers = pipe_above();
  to_ = calls[1];
  from_ = answers[0];
  process_ = start({"chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                    "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run",
                    "--remote-debugging-pipe", "--user-data-dir=" + (folder / "profile").string()},
                   folder.string(), calls[0], answers[1]);
  close(calls[0]);
  close(answers[1]);
  const auto tab = call("Target.createTarget", {{"url", "about:blank"}})["targetId"];
  session_ = call("Target.attachToTarget", {{"targetId", tab}, {"flatten", true}})["sessionId"];
  for (const char* domain : {"Page", "Runtime", "Log", "Network"}) call(std::string(domain) + ".enable");
}

Browser::~Browser() {
  close(to_);
  close(from_);
  kill(-process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Browser::window(int width, int height, bool phone) {
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", phone}});
}

void Browser::media(const std::string& scheme, const std::string& medium) {
  const json features = json::array({{{"name", "prefers-color-scheme"}, {"value", scheme}}});
  call("Emulation.setEmulatedMedia", {{"media", medium}, {"features", features}});
}

void Browser::open(const std::filesystem::path& page) { visit("file://" + page.string()); }

void Browser::visit(const std::string& url) {
  complaints_.clear();
  loaded_ = false;
  page_ = url;
  call("Page.navigate", {{"url", page_}});
  while (!loaded_) happened(message());
}

bool Browser::becomes(const std::string& condition) {
  return evaluate("new Promise((done) => { let left = 3000; const look = () => (" + condition +
                  ") ? done(true) : --left ? setTimeout(look, 20) : done(false); look(); })") == true;
}

json Browser::evaluate(const std::string& script) {
  auto answer =
      call("Runtime.evaluate", {{"expression", script}, {"returnByValue", true}, {"awaitPromise", true}});
  if (answer.contains("exceptionDetails"))
    throw std::runtime_error("in the page: " + answer["exceptionDetails"].dump());
  return answer["result"].value("value", json());
}

void Browser::mouse(const std::string& what, double x, double y, int clicks) {
  const bool button = what != "mouseMoved" || clicks > 0;
  call("Input.dispatchMouseEvent", {{"type", what},
                                    {"x", x},
                                    {"y", y},
                                    {"button", button ? "left" : "none"},
                                    {"buttons", button && what != "mouseReleased" ? 1 : 0},
                                    {"clickCount", clicks}});
}

void Browser::key(const std::string& name, bool shift) {
  // A page acts by the name; the browser itself, as for Tab, by the old number.
  static const std::map<std::string, int> numbers = {
      {"Tab", 9},   {"Enter", 13},     {"Escape", 27},  {" ", 32},          {"End", 35},
      {"Home", 36}, {"ArrowLeft", 37}, {"ArrowUp", 38}, {"ArrowRight", 39}, {"ArrowDown", 40}};
  const auto known = numbers.find(name);
  json event = {{"key", name}, {"modifiers", shift ? 8 : 0}};
  if (known != numbers.end()) event["windowsVirtualKeyCode"] = known->second;
  if (name == "Tab" || name.starts_with("Arrow") || name == "Home" || name == "End") event["code"] = name;
  if (name == "Enter") event["text"] = "\r";
  if (name.size() == 1) event["text"] = name;
  event["type"] = event.contains("text") ? "keyDown" : "rawKeyDown";
  call("Input.dispatchKeyEvent", event);
  event["type"] = "keyUp";
  call("Input.dispatchKeyEvent", event);
}

void Browser::screenshot(const std::filesystem::path& file) {
  std::ofstream(file, std::ios::binary) << decoded(call("Page.captureScreenshot")["data"]);
}

std::string Browser::pdf() { return call("Page.printToPDF")["data"]; }

json Browser::call(const std::string& method, const json& parameters) {
  json request = {{"id", ++last_call_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) request["sessionId"] = session_;
  const auto text = request.dump() + '\0';
  for (std::size_t sent = 0; sent < text.size();) {
    const auto size = write(to_, text.data() + sent, text.size() - sent);
    if (size <= 0) throw std::runtime_error("the browser takes no calls: " + method);
    sent += static_cast<std::size_t>(size);
  }
  for (;;) {
    auto answer = message();
    if (answer.value("id", 0) != last_call_) {
      happened(answer);
      continue;
    }
    if (answer.contains("error")) throw std::runtime_error(method + ": " + answer["error"].dump());
    return answer["result"];
  }
}

json Browser::message() {
  std::size_t end = received_.find('\0');
  while (end == std::string::npos) {
    pollfd waiting = {from_, POLLIN, 0};
    std::array<char, 65536> buffer{};
    const auto size = poll(&waiting, 1, patience) == 1 ? read(from_, buffer.data(), buffer.size()) : 0;
    if (size <= 0) throw std::runtime_error("the browser is gone or does not answer");
    end = received_.size();
    received_.append(buffer.data(), static_cast<std::size_t>(size));
    end = received_.find('\0', end);
  }
  auto made = json::parse(received_.substr(0, end));
  received_.erase(0, end + 1);
  return made;
}

void Browser::happened(const json& event) {
  const auto method = event.value("method", "");
  if (method == "Page.loadEventFired") loaded_ = true;
  const auto bad = [](const std::string& level) {
    return level == "error" || level == "warning" || level == "assert";
  };
  const auto parameters = event.value("params", json::object());
  if (method == "Runtime.exceptionThrown") complaints_.push_back("exception " + parameters.dump());
  if (method == "Runtime.consoleAPICalled" && bad(parameters["type"]))
    complaints_.push_back("console " + parameters["args"].dump());
  // Without a graphics card the browser tells of its own reading of pictures: nothing that a page could mend.
  const auto is_own = [&] {
    return parameters["entry"].value("text", "").find("GL Driver Message") != std::string::npos;
  };
  if (method == "Log.entryAdded" && bad(parameters["entry"]["level"]) && !is_own())
    complaints_.push_back("log " + parameters["entry"].dump());
  if (method == "Network.requestWillBeSent") {
    const std::string url = parameters["request"]["url"];
    if (!url.starts_with(page_) && !url.starts_with("data:") && !url.starts_with("blob:"))
      complaints_.push_back("asks for " + url);
  }
  if (method == "Network.webSocketCreated") {
    const std::string url = parameters["url"];
    if (!page_.starts_with("http") || !url.starts_with("ws" + page_.substr(4)))
      complaints_.push_back("talks to " + url);
  }
}

}  // namespace drycut
