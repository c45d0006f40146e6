#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/file.hpp"

namespace drycut::sim::cluster {

/// Runs that one process of `drycut work` does one after the other.
struct Chunk {
  int number = 0;     ///< unlike any other of the engine
  std::string items;  ///< its standard input
};

/// What is heard of a chunk.
struct WorkNews {
  int chunk = 0;
  std::string line;    ///< that `drycut work` wrote
  bool ended = false;  ///< there will be no more of it
  std::string why;     ///< it ended without having done all
};

/// A system that runs programs on many machines: it knows which are free, starts what is submitted and runs
/// it again where a machine is lost, or says that it was.
class Engine {
 public:
  Engine() = default;
  /// Ends what still runs and leaves nothing behind.
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Chunks with the bundle (sim/studies/cluster/bundle.hpp) that they are of; `name` is made of its bytes.
  virtual void submit(const std::string& name, const std::string& bundle,
                      const std::vector<Chunk>& chunks) = 0;
  /// What has come, after a while at most; may be nothing. Throws Interrupted.
  virtual std::vector<WorkNews> wait() = 0;
  /// How many chunks it can run at the same time now, at least 1.
  [[nodiscard]] virtual int workers() const = 0;
  /// How many chunks it is given at a time.
  [[nodiscard]] virtual std::size_t room() const = 0;
  /// So long should a chunk run that starting it does not count [s].
  [[nodiscard]] virtual double chunk_seconds() const = 0;

  // What has been learned of the work, kept from round to round.
  double run_seconds = 0;    ///< that the runs so far took
  std::size_t answered = 0;  ///< how many those were
  int chunks = 0;            ///< submitted so far
  FileSet files;             ///< that runs read
};

/// The engine that `where` names: dask://HOST:PORT, slurm, slurm:PARTITION, for the study whose results go to
/// `out`. Slurm's jobs read and write in a folder made below `stage` ("" = `out`), which the machines must
/// see under the same name. What is wrong goes to `problems` of `--on` and `--stage`, also that nobody is
/// there; then nullptr.
std::shared_ptr<Engine> open_engine(const std::string& where, const std::filesystem::path& out,
                                    const std::filesystem::path& stage, Problems& problems);
/// What is wrong with `where` as a text.
struct EngineFault {
  std::string what;
  std::string remedy;
};
std::optional<EngineFault> engine_fault(const std::string& where);

std::shared_ptr<Engine> open_dask(const std::string& address, Problems& problems);
std::shared_ptr<Engine> open_slurm(const std::string& partition, const std::filesystem::path& folder,
                                   Problems& problems);
/// This program's file.
std::filesystem::path own_program();

}  // namespace drycut::sim::cluster
