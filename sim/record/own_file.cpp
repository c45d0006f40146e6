#include "sim/record/own_file.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include "sim/record/hdf5_file.hpp"

namespace drycut::sim::record {

using namespace std::string_view_literals;

bool is_own_file(const std::filesystem::path& file, std::string_view header) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return false;
  std::string head(512, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  if (head.empty()) return true;
  if (head.starts_with("\x89PNG")) return head.find("Software\0drycut"sv) != std::string::npos;
  if (head.starts_with("\x89MCAP")) return head.find("drycut") != std::string::npos;
  if (head.starts_with("PK")) return head.find("generationTool=\"Drycut") != std::string::npos;
  if (is_hdf5(file)) return names_drycut(file);
  const auto line = std::string_view(head).substr(0, head.find('\n'));
  if (!header.empty() && line.starts_with(header)) return true;
  const auto words = line.substr(std::min(line.size(), line.find_first_not_of("# ")));
  return words.size() < line.size() && words.starts_with(own_mark);
}

}  // namespace drycut::sim::record
