#include "sim/live/site.hpp"

#include <fstream>
#include <sstream>

#include "base/embedded.hpp"
#include "renders/palette.hpp"

namespace drycut::sim::live {

namespace {

const char* type_of(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  return "text/javascript; charset=utf-8";
}

}  // namespace

Site::Site(const std::filesystem::path& three) {
  three_.emplace("/palette.css", renders::palette_css());
  for (const auto* file :
       {"three.min.js", "examples/js/loaders/GLTFLoader.js", "examples/js/controls/OrbitControls.js"}) {
    std::ostringstream bytes;
    if (const std::ifstream stream(three / file, std::ios::binary); stream) bytes << stream.rdbuf();
    three_.emplace("/" + std::filesystem::path(file).filename().string(), bytes.str());
  }
}

std::optional<Site::File> Site::find(std::string_view path) const {
  if (path == "/") path = "/live.html";
  if (const auto found = three_.find(path); found != three_.end()) return File{type_of(path), found->second};
  if (!path.starts_with("/live") && !path.starts_with("/view")) return {};
  const auto bytes = embedded_file(path.substr(1));
  if (bytes.empty()) return {};
  return File{type_of(path), bytes};
}

}  // namespace drycut::sim::live
