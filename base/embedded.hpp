#pragma once
#include <string_view>
#include <vector>

namespace drycut {

// Files that are built into the program, so that it works wherever it is moved: the LICENSE, the meshes of
// scenes/meshes/, the motors of scenes/catalogue/, what a report is made of, in renders/assets/, and the
// lines of scenes/new/ with their programs (CMakeLists.txt).

/// Names of the files, without folders: "drum.stl", "report.css"; those of lines and motors from scenes/ on:
/// "new/cams/saw.csv", "catalogue/cantoni_sg.yaml".
std::vector<std::string_view> embedded_names();

/// The bytes of the file of that name; empty if there is none.
std::string_view embedded_file(std::string_view name);

}  // namespace drycut
