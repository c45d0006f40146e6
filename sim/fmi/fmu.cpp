#include "sim/fmi/fmu.hpp"

#include <fmt/format.h>
#include <link.h>
#include <minizip/zip.h>
#include <udunits2.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/embedded.hpp"
#include "base/output_file.hpp"
#include "sim/fmi/line/built_line.hpp"
#include "sim/fmi/machine/built_machine.hpp"
#include "sim/fmi/resolve.hpp"

// The libraries of binary/, of machine and line, which the build puts into this program.
extern "C" const char drycut_fmu_begin[];
extern "C" const char drycut_fmu_end[];
extern "C" const char drycut_fmu_line_begin[];
extern "C" const char drycut_fmu_line_end[];

namespace drycut::sim::fmi {

namespace fs = std::filesystem;

namespace {

// Entries with one date, so that the same FMU has the same bytes.
class ZipFile {
 public:
  explicit ZipFile(const fs::path& file) : file_(file), zip_(zipOpen64(file.c_str(), APPEND_STATUS_CREATE)) {
    if (zip_ == nullptr) throw std::runtime_error(fmt::format("cannot write {}", file.string()));
  }
  ~ZipFile() {
    if (zip_ != nullptr) zipClose(zip_, nullptr);
  }
  ZipFile(const ZipFile&) = delete;
  ZipFile& operator=(const ZipFile&) = delete;

  void add(const std::string& name, std::string_view bytes, int level = 6) {
    zip_fileinfo info{};
    info.dosDate = (1U << 21U) | (1U << 16U);  // 1980-01-01
    constexpr unsigned long utf8_names = 1U << 11U;
    require(zipOpenNewFileInZip4_64(zip_, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                                    level == 0 ? 0 : Z_DEFLATED, level, 0, -MAX_WBITS, DEF_MEM_LEVEL,
                                    Z_DEFAULT_STRATEGY, nullptr, 0, 0, utf8_names, 0));
    require(zipWriteInFileInZip(zip_, bytes.data(), static_cast<unsigned>(bytes.size())));
    require(zipCloseFileInZip(zip_));
  }
  void finish() { require(zipClose(std::exchange(zip_, nullptr), nullptr)); }

 private:
  void require(int code) const {
    if (code != ZIP_OK) throw std::runtime_error(fmt::format("cannot write {}", file_.string()));
  }
  fs::path file_;
  zipFile zip_;
};

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw std::runtime_error(fmt::format("cannot read {}", file.string()));
  return bytes;
}

// A file for the archive, which minizip writes by a name; what --out names takes the bytes as all outputs do.
class ScratchFile {
 public:
  ScratchFile() : name_((fs::temp_directory_path() / "drycut-XXXXXX").string()) {
    const int made = mkstemp(name_.data());
    if (made < 0) throw std::runtime_error(fmt::format("cannot write {}", name_));
    close(made);
  }
  ~ScratchFile() { unlink(name_.c_str()); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
};

// What libraries an FMU carries beside its own, by how their files' names begin, and the packages of their
// licences. With a line the reader of scenarios comes.
struct Carried {
  std::vector<std::string_view> libraries = {"libBulletDynamics", "libBulletCollision", "libLinearMath",
                                             "libfmt"};
  std::vector<std::string_view> packages = {"libbullet", "libfmt"};
};
Carried carried_with_line() {
  Carried carried;
  for (const auto* library : {"libyaml-cpp", "libudunits2", "libexpat", "libpugixml", "libminizip", "libz."})
    carried.libraries.emplace_back(library);
  for (const auto* package : {"libyaml-cpp", "libudunits2", "libexpat", "libpugixml", "libminizip", "zlib1g"})
    carried.packages.emplace_back(package);
  return carried;
}

bool begins_with_one(const std::string& name, const std::vector<std::string_view>& beginnings) {
  return std::ranges::any_of(beginnings, [&](std::string_view begin) { return name.starts_with(begin); });
}

// Libraries that a bare Debian has not, as this very process has them loaded, which is linked to them too.
std::vector<fs::path> carried_libraries(const Carried& carried) {
  std::vector<fs::path> loaded;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* all) {
        static_cast<std::vector<fs::path>*>(all)->emplace_back(info->dlpi_name);
        return 0;
      },
      &loaded);
  std::erase_if(loaded, [&](const fs::path& file) {
    return !begins_with_one(file.filename().string(), carried.libraries);
  });
  std::ranges::sort(loaded);
  return loaded;
}

// As their packages have them.
std::vector<fs::path> licences_of(const Carried& carried) {
  std::vector<fs::path> found;
  std::error_code none;
  for (const auto& package : fs::directory_iterator("/usr/share/doc", none)) {
    const auto name = package.path().filename().string();
    const bool is_carried = begins_with_one(name, carried.packages) && !name.ends_with("-dev");
    if (is_carried && fs::exists(package.path() / "copyright", none))
      found.push_back(package.path() / "copyright");
  }
  if (found.empty())
    throw std::runtime_error(
        "the licences of the libraries that an FMU carries are not installed: "
        "/usr/share/doc/libbullet*/copyright");
  std::ranges::sort(found);
  return found;
}

constexpr std::string_view licence_file = "LICENSE";  // of Drycut, where it has one

std::string_view own_licence() {
  if (!embedded_file(licence_file).empty())
    return "Drycut's own library in it is under the licence of Drycut, licenses/drycut.txt.";
  return "Drycut's own library in it is under no licence that this build of Drycut has a text of: ask its "
         "authors before you give the FMU away.";
}

