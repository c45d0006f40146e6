#include "sim/studies/kept_lines.hpp"

#include <fmt/format.h>

#include <optional>
#include <sstream>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/loop/fingerprint.hpp"

namespace drycut::sim::studies {

namespace {

/// A line with its checksum behind it: "a,b" becomes "a,b,0123456789abcdef".
std::string proven(std::string_view line) {
  loop::Fingerprint sum;
  sum.add(line);
  return fmt::format("{},{:016x}", line, sum.value());
}

/// The line without its checksum, nothing where that is not its own.
std::optional<std::string_view> unharmed(std::string_view line) {
  const auto comma = line.rfind(',');
  if (comma == std::string_view::npos || proven(line.substr(0, comma)) != line) return {};
  return line.substr(0, comma);
}

}  // namespace

KeptLines::KeptLines(const std::filesystem::path& file, std::string_view first, const Take& take) {
  std::ostringstream content;
  if (std::ifstream old(file, std::ios::binary); old) content << old.rdbuf();
  const auto all = content.str();
  std::string kept(first);
  if (all.starts_with(first))
    for (const auto line : split_lines(std::string_view(all).substr(first.size())))
      if (const auto whole = unharmed(line))
        if (const auto text = take(*whole); !text.empty()) kept += proven(text) + '\n';
  write_file(file, kept);
  stream_.exceptions(std::ios::failbit | std::ios::badbit);
  stream_.open(file, std::ios::binary | std::ios::app);
}

void KeptLines::add(std::string_view line) { stream_ << proven(line) + '\n' << std::flush; }

}  // namespace drycut::sim::studies
