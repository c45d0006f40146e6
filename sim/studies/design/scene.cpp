// A scenario that plays a designed table: what the program of a controller would have to write is there
// before power-up.
#include "sim/studies/design/scene_reading.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "base/text.hpp"
#include "devices/camming4/cam_table.hpp"
#include "devices/lx3vp/ecam_table.hpp"
#include "devices/lx3vp/registers.hpp"
#include "sim/cams/study.hpp"
#include "sim/record/own_file.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim::studies {

namespace {

namespace fs = std::filesystem;
namespace word = devices::lx3vp::word;

class SceneMaker {
 public:
  SceneMaker(const DesignSheet& sheet, const scenario::Scenario& scene, fs::path table, Problems& problems)
      : sheet_(sheet), scene_(scene), table_(std::move(table)), problems_(problems) {
    made_.file = fs::path(table_).replace_extension(".yaml");
  }

  std::optional<CamScene> make() {
    const auto before = problems_.size();
    if (const auto* qmove = section<controllers::QmoveSection>("camming4"))
      take(sheet_.device->table.as<devices::camming4::CamSectors>(), *qmove);
    else if (const auto* lx3vp = section<controllers::Lx3vpSection>("lx3vp"))
      take(sheet_.device->table.as<devices::lx3vp::EcamTable>(), *lx3vp);
    else if (const auto* plcopen = section<controllers::PlcopenSection>("mc_camin"))
      take(*plcopen);
    if (problems_.size() != before) return {};
    made_.scenario = text();
    return made_;
  }

 private:
  template <typename Section>
  const Section* section(const char* device) const {
    return sheet_.device_name == device ? controllers::controller_of<Section>(scene_) : nullptr;
  }
  void refuse(Code code, std::string what, std::string remedy) {
    problems_.push_back({code, "--scene", 1, 1, std::move(what), std::move(remedy)});
  }
  std::string content(const scenario::Text& file) { return content_of(file, scene_, problems_); }

  /// Where the job's speed goes: a variable, or the web that nothing else sets; "" = the scene has its own.
  [[nodiscard]] std::string speed_path() const {
    for (const auto& variable : scene_.variables)
      if (variable.name.text == "speed") return "variables";
    for (const auto& plant : scene_.plants) {
      if (plant.type.text != "web") continue;
      const auto setting = plant.name.text + ".speed";
      const auto sets = [&](const auto& actions) {
        return std::any_of(actions.begin(), actions.end(),
                           [&](const auto& action) { return action.first.text == setting; });
      };
      const bool set = std::any_of(scene_.timeline.begin(), scene_.timeline.end(),
                                   [&](const auto& entry) { return sets(entry.set) || sets(entry.ramp); });
      return set ? "" : plant.name.text;
    }
    return "";
  }

  void take(const devices::camming4::CamSectors& cam, const controllers::QmoveSection& section) {
    const auto configuration = content(section.configuration);
    const auto axes = found_in(configuration, R"(^\s*(\w+)\s+CAMMING4\b)");
    if (axes.size() != 1)
      return refuse("design.scene"_code,
                    fmt::format("its configuration has {} axes with CAMMING4", axes.size()),
                    "name a scene with one");
    if (found_in(configuration, R"(^\s*(slZone)\s+L\b)").empty())
      return refuse("design.scene"_code,
                    "its program takes no cam: there is no slZone to tell it that one is given",
                    "give it one, as in scenes/programs/rotary_knife.mod");
    const auto& axis = axes.front();
    std::vector<std::string> values;
    int zone = 1;
    for (int i = 1; i <= devices::camming4::cam_rows; ++i) {
      if (!cam.has(i)) continue;
      const auto& row = cam.sector(i).row;
      if (row.codeM != 0) zone = i;
      values.push_back(
          fmt::format("{0}.codeG{1}: {2}, {0}.codeQm{1}: {3}, {0}.codeQs{1}: {4}, {0}.codeM{1}: "
                      "{5}",
                      axis, i, row.codeG, row.codeQm, row.codeQs, row.codeM));
    }
    controller_ = fmt::format("qmove:\n    set:\n      {{slZone: {},\n       {}}}", zone,
                              fmt::join(values, ",\n       "));
    // The synchronous row and the first of the way back: no other cam has both.
    check_ = fmt::format("{}.decpt == {}", axis, cam.settings.decpt);
    for (const int i : {zone, zone + 1}) {
      const auto& row = cam.sector(i).row;
      check_ +=
          fmt::format(" && {0}.codeQm{1} == {2} && {0}.codeQs{1} == {3}", axis, i, row.codeQm, row.codeQs);
    }
  }

