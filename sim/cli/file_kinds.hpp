#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace drycut::sim::cli {

/// What a file is that a user may name.
enum class FileKind {
  unknown,  ///< or nothing that can be read: whoever reads it says more
  scenario,
  comparison,
  recording,
  session,
  configuration,
  module,
  instruction_list,
  structured_text,
  registers,
  program_table,
  cam_table,
  trace,
  events,
  checks,
  hdf5,
  mcap,
  fmu,
  report,
  junit,
  model,
  picture,
  film,
  run_folder,
  session_folder,
  folder,
};

/// By its ending, and by what it holds where several kinds have that ending.
FileKind kind_of(const std::filesystem::path& file);

/// "a QMOVE configuration"; "" = unknown.
std::string_view name_of(FileKind kind);

/// The files that a command takes.
struct Takes {
  std::string_view option = {};
  std::vector<FileKind> kinds = {};  ///< the first is what it is for; none: any file
};
/// Refuses every file of another kind, says what it is and who takes it. Then CLI::RuntimeError is thrown
/// with the exit status.
void refuse_wrong_kinds(const Takes& takes, const std::vector<std::string>& files);

}  // namespace drycut::sim::cli
