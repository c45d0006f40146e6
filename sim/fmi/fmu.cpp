#include "sim/fmi/fmu.hpp"

#include <fmt/format.h>
#include <link.h>
#include <minizip/zip.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/output_file.hpp"
#include "sim/fmi/resolve.hpp"

// The library of binary/, which the build puts into this program.
extern "C" const char drycut_fmu_begin[];
extern "C" const char drycut_fmu_end[];

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

// Libraries that the machine needs and a bare Debian has not, as this very process has them loaded, which is
// linked to them too.
std::vector<fs::path> carried_libraries() {
  std::vector<fs::path> found;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* all) {
        const fs::path file = info->dlpi_name;
        const auto name = file.filename().string();
        for (const auto* begin : {"libBulletDynamics", "libBulletCollision", "libLinearMath", "libfmt"})
          if (name.starts_with(begin)) static_cast<std::vector<fs::path>*>(all)->push_back(file);
        return 0;
      },
      &found);
  std::ranges::sort(found);
  return found;
}

// As their packages have them.
std::vector<fs::path> licences_of_carried() {
  std::vector<fs::path> found;
  std::error_code none;
  for (const auto& package : fs::directory_iterator("/usr/share/doc", none)) {
    const auto name = package.path().filename().string();
    const bool carried =
        (name.starts_with("libbullet") || name.starts_with("libfmt")) && !name.ends_with("-dev");
    if (carried && fs::exists(package.path() / "copyright", none))
      found.push_back(package.path() / "copyright");
  }
  if (found.empty())
    throw std::runtime_error(
        "the licences of the libraries that an FMU carries are not installed: "
        "/usr/share/doc/libbullet*/copyright");
  std::ranges::sort(found);
  return found;
}

// A name in C.
std::string identifier_of(const fs::path& scenario) {
  auto name = scenario.stem().string();
  for (auto& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) name.insert(0, "_");
  return name;
}

}  // namespace

WrittenFmu write_fmu(const scenario::Scenario& scenario, Standard standard, const fs::path& out) {
  const std::string_view binary(drycut_fmu_begin,
                                static_cast<std::size_t>(drycut_fmu_end - drycut_fmu_begin));
  const auto resolved = resolve(scenario, binary);
  const auto text = machine_text(resolved);
  const BuiltMachine machine(resolved);
  const auto& variables = machine.variables();
  const FmuHead head{identifier_of(scenario.file), scenario.scene.title, token_of(text),
                     seconds(resolved.step), seconds(scenario.scene.duration)};

  const ScratchFile scratch;
  ZipFile zip(scratch.name());
  zip.add("modelDescription.xml", model_description(standard, head, variables),
          0);  // who wrote it is seen so
  const std::string folder = standard == Standard::fmi2 ? "binaries/linux64/" : "binaries/x86_64-linux/";
  zip.add(folder + head.identifier + ".so", binary);
  for (const auto& library : carried_libraries())
    zip.add(folder + library.filename().string(), bytes_of(library));
  zip.add("resources/machine.json", text);
  std::vector<std::string> licences;
  for (const auto& licence : licences_of_carried()) {
    licences.push_back("licenses/" + licence.parent_path().filename().string() + ".txt");
    zip.add("documentation/" + licences.back(), bytes_of(licence));
  }
  zip.add("documentation/index.html", documentation(standard, head, variables, licences));
  zip.finish();
  write_file(out, bytes_of(scratch.name()));

  WrittenFmu written;
  for (const auto& variable : variables) {
    if (variable.role == FmiVariable::Role::input) ++written.inputs;
    if (variable.role == FmiVariable::Role::output) ++written.outputs;
    if (variable.word != nullptr || variable.role == FmiVariable::Role::parameter ||
        variable.role == FmiVariable::Role::live_parameter)
      ++written.parameters;
  }
  return written;
}

}  // namespace drycut::sim::fmi