// A name in C.
std::string identifier_of(const fs::path& scenario) {
  auto name = scenario.stem().string();
  for (auto& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) name.insert(0, "_");
  return name;
}

// What an FMU is made of beside the standard.
struct FmuParts {
  std::string_view library;
  std::string what;  // in a sentence
  std::string use;
  Carried carried;
  std::vector<std::pair<std::string, std::string>>
      resources;                        // names and bytes; the first one makes the token
  std::vector<std::string> files = {};  // of the user, among the resources
};

WrittenFmu write_parts(const scenario::Scenario& scenario, Standard standard, const FmuParts& parts,
                       const std::vector<FmiVariable>& variables, const fs::path& out) {
  const FmuHead head{identifier_of(scenario.file),
                     scenario.scene.title,
                     token_of(parts.resources.front().second),
                     seconds(scenario.scene.step),
                     seconds(scenario.scene.duration),
                     parts.what,
                     parts.use};
  const ScratchFile scratch;
  ZipFile zip(scratch.name());
  zip.add("modelDescription.xml", model_description(standard, head, variables),
          0);  // who wrote it is seen so
  const std::string folder = standard == Standard::fmi2 ? "binaries/linux64/" : "binaries/x86_64-linux/";
  zip.add(folder + head.identifier + ".so", parts.library);
  for (const auto& library : carried_libraries(parts.carried))
    zip.add(folder + library.filename().string(), bytes_of(library));
  for (const auto& [name, bytes] : parts.resources) zip.add("resources/" + name, bytes);
  FmuContents contents{{}, std::string(own_licence()), parts.files};
  const auto add_licence = [&](const std::string& name, std::string_view text) {
    contents.licences.push_back("licenses/" + name + ".txt");
    zip.add("documentation/" + contents.licences.back(), text);
  };
  if (const auto own = embedded_file(licence_file); !own.empty()) add_licence("drycut", own);
  for (const auto& licence : licences_of(parts.carried))
    add_licence(licence.parent_path().filename().string(), bytes_of(licence));
  for (const std::string package : {"nlohmann-json3-dev", "libeigen3-dev"})
    if (const auto text = embedded_file(package + ".licence"); !text.empty()) add_licence(package, text);
  zip.add("documentation/index.html", documentation(standard, head, variables, contents));
  zip.finish();
  write_file(out, bytes_of(scratch.name()));

  WrittenFmu written;
  written.files = contents.files;
  written.own_licence = contents.own_licence;
  for (const auto& variable : variables) {
    if (variable.role == FmiVariable::Role::input) ++written.inputs;
    if (variable.role == FmiVariable::Role::output) ++written.outputs;
    if (variable.word != nullptr || variable.role == FmiVariable::Role::parameter ||
        variable.role == FmiVariable::Role::live_parameter)
      ++written.parameters;
  }
  return written;
}

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

// The table of units, which the system of the importer may lack.
std::vector<std::pair<std::string, std::string>> unit_tables() {
  ut_status status{};
  const fs::path table = ut_get_path_xml(nullptr, &status);
  std::vector<std::pair<std::string, std::string>> tables;
  for (const auto& file : fs::directory_iterator(table.parent_path()))
    if (file.path().extension() == ".xml")
      tables.emplace_back("udunits/" + file.path().filename().string(), bytes_of(file.path()));
  std::ranges::sort(tables);
  return tables;
}

}  // namespace

WrittenFmu write_machine(const scenario::Scenario& scenario, Standard standard, const fs::path& out) {
  const auto library = between(drycut_fmu_begin, drycut_fmu_end);
  const auto resolved = resolve(scenario, library);
  const BuiltMachine machine(resolved);
  return write_parts(
      scenario, standard,
      {library,
       "The machine of a Drycut line without its controller",
       "Inputs are taken at the beginning of a step and hold, outputs are those at its end: call "
       "your controller, set, step, in this order, and nothing is late. Parameters "
       "(parameters.), settings (set.) and faults (fault.) are in SI units, all else in the unit "
       "that is named. A fault acts when its value changes.",
       {},
       {{"machine.json", machine_text(resolved)}}},
      machine.variables(), out);
}

WrittenFmu write_line(const scenario::Scenario& scenario, const FileSet& files, Standard standard,
                      const fs::path& out) {
  const auto library = between(drycut_fmu_line_begin, drycut_fmu_line_end);
  const CarriedLine line{made_by(library), scenario.file.string(), scenario.overrides, files.files,
                         files.folders};
  const BuiltLine built(line, {});
  FmuParts parts{
      library,
      "A Drycut line with its controller",
      "The importer is its operator. Inputs are taken at the beginning of a step and hold, outputs are those "
      "at its end. A switch "
      "(panel.) is on as long as its input is; a value of the program (set.) and a fault (fault.) act "
      "when they change. Parameters of the scenario and its plants, settings of plants (set.) and "
      "faults are in SI units, all else in the unit that is named; values of the controller are as it "
      "counts them.",
      carried_with_line(),
      {{"line.cbor", line_bytes(line)}}};
  for (const auto& [name, file] : files.files)
    if (file.state == FileSet::State::present) parts.files.push_back(name);
  for (auto& table : unit_tables()) parts.resources.push_back(std::move(table));
  return write_parts(scenario, standard, parts, built.variables(), out);
}

}  // namespace drycut::sim::fmi
