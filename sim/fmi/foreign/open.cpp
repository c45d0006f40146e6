#include <fmt/format.h>
#include <fmt/ranges.h>

#include <mutex>
#include <optional>
#include <set>

#include "sim/fmi/foreign/archive.hpp"
#include "sim/fmi/foreign/description.hpp"
#include "sim/fmi/foreign/process.hpp"
#include "sim/scenario/guests.hpp"

namespace drycut::sim::fmi {

namespace {

namespace fs = std::filesystem;

/// A path in a URI.
std::string uri_of(const fs::path& folder) {
  std::string uri = "file://";
  for (const char c : folder.string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("/-_.~").find(c) != std::string_view::npos;
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

class ForeignType : public plants::GuestType {
 public:
  ForeignType(std::string bytes, std::string name) : bytes_(std::move(bytes)), name_(std::move(name)) {
    const FmuArchive archive(bytes_);
    if (!archive.has("modelDescription.xml"))
      throw scenario::GuestRefused("fmu.archive"_code, "it is no FMU: it has no modelDescription.xml",
                                   "name an .fmu");
    description_ = read_description(archive.bytes("modelDescription.xml"));
    if (!archive.has(library())) refuse_without_library(archive);
    origin_ = fmt::format("FMI {}.0, model {}{}{}", description_.version, description_.model,
                          description_.tool.empty() ? "" : ", by ", description_.tool);
  }

  [[nodiscard]] const std::string& origin() const override { return origin_; }
  [[nodiscard]] const std::vector<plants::GuestVariable>& variables() const override {
    return description_.variables;
  }
  [[nodiscard]] bool keeps_state() const override { return description_.keeps_state; }
  [[nodiscard]] double fixed_step() const override { return description_.fixed_step; }

  std::unique_ptr<plants::GuestModel> start(const Start& start, std::span<double> outputs) const override {
    constexpr std::uint64_t megabyte = 1000000;
    const auto folder = unpacked();
    host::LoadRequest load;
    load.version = description_.version;
    load.library = (folder->path() / library()).string();
    const auto resources = folder->path() / "resources";
    fs::create_directories(resources);
    load.resources = description_.version == 2 ? uri_of(resources) : resources.string() + "/";
    load.token = description_.token;
    load.name = description_.model;
    load.memory = static_cast<std::uint64_t>(start.memory_limit) * megabyte;
    load.keeps_state = description_.keeps_state;
    for (const auto& [variable, first] : description_.exchanged) {
      const auto role = description_.variables[first].role;
      if (role == plants::GuestVariable::Role::input) load.inputs.push_back(variable);
      if (role == plants::GuestVariable::Role::output) load.outputs.push_back(variable);
      if (role == plants::GuestVariable::Role::parameter) add_parameter(variable, first, start, load);
    }
    return std::make_unique<GuestProcess>(folder, name_, load, start.time_limit, outputs);
  }

 private:
  /// It is of another platform, or its library has another name than the description says.
  [[noreturn]] void refuse_without_library(const FmuArchive& archive) const {
    const auto folder = fs::path(library()).parent_path().string() + "/";
    constexpr std::string_view binaries = "binaries/";
    std::set<std::string> libraries;
    std::set<std::string> platforms;
    for (const auto& name : archive.names()) {
      if (name.starts_with(folder) && name.ends_with(".so")) libraries.insert(name.substr(folder.size()));
      if (name.starts_with(binaries)) platforms.insert(name.substr(0, name.find('/', binaries.size())));
    }
    if (!libraries.empty())
      throw scenario::GuestRefused(
          "fmu.refused"_code,
          fmt::format("its description says modelIdentifier=\"{0}\", so that its library is {1}{0}.so; there "
                      "it has {2}",
                      description_.identifier, folder, fmt::join(libraries, ", ")),
          "it is the exporting tool's: the library has the name of the modelIdentifier");
    throw scenario::GuestRefused(
        "fmu.refused"_code,
        fmt::format("it has no library for this machine: no {}{}{}", library(),
                    platforms.empty() ? "" : "; it has ", fmt::join(platforms, ", ")),
        "export it for 64-bit Linux");
  }

  [[nodiscard]] std::string library() const {
    return fmt::format("binaries/{}/{}.so", description_.version == 2 ? "linux64" : "x86_64-linux",
                       description_.identifier);
  }

  /// Of an array all elements, if one of them is not as the FMU has it.
  void add_parameter(const host::SharedVariable& variable, std::size_t first, const Start& start,
                     host::LoadRequest& load) const {
    std::vector<double> numbers;
    for (std::size_t n = 0; n < variable.elements; ++n)
      numbers.push_back(description_.variables[first + n].start);
    bool given = false;
    for (const auto& [place, value] : start.parameters) {
      if (place < first || place >= first + variable.elements) continue;
      given = true;
      if (const auto* text = std::get_if<std::string>(&value))
        load.texts.push_back(*text);
      else
        numbers[place - first] = std::get<double>(value);
    }
    if (!given) return;
    load.parameters.push_back(variable);
    if (variable.kind != host::NumberKind::text)
      load.numbers.insert(load.numbers.end(), numbers.begin(), numbers.end());
  }

  /// Once, when the first instance begins.
  std::shared_ptr<const OwnFolder> unpacked() const {
    const std::lock_guard lock(mutex_);
    if (!unpacked_) {
      auto folder = std::make_shared<OwnFolder>();
      FmuArchive(bytes_).unpack({fs::path(library()).parent_path().string() + "/", "resources/"},
                                folder->path());
      write_host(folder->path());
      unpacked_ = std::move(folder);
    }
    return unpacked_;
  }

  std::string bytes_;
  std::string name_;
  std::string origin_;
  ForeignDescription description_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const OwnFolder> unpacked_;
};

}  // namespace

}  // namespace drycut::sim::fmi

namespace drycut::sim::scenario {

std::shared_ptr<const plants::GuestType> open_guest(std::string bytes, const std::string& name) {
  return std::make_shared<fmi::ForeignType>(std::move(bytes), name);
}

}  // namespace drycut::sim::scenario
