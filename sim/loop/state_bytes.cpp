#include "sim/loop/state_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "sim/loop/files_read.hpp"
#include "sim/loop/fingerprint.hpp"

namespace drycut::sim::loop {

namespace {

constexpr std::string_view mark = "drycut\x1aS";  // a terminal shows no more of it
constexpr std::uint32_t format = 1;

struct Begin {
  char mark[8];
  std::uint32_t format;
  std::uint32_t unused;
  std::uint64_t size;  // of all
  std::uint64_t sum;   // over what follows
  // Of the head.
  std::int64_t time;
  std::int64_t every;
  std::uint64_t journal;
  std::uint64_t journal_sum;
  std::uint64_t plain;  // 1: the run draws nothing
};
constexpr std::size_t unsummed = offsetof(Begin, time);
static_assert(sizeof(Begin) == 72 && mark.size() == sizeof Begin::mark);

std::string digest(std::string_view text) {
  Fingerprint hash;
  hash.add(text);
  return fmt::format("{:016x}", hash.value());
}

}  // namespace

StateOrigin::StateOrigin(const scenario::Scenario& scenario)
    : version(DRYCUT_VERSION), file(std::filesystem::absolute(scenario.file).lexically_normal().string()) {
  for (const auto& [path, value] : scenario.overrides) overrides.emplace_back(path, value);
  seed = scenario.scene.seed;
  Fingerprint program;
  program.add_program();
  build = fmt::format("{:016x}", program.value());
  // Section by section, to say which of them is another.
  const auto text = expand(scenario);
  for (std::size_t begin = 0; begin < text.size();) {
    auto end = begin;
    do end = std::min(text.find('\n', end), text.size() - 1) + 1;
    while (end < text.size() && (text[end] == ' ' || text[end] == '-' || text[end] == '\n'));
    const auto section = std::string_view(text).substr(begin, end - begin);
    parts.emplace_back(section.substr(0, section.find(':')), digest(section));
    begin = end;
  }
  for (const auto& [name, bytes] : read_files_of(scenario)) parts.emplace_back(name, digest(bytes));
}

void StateOrigin::visit(StateArchive& archive) {
  STATE(archive, version, build, file, overrides, seed, parts);
}

std::string StateOrigin::differs_from(const StateOrigin& other) const {
  std::string names;
  const auto lacks = [&](const auto& in, const auto& part) {
    return std::find(in.begin(), in.end(), part) == in.end();
  };
  const auto add = [&](const std::string& name) {
    if (names.find(name) == std::string::npos) names += (names.empty() ? "" : ", ") + name;
  };
  for (const auto& part : parts)
    if (lacks(other.parts, part)) add(part.first);
  for (const auto& part : other.parts)
    if (lacks(parts, part)) add(part.first);
  return names;
}

StateArchive::Bytes begun_state(StateOrigin origin) {
  StateArchive::Bytes bytes(sizeof(Begin));
  StateArchive::save(bytes, origin);
  return bytes;
}

void seal(StateArchive::Bytes& state, const StateHead& head) {
  Begin begin{{},           format,           0,         state.size(), 0, head.time, head.every,
              head.journal, head.journal_sum, head.plain};
  std::ranges::copy(mark, begin.mark);
  std::memcpy(state.data(), &begin, sizeof begin);
  begin.sum = StateArchive::sum_of(std::span(state).subspan(unsummed));
  std::memcpy(state.data(), &begin, sizeof begin);
}

OpenedState open_state(std::span<const std::byte> bytes, std::span<const std::byte> own) {
  Begin begin{};
  if (bytes.size() < sizeof begin) throw BadState("it is cut short");
  std::memcpy(&begin, bytes.data(), sizeof begin);
  if (std::string_view(begin.mark, sizeof begin.mark) != mark) throw BadState("it is no state of drycut");
  if (begin.format != format)
    throw BadState(fmt::format("it is a state of format {}, this drycut has {}", begin.format, format));
  if (begin.unused != 0) throw BadState("it was changed");
  if (begin.size != bytes.size()) throw BadState("it is cut short, or something stands behind it");
  if (begin.sum != StateArchive::sum_of(bytes.subspan(unsummed))) throw BadState("it was changed");
  OpenedState opened{{{}, begin.time, begin.every, begin.journal, begin.journal_sum, begin.plain == 1}, {}};
  if (own.size() > sizeof begin && bytes.size() >= own.size() &&
      std::equal(own.begin() + sizeof begin, own.end(), bytes.begin() + sizeof begin)) {
    opened.members = bytes.subspan(own.size());
    return opened;
  }
  const auto rest = bytes.subspan(sizeof begin);
  auto archive = StateArchive::restoring(rest.data(), rest.size());
  opened.head.origin.visit(archive);
  opened.members = rest.last(archive.left());
  return opened;
}

}  // namespace drycut::sim::loop
