#pragma once
#include <filesystem>
#include <string_view>

namespace CLI {
class App;
}

namespace drycut::sim::cli {

/// What a file is that a user may name.
enum class FileKind {
  unknown,  ///< or nothing that can be read: whoever reads it says more
  scenario,
  comparison,
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

/// Has the commands refuse a file that is of a kind which they do not take, and say what it is and who takes
/// it: all such files of a command line, before the command begins. Then CLI::RuntimeError is thrown with the
/// exit status.
void refuse_wrong_kinds(CLI::App& program);

}  // namespace drycut::sim::cli
