#pragma once
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"

namespace drycut::sim {

/// The folder that a command writes its results into. One process has it at a time. A manifest in it,
/// `.drycut-KIND`, lists what the command writes; the next command of that kind removes those files and no
/// others.
class OutputFolder {
 public:
  /// Makes the folder where there is none, and locks it. `kind` is what writes: "run", "compare"; `names` are
  /// the files, and with a slash at their end the folders, that it may write. It is a problem of `--out` if
  /// the folder cannot be made, if nothing can be written into it, if another process has it, or if under
  /// these names lies what no manifest of this kind lists; then nothing was touched.
  OutputFolder(std::filesystem::path folder, const std::string& kind, const std::vector<std::string>& names,
               Problems& problems);

  /// Before anything else is written: removes what an earlier command of this kind wrote, but `kept`. Throws
  /// std::runtime_error if that cannot be done.
  void begin(const std::vector<std::string>& kept = {});

  /// The same for what is made at the end of long work: what an earlier command of this kind wrote stays
  /// until finish(), and what is added but `kept` waits in a folder of its own until then. What fails on the
  /// way leaves the earlier results whole.
  void begin_aside(const std::vector<std::string>& kept);
  /// What was added since begin_aside() takes its place; of what was there before it, only `kept` stays.
  /// Throws likewise.
  void finish();

  /// Removes files that it has, and no longer lists them. Throws likewise.
  void take_back(const std::vector<std::string>& names);
  /// Calls a file that it has, and that nobody wants any more, by the name of one about to be written into
  /// it; returns its path. Nothing else lies under that name. Throws likewise.
  std::filesystem::path reuse(const std::string& file, const std::string& name);

  /// A file about to be written, as "trace.csv" or "plots/motion.png": lists it in the manifest, makes its
  /// folder and returns its path. Throws std::runtime_error if it cannot be listed, or if something that is
  /// not ours has come to lie there.
  std::filesystem::path add(const std::string& name);
  /// The same for many at once; returns the folder that they lie in.
  std::filesystem::path add(const std::string& subfolder, const std::vector<std::string>& names);

  /// What it has, by the manifest, in the manner of "plots/motion.png".
  [[nodiscard]] const std::set<std::string>& listed() const { return listed_; }
  /// What it will have when all is finished, in the same manner.
  [[nodiscard]] std::vector<std::string> files() const;
  [[nodiscard]] const std::string& kind() const { return kind_; }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

 private:
  [[nodiscard]] bool is_ours(const std::filesystem::path& file) const;
  [[nodiscard]] std::vector<std::string> strangers(const std::vector<std::string>& names) const;
  void list(const std::vector<std::string>& names);
  void remove(const std::set<std::string>& names);
  void write_manifest(const std::set<std::string>& names);

  std::filesystem::path folder_;
  std::filesystem::path manifest_;
  std::string kind_;
  std::shared_ptr<void> made_;          ///< folders that were not there; they stay if they are used
  std::shared_ptr<void> lock_;          ///< held as long as somebody refers to it
  std::set<std::string> listed_;        ///< by the manifest, in the manner of "plots/motion.png"
  std::string aside_ = {};              ///< the folder in it where what is added waits; "" = nothing waits
  std::set<std::string> kept_ = {};     ///< by begin_aside()
  std::set<std::string> waiting_ = {};  ///< what was added and waits, as it will be called
};

}  // namespace drycut::sim
