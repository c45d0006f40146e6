#include "sim/studies/cluster/engine.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "sim/loop/fingerprint.hpp"

namespace drycut::sim::cluster {

namespace {

constexpr std::string_view dask_scheme = "dask://";
constexpr std::string_view slurm_name = "slurm";
constexpr int highest_port = 65535;

}  // namespace

std::optional<EngineFault> engine_fault(const std::string& where) {
  if (where == slurm_name) return {};
  if (where.starts_with("slurm:"))
    return where.size() > slurm_name.size() + 1
               ? std::optional<EngineFault>()
               : EngineFault{"it names no partition", "slurm:PARTITION, or slurm for the default one"};
  if (where.starts_with(dask_scheme)) {
    const auto colon = where.rfind(':');
    if (colon <= dask_scheme.size())
      return EngineFault{fmt::format("'{}' is no scheduler", where),
                         "dask://HOST:PORT, such as dask://127.0.0.1:8786"};
    const auto port = parsed<int>(std::string_view(where).substr(colon + 1));
    if (!port || *port < 1 || *port > highest_port)
      return EngineFault{fmt::format("'{}' is no port", where.substr(colon + 1)),
                         fmt::format("1 to {}, 8786 unless the scheduler was told another", highest_port)};
    return {};
  }
  return EngineFault{fmt::format("'{}' is no engine", where), "dask://HOST:PORT, slurm or slurm:PARTITION"};
}

std::shared_ptr<Engine> open_engine(const std::string& where, const std::filesystem::path& out,
                                    const std::filesystem::path& stage, Problems& problems) {
  if (const auto fault = engine_fault(where)) {
    problems.push_back({"option.value"_code, "--on", 1, 1, fault->what, fault->remedy});
    return nullptr;
  }
  if (where.starts_with(dask_scheme)) {
    if (stage.empty()) return open_dask(where, problems);
    problems.push_back(
        {"cluster.not-there"_code, "--stage", 1, 1, "a Dask cluster needs no shared folder", "leave it out"});
    return nullptr;
  }
  const auto partition = where == slurm_name ? "" : where.substr(slurm_name.size() + 1);
  const auto study = std::filesystem::absolute(out).lexically_normal();
  if (stage.empty()) return open_slurm(partition, study / ".drycut-work", problems);
  if (std::error_code ignored; !std::filesystem::is_directory(stage, ignored)) {
    problems.push_back({"cluster.not-there"_code, "--stage", 1, 1,
                        fmt::format("there is no folder {}", stage.string()),
                        "name one that all machines of the cluster see"});
    return nullptr;
  }
  // The same name when the study goes on: what a killed one has left there is found.
  loop::Fingerprint name;
  name.add(study.string());
  const auto folder = fmt::format(".drycut-work-{:016x}", name.value());
  return open_slurm(partition, std::filesystem::absolute(stage).lexically_normal() / folder, problems);
}

std::filesystem::path own_program() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace drycut::sim::cluster
