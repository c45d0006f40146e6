#include "tests/bench/fmi.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "sim/fmi/machine/built_machine.hpp"
#include "sim/fmi/resolve.hpp"
#include "sim/scenario/scenario.hpp"

// The library that `drycut fmu` writes into FMUs.
extern "C" const char drycut_fmu_begin[];
extern "C" const char drycut_fmu_end[];

namespace drycut::bench {

namespace {

namespace fs = std::filesystem;
constexpr int steps = 100000;
constexpr double h = 1e-4;

double microseconds_of(const auto& run) {
  const auto begin = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
}

// The library that FMUs carry, as an importer has it.
class Importer {
 public:
  Importer(const fs::path& resources, const std::string& token)
      : library_(dlopen((resources / "machine.so").c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (library_ == nullptr) throw std::runtime_error(dlerror());
    static const Callbacks callbacks = {silent, nullptr, nullptr, nullptr, nullptr};
    const auto uri = "file://" + resources.string();
    handle_ = function<void*(const char*, int, const char*, const char*, const Callbacks*, int, int)>(
        "fmi2Instantiate")("bench", 1, token.c_str(), uri.c_str(), &callbacks, 0, 0);
    if (handle_ == nullptr) throw std::runtime_error("fmi2Instantiate makes no instance");
    require(function<int(void*, int, double, double, int, double)>("fmi2SetupExperiment")(handle_, 0, 0, 0, 0,
                                                                                          0));
    require(function<int(void*)>("fmi2EnterInitializationMode")(handle_));
    require(function<int(void*)>("fmi2ExitInitializationMode")(handle_));
  }
  ~Importer() { function<void(void*)>("fmi2FreeInstance")(handle_); }
  Importer(const Importer&) = delete;
  Importer& operator=(const Importer&) = delete;

  void step_all() {
    const auto do_step = function<int(void*, double, double, int)>("fmi2DoStep");
    for (int n = 0; n < steps; ++n) require(do_step(handle_, h * (done_ + n), h, 1));
    done_ += steps;
  }
  void there_and_back() {
    const auto get = function<int(void*, void**)>("fmi2GetFMUstate");
    const auto set = function<int(void*, void*)>("fmi2SetFMUstate");
    require(get(handle_, &state_));
    require(set(handle_, state_));
  }

 private:
  struct Callbacks {
    void (*log)(void*, const char*, int, const char*, const char*, ...);
    void *allocate, *release, *finished, *environment;
  };
  static void silent(void* /*environment*/, const char* /*instance*/, int /*status*/,
                     const char* /*category*/, const char* /*text*/, ...) {}
  static void require(int status) {
    if (status != 0) throw std::runtime_error("the FMU refuses a call");
  }
  template <class Signature>
  Signature* function(const char* name) {
    return reinterpret_cast<Signature*>(dlsym(library_, name));
  }
  void* library_;
  void* handle_ = nullptr;
  void* state_ = nullptr;
  double done_ = 0;
};

}  // namespace

FmiCost fmi_cost(int rounds) {
  Problems problems;
  const auto scenario =
      sim::scenario::read_scenario(DRYCUT_SOURCE_DIR "/tests/bench/line.yaml", {}, problems);
  if (!problems.empty()) throw std::runtime_error(to_string(problems.front()));
  const auto resolved = sim::fmi::resolve(scenario, "");
  const auto text = sim::fmi::machine_text(resolved);
  const auto folder = fs::temp_directory_path() / "drycut-bench-fmi";
  fs::create_directories(folder);
  std::ofstream(folder / "machine.json", std::ios::binary) << text;
  std::ofstream(folder / "machine.so", std::ios::binary)
      .write(drycut_fmu_begin, drycut_fmu_end - drycut_fmu_begin);

  sim::fmi::BuiltMachine machine(resolved);
  Importer importer(folder, sim::fmi::token_of(text));
  FmiCost cost{1e9, 1e9, 1e9};
  constexpr int states = 200;
  for (int round = 0; round < rounds; ++round) {
    const double native = microseconds_of([&] {
      for (int n = 0; n < steps; ++n) machine.step();
    });
    const double do_step = microseconds_of([&] { importer.step_all(); });
    const double state = microseconds_of([&] {
      for (int n = 0; n < states; ++n) importer.there_and_back();
    });
    cost = {std::min(cost.native, native / steps), std::min(cost.do_step, do_step / steps),
            std::min(cost.state, state / states)};
  }
  fs::remove_all(folder);
  return cost;
}

void print_fmi_cost(int rounds) {
  const auto cost = fmi_cost(rounds);
  fmt::print(
      "fmi2DoStep: {:.3f} us a step, the machine alone {:.3f} us: {:.1f} % more, the aim is 10 %; a state "
      "got and set: "
      "{:.1f} us, the aim is 50 us\n",
      cost.do_step, cost.native, 100 * (cost.do_step / cost.native - 1), cost.state);
}

}  // namespace drycut::bench
