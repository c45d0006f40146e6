#pragma once
#include <string>
#include <string_view>

#include "sim/file.hpp"

namespace drycut::sim::cluster {

/// All that `drycut work` needs to answer a round's runs, in one text of bytes: the question, every file that
/// it reads under the name it reads it by, and who asks.
std::string bundle_of(const std::string& kind, const std::string& question, const FileSet& files);
/// The same for the same bytes.
std::string name_of_bundle(std::string_view bundle);

struct Bundle {
  std::string kind;
  std::string question;
  std::string refused;  ///< why this program must not answer it: it is another
};
/// Reads a bundle, its files into `files`. Throws std::runtime_error if it is none.
Bundle read_bundle(std::string_view bytes, FileSet& files);

}  // namespace drycut::sim::cluster
