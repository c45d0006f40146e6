#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "sim/loop/state_bytes.hpp"
#include "sim/output_folder.hpp"
#include "sim/time.hpp"

namespace drycut::sim::loop {

class Simulation;

/// The folder of a run's folder that states lie in.
inline constexpr auto* states_folder = "states/";

/// A moment of a run that was kept.
struct KeptMoment {
  std::string name;  ///< of its file
  StateHead head;
  StateArchive::Bytes state;
  StateArchive::Bytes journal;  ///< up to then
};

/// The newest moment that a run's folder keeps whole, at `until` or before; nothing = there is none. Those
/// that are damaged are told in `damaged`, a phrase each.
std::optional<KeptMoment> kept_moment(const std::filesystem::path& run, Time until,
                                      std::vector<std::string>& damaged);

/// Keeps moments of a run in its folder: a file each, and a journal of what was recorded. Of many every
/// second one goes, then every second of the rest, so that they lie evenly over the run; the last two stay.
/// Where there is no more room the keeping ends, not the run: what was kept makes room for it.
class KeptStates {
 public:
  /// A moment `every` so often, `most` files, 4 or more. `from`: what the run goes on from, which may lie in
  /// this folder; what was kept behind it goes.
  KeptStates(OutputFolder& folder, Time every, std::size_t most, const KeptMoment* from = nullptr);
  ~KeptStates();
  KeptStates(const KeptStates&) = delete;
  KeptStates& operator=(const KeptStates&) = delete;

  void keep(Simulation& simulation);
  /// After the last. Why not all was kept, "" = it was.
  const std::string& finish();

 private:
  void write(const std::string& name, std::span<const std::byte> state);
  void thin();
  void give_up();

  struct File;  ///< one that is written into as it is
  struct Kept {
    std::string name;
    Time number;  ///< of its moment
  };
  OutputFolder& folder_;
  Time every_;
  std::size_t most_;
  std::unique_ptr<File> file_;  ///< the journal
  StateArchive::Journal journal_;
  std::vector<Kept> kept_;
  std::vector<std::string> spare_;  ///< files of moments that went: to make and remove one takes longer
  Time stride_ = 1;
  std::string trouble_;
};

}  // namespace drycut::sim::loop
