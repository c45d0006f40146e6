#pragma once
#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "plants/guest.hpp"
#include "sim/fmi/foreign/archive.hpp"
#include "sim/fmi/host/frame.hpp"

namespace drycut::sim::fmi {

/// Writes the program that holds FMUs into the folder of an unpacked one, once.
void write_host(const std::filesystem::path& folder);

/// A foreign FMU in a process of its own, which the program of sim/fmi/host/ runs: no environment, a folder
/// of its own, limits of memory and of the time for an answer. That keeps an FMU's crash from the run; it
/// keeps no secret from the FMU and is no sandbox.
class GuestProcess : public plants::GuestModel {
 public:
  /// `unpacked`: the FMU's folder with write_host(), in which the process has one for its files; `name`: of
  /// the FMU, in messages. Throws std::exception with a sentence, as all that it does.
  GuestProcess(std::shared_ptr<const OwnFolder> unpacked, std::string name, const host::LoadRequest& load,
               double time_limit, std::span<double> outputs);
  ~GuestProcess() override;
  GuestProcess(const GuestProcess&) = delete;
  GuestProcess& operator=(const GuestProcess&) = delete;

  void begin_step(double at, double size, std::span<const double> inputs) override;
  void end_step(std::span<double> outputs) override;
  std::vector<std::byte> save() override;
  void restore(std::span<const std::byte> state) override;

 private:
  void begin(const std::filesystem::path& program, const std::filesystem::path& folder);
  void ask(host::FrameWord word, std::span<const std::byte> bytes);
  /// The answer to what was asked.
  std::vector<std::byte> answer();
  void read(void* to, std::size_t size, double until);
  [[noreturn]] void tell_end();
  void take_outputs(std::span<double> outputs);
  void kill_it();

  std::shared_ptr<const OwnFolder> unpacked_;
  std::string name_;
  double time_limit_;
  std::size_t memory_;
  pid_t process_ = -1;
  int line_ = -1;
};

}  // namespace drycut::sim::fmi
