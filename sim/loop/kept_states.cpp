#include "sim/loop/kept_states.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "base/output_file.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim::loop {

namespace fs = std::filesystem;

namespace {

constexpr auto* journal_name = "states/journal";
constexpr std::string_view ending = ".state";

std::string name_of(Time time) {
  return fmt::format("{}{:07}.{:09}{}", states_folder, time / second, time % second, ending);
}

Time time_of(const std::string& name) {
  const auto digits = name.substr(std::string_view(states_folder).size());
  const auto dot = digits.find('.');
  return std::strtoll(digits.c_str(), nullptr, 10) * second +
         std::strtoll(digits.c_str() + dot + 1, nullptr, 10);
}

/// At most so many bytes of a file; nothing where it cannot be read.
std::optional<StateArchive::Bytes> bytes_of(const fs::path& file, std::uint64_t most = UINT64_MAX) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) return {};
  StateArchive::Bytes bytes(
      static_cast<std::size_t>(std::min(most, static_cast<std::uint64_t>(stream.tellg()))));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return stream ? std::optional(std::move(bytes)) : std::nullopt;
}

[[noreturn]] void fail() { throw std::runtime_error(std::strerror(errno)); }

}  // namespace

struct KeptStates::File {
  explicit File(const fs::path& path) : descriptor(open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666)) {
    if (descriptor < 0) fail();
  }
  ~File() { close(descriptor); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int descriptor;
};

std::optional<KeptMoment> kept_moment(const fs::path& run, Time until, std::vector<std::string>& damaged) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(run / states_folder, none))
    if (entry.path().extension() == ending) names.push_back(states_folder + entry.path().filename().string());
  std::ranges::sort(names, std::greater());
  for (const auto& name : names) {
    if (until != never && name > name_of(until)) continue;
    try {
      auto state = bytes_of(run / name);
      if (!state) throw BadState("it cannot be read");
      auto head = open_state(*state).head;
      auto journal = bytes_of(run / journal_name, head.journal);
      if (!journal || journal->size() < head.journal) throw BadState("its journal is cut short");
      if (StateArchive::going_on(*journal).sum != head.journal_sum)
        throw BadState("its journal is another run's");
      return KeptMoment{name, std::move(head), std::move(*state), std::move(*journal)};
    } catch (const BadState& bad) {
      damaged.push_back(fmt::format("{}: {}", (run / name).string(), bad.what()));
    }
  }
  return {};
}

KeptStates::KeptStates(OutputFolder& folder, Time every, std::size_t most, const KeptMoment* from)
    : folder_(folder), every_(every), most_(std::max<std::size_t>(4, most)) {
  if (from == nullptr) return;
  journal_ = StateArchive::going_on(from->journal);
  if (!folder.listed().contains(journal_name)) {
    journal_.begin = 0;
    journal_.bytes = from->journal;
    return;
  }
  std::vector<std::string> later;
  for (const auto& name : folder.listed()) {
    if (!name.starts_with(states_folder) || !name.ends_with(ending)) continue;
    if (name > from->name)
      later.push_back(name);
    else
      kept_.push_back({name, time_of(name) / every_});
  }
  folder.take_back(later);
}

KeptStates::~KeptStates() = default;

void KeptStates::keep(Simulation& simulation) {
  if (!trouble_.empty()) return;
  try {
    const auto state = simulation.save(&journal_);
    // The run's own files want room until the next moment, too.
    constexpr std::uintmax_t moments_ahead = 8;
    if (fs::space(folder_.path()).available < moments_ahead * (journal_.bytes.size() + state.size()))
      throw std::runtime_error(std::strerror(ENOSPC));
    if (!file_) {
      file_ = std::make_unique<File>(folder_.add(journal_name));
      const auto begin = static_cast<off_t>(journal_.begin);
      if (ftruncate(file_->descriptor, begin) != 0 || lseek(file_->descriptor, begin, SEEK_SET) != begin)
        fail();
    }
    // The journal first: a state whose journal is not there is none.
    write_all(file_->descriptor, journal_.bytes);
    journal_.begin += journal_.bytes.size();
    journal_.bytes.clear();
    const auto name = name_of(simulation.time());
    write(name, state);
    kept_.push_back({name, simulation.time() / every_});
    thin();
  } catch (const std::exception& error) {
    trouble_ = fmt::format(
        "no states are kept from {} s on, and those before are given up for the run's own files: {}",
        record::seconds_text(simulation.time()), error.what());
    give_up();
  }
}

// Under its own name from the start: who is killed meanwhile leaves one that its sum shows to be damaged.
void KeptStates::write(const std::string& name, std::span<const std::byte> state) {
  const bool again = !spare_.empty();
  const auto path = again ? folder_.reuse(spare_.back(), name) : folder_.add(name);
  if (again) spare_.pop_back();
  const File file(path);
  write_all(file.descriptor, state);
  if (again && ftruncate(file.descriptor, static_cast<off_t>(state.size())) != 0) fail();
}

const std::string& KeptStates::finish() {
  folder_.take_back(std::exchange(spare_, {}));
  return trouble_;
}

void KeptStates::give_up() {
  file_.reset();
  auto names = std::exchange(spare_, {});
  for (auto& kept : std::exchange(kept_, {})) names.push_back(std::move(kept.name));
  names.emplace_back(journal_name);
  try {
    folder_.take_back(names);
  } catch (const std::exception&) {  // they stay where they are
  }
}

// All but the last two lie on the stride, which doubles where they are still too many.
void KeptStates::thin() {
  const auto take_back = [&](std::size_t i) {
    spare_.push_back(std::move(kept_[i].name));
    kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(i));
  };
  const auto drop = [&] {
    for (std::size_t i = 0; i + 2 < kept_.size();) {
      if (kept_[i].number % stride_ == 0)
        ++i;
      else
        take_back(i);
    }
  };
  drop();
  while (kept_.size() > most_) {
    if (stride_ > kept_.back().number) {
      take_back(0);  // of a run that kept them closer before it went on
    } else {
      stride_ *= 2;
      drop();
    }
  }
}

}  // namespace drycut::sim::loop