  void take(const devices::lx3vp::EcamTable& cam, const controllers::Lx3vpSection& section) {
    const auto program = content(section.program);
    const auto blocks = found_in(program, R"(^\s*DECAM\s+\S+\s+D(\d+)\b)");
    if (blocks.size() != 1)
      return refuse("design.scene"_code, fmt::format("its program has {} DECAM", blocks.size()),
                    "name a scene with one");
    const int block = std::stoi(blocks.front());
    const auto rows = static_cast<int>(cam.rows.size());
    if (block + word::table + devices::lx3vp::row_words * rows - 1 > devices::lx3vp::last_block_word)
      return refuse("design.scene"_code,
                    fmt::format("{} rows behind D{} reach into the special registers", rows, block),
                    "let the block begin lower");
    made_.registers_file = table_.parent_path() / (table_.stem().string() + "_registers.csv");
    auto& text = made_.registers;
    const auto line = [&](int offset, const char* kind, auto value, const char* meaning) {
      text += fmt::format("D{}{},{} ; {}\n", block + offset, kind, value, meaning);
    };
    text = fmt::format("# {} design: the block of DECAM at D{} with the cam of {}.\naddress,value\n",
                       record::own_mark, block, table_.filename().string());
    if (!section.registers.text.empty())
      text += controllers::read_named_table(section.registers, scene_, problems_).value_or("") + '\n';
    const auto answers = found_in(program, fmt::format(R"(^\s*ECAMTBX\s+\S+\s+\S+\s+D{}\s+D(\d+)\b)", block));
    if (!answers.empty())
      text += fmt::format("D{}:L,{} ; rows, where ECAMTBX would answer\n", answers.front(), rows);
    line(word::sync_low, ":L", static_cast<long>(sheet_.device->sync_begin), "synchronous from here");
    line(word::sync_high, ":L", static_cast<long>(sheet_.device->sync_end), "to here");
    line(word::rows, "", rows, "rows");
    line(word::table_offset, "", word::table, "where the first one is");
    for (int i = 0; i < rows; ++i) {
      const auto& row = cam.rows[static_cast<std::size_t>(i)];
      const int offset = word::table + i * devices::lx3vp::row_words;
      line(offset, ":L", row.master, "master");
      line(offset + 2, ":L", row.slave, "slave");
    }
    controller_ = fmt::format("lx3vp: {{registers: {}}}",
                              scenario::yaml_text(made_.registers_file.filename().string()));
    const int middle = rows / 2;
    const auto& row = cam.rows[static_cast<std::size_t>(middle)];
    const int offset = block + word::table + middle * devices::lx3vp::row_words;
    check_ = fmt::format("D{} == {} && DD{} == {} && DD{} == {}", block + word::rows, rows, offset,
                         row.master, offset + 2, row.slave);
  }

  void take(const controllers::PlcopenSection& section) {
    if (section.tables.size() != 1)
      return refuse("design.scene"_code, fmt::format("it has {} cam tables", section.tables.size()),
                    "name a scene with one");
    const auto& old = section.tables.front();
    std::string program;
    for (const auto& file : section.program_files) program += content(file) + '\n';
    if (!found_in(program, R"(\b(File)\s*:=)").empty())
      return refuse("design.scene"_code, "its program asks for its table by the name of the file",
                    "let it ask by ID");
    const auto present = present_table(scene_, problems_);
    if (!present) return;
    const auto table = fmt::format("{{file: {}, id: {}}}", scenario::yaml_text(table_.filename().string()),
                                   old.id == 0 ? present->table.id : old.id);
    std::vector<std::string> set;
    if (!found_in(program, R"((\bzoneBegins\b))").empty())
      set = {fmt::format("zoneBegins: {:.0f}", sheet_.device->sync_begin),
             fmt::format("zoneEnds: {:.0f}", sheet_.device->sync_end)};
    // What stretches the scene's table to another length must not stretch one that is made for it.
    for (const auto& scaling : found_in(program, R"(\b(?:Master|Slave)Scaling\s*:=\s*([A-Za-z_]\w*))"))
      for (const auto& [name, value] : section.set)
        if (lower(name.text) == lower(scaling)) set.push_back(name.text + ": 1");
    controller_ = fmt::format("plcopen: {{tables: [{}]{}}}", table,
                              set.empty() ? "" : fmt::format(", set: {{{}}}", fmt::join(set, ", ")));
  }

