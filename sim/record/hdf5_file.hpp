#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/record/deflate.hpp"
#include "sim/record/record.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::record {

/// trace.h5: channels and events of a run in HDF5 (docs/records.md), written while the run goes on. It can be
/// read at any moment by SWMR, and after whatever has ended the run. Rows come into
/// the file by blocks of 4096, events after a second of machine time at the latest. The same inputs give the
/// same bytes. Throws std::runtime_error when something cannot be written.
class Hdf5File : public Observer {
 public:
  /// `recording` has all its channels and outlives this.
  Hdf5File(const Recording& recording, const std::filesystem::path& file, const About& about);
  ~Hdf5File() override;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  /// The present values of the recording's channels.
  void sample(Time time) override;
  void happened(const RecordedEvent& event) override;
  /// Everything is in the file, and it is closed.
  void finish() override;

 private:
  struct Open;
  void put_block();
  void put_column(std::size_t number);
  void put_events();
  void require(bool good) const;

  std::filesystem::path file_;
  std::vector<const double*> slots_;
  std::vector<double> block_;   ///< the channels' columns, then the time's
  std::size_t filled_ = 0;      ///< rows in it
  std::size_t written_ = 0;     ///< rows in the file
  std::size_t events_ = 0;      ///< told so far
  std::size_t event_rows_ = 0;  ///< in the file
  Time events_due_ = 0;
  Deflate deflate_;
  std::unique_ptr<Open> open_;  ///< nullptr once finished
};

/// Adds the tables `outcome`, `checks`, `alarms` and `drives` to the file of a run that has come to its end.
/// Throws std::runtime_error if it cannot be written.
void add_outcome(const std::filesystem::path& file, const Outcome& outcome);

/// The file is HDF5, by its first bytes.
bool is_hdf5(const std::filesystem::path& file);

/// Whether its attribute written_by names drycut; false of what HDF5 cannot open.
bool names_drycut(const std::filesystem::path& file);

/// How bad an event of a name is, which files do not say.
using SeverityOf = std::function<Severity(const std::string& event)>;

/// Reads trace.h5, also while it is written or after its run was killed: all rows that are whole in it. What
/// is wrong goes to `problems`, and then the result is not to be used.
Record read_hdf5(const std::filesystem::path& file, Problems& problems, const SeverityOf& severity_of = {});

}  // namespace drycut::sim::record
