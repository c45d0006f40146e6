#pragma once
#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drycut {

/// A headless Chromium, driven over its remote debugging pipe (Chrome DevTools Protocol): one tab, what a
/// reader does with mouse and window, and everything that the page complains of. Every call throws
/// std::runtime_error where the browser does not answer, refuses or is gone.
class Browser {
 public:
  static bool is_installed();

  /// Starts it; home and profile are in `folder`.
  explicit Browser(const std::filesystem::path& folder);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void window(int width, int height, bool phone = false);  ///< [CSS pixels]; a phone has no scroll bars
  void media(const std::string& scheme, const std::string& medium = "screen");  ///< "light" or "dark"
  void open(const std::filesystem::path& page);        ///< and waits until it is loaded
  void visit(const std::string& url);                  ///< the same, of a server: "http://127.0.0.1:8080/"
  nlohmann::json evaluate(const std::string& script);  ///< a promise: what comes of it
  bool becomes(const std::string& condition);          ///< waits until it is true; false if it does not come

  void mouse(const std::string& what, double x, double y, int clicks = 0);  ///< mouseMoved, mousePressed, ...
  /// One press of a key as `KeyboardEvent.key` names it: "Tab", "ArrowRight", "Enter", "+".
  void key(const std::string& name, bool shift = false);
  void screenshot(const std::filesystem::path& file);  ///< PNG of what the window shows
  std::string pdf();                                   ///< the page as printed, in base64

  /// What the page of open() wrote to the console as warning or error, threw, or asked for outside itself.
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
  nlohmann::json message();
  void happened(const nlohmann::json& event);

  pid_t process_ = -1;
  int to_ = -1;
  int from_ = -1;
  std::string received_;
  int last_call_ = 0;
  std::string session_;
  std::string page_;
  bool loaded_ = false;
  std::vector<std::string> complaints_;
};

}  // namespace drycut
