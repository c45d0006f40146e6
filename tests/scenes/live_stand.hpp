#pragma once
// The page of a live line as its operators have it: served by the program, worked in a browser.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "sim/live/line.hpp"
#include "sim/live/server.hpp"
#include "tests/scenes/browser.hpp"
#include "tests/test_folder.hpp"

namespace drycut::live_page {

using nlohmann::json;
namespace live = sim::live;

inline const auto* const three = "/usr/share/javascript/three/three.min.js";

/// A line with all that an operator's panel has, and nobody but the browser to work it.
inline constexpr auto* scenario = R"(extends: {}/scenes/rotary_knife_mc_emergency.yaml
timeline: []
checks:
  - {{name: never too fast, always: web.speed < 70}}
  - {{name: stands for ever, always: web.speed < 1}}
)";

/// A line that stands at time zero, as fast as it goes when it is run, its server and a browser on its page.
class Stand {
 public:
  Stand() : Stand(fmt::format(scenario, source_root.string())) {}
  explicit Stand(const std::string& text, const std::string& program = "") {
    if (!program.empty()) folder_.file("p.st", program);
    Problems problems;
    line_.emplace(
        live::Line::Options{.scenario = folder_.file("line.yaml", text), .pace = 0, .running = false},
        problems);
    EXPECT_EQ(lines_of(problems), "");
    serve(0);
    work_ = std::thread([this] {
      line_->run({[this](auto news) { tell(std::move(news)); },
                  [this](auto description) { describe(std::move(description)); },
                  [this](auto answers) { answer(std::move(answers)); }});
    });
    browser.emplace(folder_.path);
    browser->window(1280, 720);
  }
  ~Stand() {
    line_->stop();
    work_.join();
  }
  Stand(const Stand&) = delete;
  Stand& operator=(const Stand&) = delete;

  void serve(std::uint16_t port) {
    auto server = std::make_unique<live::Server>(live::Server::Options{"127.0.0.1", port, ""}, *line_);
    const std::lock_guard lock(mutex_);
    server_ = std::move(server);
    if (described_) server_->describe(described_);
  }
  std::uint16_t leave() {
    const std::lock_guard lock(mutex_);
    const auto port = server_->port();
    server_.reset();
    return port;
  }

  void open() {
    browser->visit(server_->url());
    EXPECT_TRUE(becomes("window.drycut?.news && drycut.machine.frames > 0"));
  }
  json look(const std::string& script) { return browser->evaluate(script); }
  bool becomes(const std::string& condition) { return browser->becomes(condition); }
  void click(const std::string& selector) { look("document.querySelector('" + selector + "').click()"); }
  /// As typed, and Enter.
  void type(const std::string& selector, const std::string& text) {
    look("(() => { const field = document.querySelector('" + selector + "'); field.focus(); field.value = '" +
         text +
         "'; field.dispatchEvent(new Event('input', {bubbles: true})); "
         "field.dispatchEvent(new Event('change', {bubbles: true})); "
         "field.dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter', bubbles: true})); })()");
  }
  void key(const std::string& key) {
    look(
        "(() => { document.activeElement?.blur(); document.body.dispatchEvent(new KeyboardEvent('keydown', "
        "{key: '" +
        key + "', bubbles: true})); })()");
  }
  std::string text(const std::string& selector) {
    return look("document.querySelector('" + selector + "').innerText");
  }

  TestFolder folder_;
  std::optional<Browser> browser;

 private:
  void tell(std::shared_ptr<const live::News> news) {
    const std::lock_guard lock(mutex_);
    if (server_) server_->tell(std::move(news));
  }
  void answer(std::vector<live::Answer> answers) {
    const std::lock_guard lock(mutex_);
    if (server_) server_->answer(std::move(answers));
  }
  void describe(std::shared_ptr<const live::LineDescription> description) {
    const std::lock_guard lock(mutex_);
    described_ = description;
    if (server_) server_->describe(std::move(description));
  }

  std::optional<live::Line> line_;
  std::mutex mutex_;
  std::shared_ptr<const live::LineDescription> described_;
  std::unique_ptr<live::Server> server_;
  std::thread work_;
};

class LivePage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!Browser::is_installed()) GTEST_SKIP() << "chromium is not installed";
    if (!std::filesystem::exists(three)) GTEST_SKIP() << "libjs-three is not installed";
  }
};

}  // namespace drycut::live_page