  [[nodiscard]] std::string text() const {
    const auto folder = fs::absolute(table_).lexically_normal().parent_path();
    const auto scene = fs::absolute(scene_.file).lexically_normal().lexically_relative(folder);
    auto text = fmt::format("# {} design: the cam of {} in {}, {}.\nextends: {}\n", record::own_mark,
                            table_.filename().string(), scene_.file.filename().string(), sheet_.device_name,
                            scenario::yaml_text(scene.string()));
    const auto has_length = std::any_of(scene_.variables.begin(), scene_.variables.end(),
                                        [](const auto& variable) { return variable.name.text == "length"; });
    std::vector<std::string> variables;
    if (has_length) variables.push_back("length: " + length_text(sheet_.cam.job.length));
    const auto& speed = sheet_.cam.job.speed;
    const auto path = speed ? speed_path() : "";
    const auto its_speed = speed ? fmt::format("speed: {:.9g} m/min", *speed * 60) : "";
    if (path == "variables") variables.push_back(its_speed);
    if (!variables.empty()) text += fmt::format("variables: {{{}}}\n", fmt::join(variables, ", "));
    if (!path.empty() && path != "variables")
      text += fmt::format("plants: {{{}: {{{}}}}}\n", path, its_speed);
    if (speed && path.empty()) text += "# The scene sets the speed of its web itself, not the job.\n";
    text += fmt::format("controller:\n  {}\n", controller_);
    if (!check_.empty())
      text += scene_.checks.empty()
                  ? fmt::format("checks:\n  - {{name: plays the designed cam, always: \"{}\", from: 3 s}}\n",
                                check_)
                  : fmt::format("checks:\n  plays the designed cam: {{always: \"{}\", from: 3 s}}\n", check_);
    return text;
  }

  const DesignSheet& sheet_;
  const scenario::Scenario& scene_;
  fs::path table_;
  Problems& problems_;
  CamScene made_;
  std::string controller_;
  std::string check_;  ///< that the controller has the table
};

}  // namespace

std::vector<std::string> found_in(const std::string& text, const std::string& pattern, std::size_t group) {
  const std::regex regex(pattern, std::regex::ECMAScript | std::regex::multiline);
  std::vector<std::string> all;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), regex); match != std::sregex_iterator();
       ++match)
    all.push_back((*match)[group]);
  return all;
}

std::string content_of(const scenario::Text& file, const scenario::Scenario& scene, Problems& problems) {
  return controllers::read_named(file, scene, problems).value_or("");
}

std::optional<devices::plcopen::CamFile> present_table(const scenario::Scenario& scene, Problems& problems) {
  const auto* section = controllers::controller_of<controllers::PlcopenSection>(scene);
  if (section == nullptr || section->tables.size() != 1) return {};
  const auto before = problems.size();
  const auto& file = section->tables.front().file;
  const auto text = controllers::read_named_table(file, scene, problems);
  if (!text) return {};
  const auto table =
      cams::read_cam("mc_camin", *text, (scene.file.parent_path() / file.text).string(), problems);
  if (problems.size() != before) return {};
  return table.as<devices::plcopen::CamFile>();
}

std::optional<CamScene> cam_scene(const DesignSheet& sheet, const scenario::Scenario& scene,
                                  const fs::path& table, Problems& problems) {
  return SceneMaker(sheet, scene, table, problems).make();
}

}  // namespace drycut::sim::studies
