// pictures.meshes: a user's own meshes in place of parts. Whether parts and files are there is found out when
// the machine is built (sim/part_meshes.cpp).
#include <fmt/format.h>

#include "sim/scenario/sections.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

namespace {

PicturesSection::MeshRequest read_mesh(const YamlNode::Entry& entry, const std::string& name,
                                       Findings& findings) {
  PicturesSection::MeshRequest mesh;
  mesh.part = entry.key;
  MapReader reader(entry.value, name, findings);
  reader.text("file", mesh.file);
  if (!reader.has("file")) reader.missing("file", "name a mesh file: file: meshes/my_drum.stl");
  if (const auto* scale = reader.scalar("scale")) {
    mesh.scale = read_si(*scale, reader.full("scale"), "", findings).value_or(1);
    if (mesh.scale < 1e-6 || mesh.scale > 1e6)
      findings.add(scale->place, fmt::format("{} is {}, out of range", reader.full("scale"), scale->text),
                   "1e-6 to 1e6; 1 takes the file as it is");
  }
  read_triple(reader, "at", "mm", mesh.at, findings);
  read_triple(reader, "rotate", "deg", mesh.rotate, findings);
  reader.finish();
  return mesh;
}

}  // namespace

void read_triple(MapReader& reader, std::string_view key, std::string_view unit,
                 std::array<double, 3>& values, Findings& findings) {
  std::vector<Text> texts;
  if (!reader.has(key)) return reader.texts(key, texts);
  const auto before = findings.count();
  reader.texts(key, texts);
  if (findings.count() != before) return;
  if (texts.size() != values.size()) {
    findings.add(reader.place(key), fmt::format("{} has {} numbers", reader.full(key), texts.size()),
                 fmt::format("write three, along x, y and z: [0 {0}, 20 {0}, 0 {0}]", unit));
    return;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto name = fmt::format("{}.{}", reader.full(key), i);
    if (const auto value = read_si(texts[i], name, unit, findings)) values[i] = *value;
  }
}

std::vector<PicturesSection::MeshRequest> read_meshes(const YamlNode& node, Findings& findings) {
  const std::string name = "pictures.meshes";
  refuse_duplicates(node, name, findings);
  std::vector<PicturesSection::MeshRequest> meshes;
  for (const auto& entry : node.entries) {
    if (entry.is_repeated()) continue;
    const auto full = fmt::format("{}.{}", name, entry.key.text);
    if (entry.value.kind != YamlNode::Kind::map) {
      refuse_kind(entry.value, full, YamlNode::Kind::map, findings);
      continue;
    }
    meshes.push_back(read_mesh(entry, full, findings));
  }
  return meshes;
}

}  // namespace drycut::sim
