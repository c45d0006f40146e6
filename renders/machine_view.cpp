#include "renders/machine_view.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "base/embedded.hpp"
#include "base/json.hpp"
#include "renders/gltf.hpp"
#include "renders/gltf_track.hpp"
#include "renders/html.hpp"
#include "renders/png_image.hpp"

namespace drycut::renders {
namespace {

/// In zlib's format, which browsers take as "deflate".
std::string deflated(const std::string& bytes) {
  auto size = compressBound(static_cast<uLong>(bytes.size()));
  std::string small(size, '\0');
  const auto* source = reinterpret_cast<const Bytef*>(bytes.data());
  if (compress2(reinterpret_cast<Bytef*>(small.data()), &size, source, static_cast<uLong>(bytes.size()),
                Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("no memory to compress with");
  small.resize(size);
  return small;
}

/// Whole numbers of `unit`, each as its difference from the one before it in the same column.
template <std::size_t columns, typename Numbers>
Json steps(const Track& track, double unit, const Numbers& numbers) {
  auto list = Json::array();
  std::array<std::int64_t, columns> last{};
  bool moves = false;
  for (std::size_t row = 0; row < track.size(); ++row) {
    const auto now = numbers(track[row]);
    for (std::size_t i = 0; i < columns; ++i) {
      const auto whole = static_cast<std::int64_t>(std::llround(now[static_cast<Eigen::Index>(i)] / unit));
      list.push_back(whole - last[i]);
      moves = moves || (row > 0 && whole != last[i]);
      last[i] = whole;
    }
  }
  if (!moves) list.erase(list.begin() + columns, list.end());  // once is enough
  return list;
}

// As report_view.js reads them.
constexpr double time_unit = 1e-6;   // [s]
constexpr double place_unit = 1e-5;  // [m]
constexpr double turn_unit = 1e-5;   // of a quaternion's numbers
constexpr double scale_unit = 1e-5;

Json track_json(const Track& track) {
  using Time = Eigen::Matrix<double, 1, 1>;
  return {{"times", steps<1>(track, time_unit, [](const TrackKey& key) { return Time(key.time_s); })},
          {"places", steps<3>(track, place_unit, [](const TrackKey& key) { return key.placement.position; })},
          {"turns", steps<4>(track, turn_unit, [](const TrackKey& key) { return key.placement.rotation; })},
          {"scales", steps<3>(track, scale_unit, [](const TrackKey& key) { return key.placement.scale; })}};
}

std::string motion(const MachineView& view) {
  auto tracks = Json::array();
  for (const auto& track : view.tracks) tracks.push_back(track_json(track));
  const Json all = {
      {"parts", view.parts}, {"from", view.from_s}, {"until", view.until_s}, {"tracks", std::move(tracks)}};
  return json_text(all);
}

std::string packed(const char* id, const std::string& bytes) {
  return fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>\n", id,
                     base64(deflated(bytes)));
}

/// Ends all tracks where there are too many keys; returns when that is.
double shortened(std::vector<Track>& tracks, double until_s, std::size_t most_keys) {
  std::vector<double> times;
  for (const auto& track : tracks)
    for (const auto& key : track) times.push_back(key.time_s);
  if (times.size() <= most_keys) return until_s;
  const auto last = times.begin() + static_cast<std::ptrdiff_t>(most_keys);
  std::nth_element(times.begin(), last, times.end());
  const double end_s = *last;
  for (auto& track : tracks) {
    const auto behind =
        std::find_if(track.begin() + 1, track.end(), [&](const TrackKey& key) { return key.time_s > end_s; });
    track.erase(behind, track.end());
  }
  return end_s;
}

std::string remark(const std::string& text) {
  return fmt::format("<p class=\"remark\">{}</p>\n", html_text(text));
}

}  // namespace

MachineView machine_view(const Film& film, std::size_t most_keys) {
  MachineView view;
  view.machine = gltf_of_parts(film);
  view.from_s = film.frames.front().time_s;
  view.until_s = view.recorded_until_s = film.frames.back().time_s;
  for (std::size_t part = 0; part < film.parts.size(); ++part) {
    view.parts.push_back(film.parts[part].name);
    auto& track = view.tracks.emplace_back(thinned(track_of(film, part, 1)));
    for (auto& key : track) key.time_s += view.from_s;
  }
  view.until_s = shortened(view.tracks, view.until_s, most_keys);
  return view;
}

std::string view_figure(const MachineView& view) {
  std::string caption = fmt::format("The machine from {:.3f} s to {:.3f} s", view.from_s, view.until_s);
  if (view.until_s < view.recorded_until_s)
    caption += fmt::format("; up to {:.3f} s it would make this report too heavy", view.recorded_until_s);
  return fmt::format("<figure class=\"machine\" id=\"machine\" hidden><figcaption>{}</figcaption></figure>\n",
                     html_text(caption));
}

std::string live_view(const MachineView& view, const std::string& folder, std::size_t most_bytes) {
  std::string library;
  for (const auto* name :
       {"three.min.js", "examples/js/loaders/GLTFLoader.js", "examples/js/controls/OrbitControls.js"}) {
    const auto file = std::filesystem::path(folder) / name;
    if (!std::filesystem::is_regular_file(file))
      return remark("The machine cannot be turned in 3-D: that needs libjs-three, which was not installed.");
    library += read_file(file) + "\n";
  }
  auto page = packed("view-machine", view.machine) + packed("view-motion", motion(view)) +
              packed("view-library", library);
  if (page.size() > most_bytes)
    return remark(fmt::format("The machine cannot be turned in 3-D: that would add {} MB to this report.",
                              page.size() >> 20U));
  for (const auto* name : {"view_backdrop.js", "view_look.js", "view_still.js", "view.js", "report_view.js"})
    page += fmt::format("<script>{}</script>\n", embedded_file(name));
  return page;
}

}  // namespace drycut::renders
