// Slurm: a chunk is a task of a job array; items, answers and what went wrong are files in a folder that all
// machines see.
#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <ctime>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "base/text.hpp"
#include "renders/process.hpp"
#include "sim/interrupt.hpp"
#include "sim/loop/fingerprint.hpp"
#include "sim/studies/cluster/engine.hpp"

namespace drycut::sim::cluster {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int most_tasks = 1000;  // of an array: Slurm's MaxArraySize is 1001 unless it was set
constexpr auto most_patience = seconds(30);

renders::Finished ask_slurm(const std::string& program, std::vector<std::string> arguments) {
  return renders::run_process({program, "slurm-client, on a machine of the cluster", std::move(arguments)});
}

std::string own_user() {
  const auto* known = getpwuid(getuid());
  return known != nullptr ? known->pw_name : std::to_string(getuid());
}

/// For the shell.
std::string quoted(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return safe + "'";
}

struct Partition {
  std::string name;
  bool up = false;
  bool is_default = false;
  int processors = 0;
};

/// What `sinfo` says. Throws renders::HelperFailed if there is none, or if nobody answers.
std::vector<Partition> partitions() {
  const auto told = ask_slurm("sinfo", {"--noheader", "--format=%P|%a|%C"});
  if (!told.good) throw renders::HelperFailed(told.words);
  std::vector<Partition> found;
  for (const auto line : split_lines(told.output)) {
    const auto bar = line.find('|');
    const auto second = line.find('|', bar + 1);
    if (bar == std::string_view::npos || second == std::string_view::npos) continue;
    std::string name(line.substr(0, bar));
    const bool is_default = name.ends_with('*');
    if (is_default) name.pop_back();
    auto same =
        std::find_if(found.begin(), found.end(), [&](const auto& other) { return other.name == name; });
    if (same == found.end()) same = found.insert(same, Partition{name, false, is_default, 0});
    same->up = same->up || line.substr(bar + 1, second - bar - 1) == "up";
    int allocated = 0;
    int idle = 0;
    const auto counts = std::string(line.substr(second + 1));  // allocated/idle/other/total
    if (std::sscanf(counts.c_str(), "%d/%d", &allocated, &idle) == 2) same->processors += allocated + idle;
  }
  return found;
}

class Slurm final : public Engine {
 public:
  Slurm(Partition partition, fs::path folder) : partition_(std::move(partition)), folder_(std::move(folder)) {
    loop::Fingerprint hash;
    hash.add(folder_.string());
    name_ = fmt::format("drycut-{:016x}", hash.value());
    if (fs::exists(folder_)) clean();  // of a study that was killed
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw std::runtime_error(fmt::format("cannot make {}: {}", folder_.string(), error.message()));
  }
  ~Slurm() override {
    try {
      clean();
    } catch (const std::exception&) {  // what is left is found by the next one
    }
  }

  void submit(const std::string& name, const std::string& bundle, const std::vector<Chunk>& chunks) override {
    const auto staged = folder_ / (name + ".bundle");
    if (!fs::exists(staged)) write_file(staged, bundle);
    for (std::size_t first = 0; first < chunks.size(); first += most_tasks)
      submit_array(staged, {chunks.begin() + static_cast<std::ptrdiff_t>(first),
                            chunks.begin() +
                                static_cast<std::ptrdiff_t>(std::min(chunks.size(), first + most_tasks))});
  }

  std::vector<WorkNews> wait() override {
    std::vector<WorkNews> news;
    // A look at the answers costs the file server something for every chunk.
    rest(std::clamp(milliseconds(2) * static_cast<int>(out_.size()), milliseconds(50), milliseconds(2000)));
    for (auto& [number, task] : out_) listen(number, task, news);
    if (Clock::now() >= next_look_) look_for_lost(news);
    for (const auto& one : news)
      if (one.ended) forget(one.chunk);
    return news;
  }

  [[nodiscard]] int workers() const override { return std::max(1, partition_.processors); }
  [[nodiscard]] std::size_t room() const override { return most_tasks; }
  [[nodiscard]] double chunk_seconds() const override { return 10; }

 private:
  struct Task {
    std::string id;  ///< "12_3": of the array and in it
    std::streamoff read = 0;
    bool missed = false;  ///< at the last look
  };

  [[nodiscard]] fs::path file(int chunk, const char* kind) const {
    return folder_ / fmt::format("{}.{}", chunk, kind);
  }

  void submit_array(const fs::path& staged, const std::vector<Chunk>& chunks) {
    const int first = chunks.front().number;
    for (const auto& chunk : chunks) write_file(file(chunk.number, "items"), chunk.items);
    const auto script = folder_ / "chunk.sh";
    write_file(script,
               fmt::format(
                   "#!/bin/sh\n"
                   "program={}\n"
                   "[ -x \"$program\" ] || program=drycut\n"
                   "chunk={}/$(({} + SLURM_ARRAY_TASK_ID))\n"
                   "exec \"$program\" work {} < \"$chunk.items\" > \"$chunk.answers\" 2> \"$chunk.said\"\n",
                   quoted(own_program().string()), quoted(folder_.string()), first, quoted(staged.string())));
    std::vector<std::string> arguments = {"--parsable",
                                          "--job-name=" + name_,
                                          fmt::format("--array=0-{}", chunks.size() - 1),
                                          "--ntasks=1",
                                          "--no-requeue",
                                          "--output=/dev/null",
                                          "--partition=" + partition_.name,
                                          script.string()};
    const auto told = ask_slurm("sbatch", std::move(arguments));
    InterruptWatch::check();
    if (!told.good) throw std::runtime_error(told.words);
    const auto job = told.output.substr(0, told.output.find_first_of(";\n"));
    for (const auto& chunk : chunks)
      out_[chunk.number] = {fmt::format("{}_{}", job, chunk.number - first), 0, false};
    next_look_ = Clock::now() + patience_;
  }

