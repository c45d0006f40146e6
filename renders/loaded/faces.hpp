#pragma once
#include "renders/picture_library.hpp"

// What the library shows, function by function (PictureLibrary).
namespace drycut::renders {

MeshRead corners_of_file(const std::filesystem::path& file, double unit, const MeshPlacing& placing);
MeshRead corners_of_stl(std::string_view bytes, double unit);
std::string glb(const Film& film, int slow);

}  // namespace drycut::renders