  static void rest(milliseconds time) {
    InterruptWatch::check();
    const timespec until = {time.count() / 1000, time.count() % 1000 * 1'000'000};
    nanosleep(&until, nullptr);
    InterruptWatch::check();
  }

  /// The whole lines that have come; "end" is the last one of a chunk that has done all.
  void listen(int number, Task& task, std::vector<WorkNews>& news) const {
    std::ifstream stream(file(number, "answers"), std::ios::binary);
    if (!stream || !stream.seekg(task.read)) return;
    for (std::string line; std::getline(stream, line) && !stream.eof();) {
      task.read += static_cast<std::streamoff>(line.size()) + 1;
      task.missed = false;
      const bool last = line == R"({"end":true})";
      news.push_back({number, last ? "" : line, last, ""});
    }
  }

  /// A task that two looks have not found in the queue, and that has not said that it is done, was lost.
  void look_for_lost(std::vector<WorkNews>& news) {
    const auto begin = Clock::now();
    const auto told = ask_slurm(
        "squeue", {"--noheader", "--array", "--user=" + own_user(), "--name=" + name_, "--format=%F_%K"});
    // Not oftener than it is easy for Slurm.
    next_look_ =
        Clock::now() + std::clamp<Clock::duration>(50 * (Clock::now() - begin), patience_, most_patience);
    if (!told.good) return;  // the queue cannot be seen now; those who run go on
    std::set<std::string, std::less<>> queue;
    for (const auto line : split_lines(told.output)) queue.emplace(line);
    for (auto& [number, task] : out_) {
      if (queue.contains(task.id)) continue;
      if (!std::exchange(task.missed, true)) continue;
      const auto before = news.size();
      listen(number, task, news);
      if (news.size() == before) news.push_back({number, "", true, fate(number, task)});
    }
  }

  /// "FAILED, exit code 0:9 (out of memory)"
  [[nodiscard]] std::string fate(int number, const Task& task) const {
    const auto told = ask_slurm("scontrol", {"--oneliner", "show", "job", task.id});
    const auto value = [&](std::string_view key) {
      const auto at = told.output.find(key);
      if (at == std::string::npos) return std::string();
      const auto begin = at + key.size();
      return told.output.substr(begin, told.output.find(' ', begin) - begin);
    };
    auto text = value("JobState=").empty() ? std::string("Slurm knows nothing of it any more")
                                           : fmt::format("{} on {}, exit code {}", value("JobState="),
                                                         value(" NodeList="), value("ExitCode="));
    std::ifstream said(file(number, "said"));
    std::string last;
    for (std::string line; std::getline(said, line);)
      if (!line.empty()) last = line;
    return last.empty() ? text : text + ": " + last;
  }

  void forget(int chunk) {
    out_.erase(chunk);
    std::error_code ignored;
    for (const auto* kind : {"items", "answers", "said"}) fs::remove(file(chunk, kind), ignored);
  }

  /// No job in the queue and no file left. Jobs that end may still write: first they are waited for.
  void clean() const {
    const auto queued = [&] {
      const auto told =
          ask_slurm("squeue", {"--noheader", "--user=" + own_user(), "--name=" + name_, "--format=%F"});
      return told.good && !told.output.empty();
    };
    if (queued()) {
      ask_slurm("scancel", {"--quiet", "--user=" + own_user(), "--name=" + name_});
      const auto end = Clock::now() + most_patience;
      while (queued() && Clock::now() < end) {
        const timespec moment = {0, 200'000'000};
        nanosleep(&moment, nullptr);
      }
    }
    fs::remove_all(folder_);
  }

  static constexpr Clock::duration patience_ = std::chrono::seconds(1);

  InterruptWatch watch_;
  Partition partition_;
  fs::path folder_;
  std::string name_;  ///< of the jobs: the same when the study goes on
  std::map<int, Task> out_;
  Clock::time_point next_look_;
};

}  // namespace

std::shared_ptr<Engine> open_slurm(const std::string& partition, const fs::path& folder, Problems& problems) {
  const auto refuse = [&](Code code, const std::string& what, const std::string& remedy) {
    problems.push_back({code, "--on", 1, 1, what, remedy});
    return nullptr;
  };
  std::vector<Partition> known;
  try {
    known = partitions();
  } catch (const renders::HelperFailed& error) {
    return refuse("cluster.not-there"_code, fmt::format("slurm: {}", error.what()),
                  "run it on a machine where sinfo answers");
  }
  const auto found = std::find_if(known.begin(), known.end(), [&](const Partition& one) {
    return partition.empty() ? one.is_default : one.name == partition;
  });
  std::vector<std::string> names;
  for (const auto& one : known) names.push_back(one.name);
  if (found == known.end() && partition.empty())
    return refuse("cluster.not-there"_code, "slurm: there is no default partition",
                  fmt::format("name one: slurm:{}", names.empty() ? "PARTITION" : names.front()));
  if (found == known.end())
    return refuse("cluster.not-there"_code, fmt::format("slurm: there is no partition '{}'", partition),
                  did_you_mean(partition, names));
  if (!found->up)
    return refuse("cluster.not-there"_code, fmt::format("slurm: partition {} is down", found->name),
                  "choose another, or have it brought up");
  return std::make_shared<Slurm>(*found, folder);
}

}  // namespace drycut::sim::cluster
