#include "renders/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "base/output_file.hpp"
#include "base/picture_size.hpp"
#include "renders/camera.hpp"
#include "renders/caption_bar.hpp"
#include "renders/overlays.hpp"
#include "renders/picture_library.hpp"
#include "renders/solid_mesh.hpp"
#include "renders/stage.hpp"
#include "renders/tiles.hpp"

namespace drycut::renders {
namespace {

bool all_positive(const Vec3& values) { return values.allFinite() && values.minCoeff() > 0; }

void require(bool good, const std::string& otherwise) {
  if (!good) throw std::invalid_argument("pictures: " + otherwise);
}

void require_sees(const Camera& camera) {
  require(camera.eye.allFinite() && camera.target.allFinite() && camera.target != camera.eye,
          "the camera's eye and target must be two different points");
  require(camera.field_of_view_deg >= 1 && camera.field_of_view_deg <= 150,
          fmt::format("field of view {} degrees; 1 to 150 can be drawn", camera.field_of_view_deg));
}

std::string frame_name(std::size_t number) { return fmt::format("frame_{:05}.png", number); }

/// Draws the frames whose number is taken from `next`, until none is left, in contexts of its own.
void draw_frames(const Film& film, const std::vector<Stage>& stages, const Overlays& overlays,
                 const CaptionLayout& caption, const std::filesystem::path& directory,
                 std::atomic<std::size_t>& next, const std::function<void()>& drawn) {
  std::vector<DrawParts> renderers;
  for (const Stage& stage : stages) renderers.push_back(picture_library().drawer(stage));
  const std::vector<Tile> tiles = tiles_of(film);
  Image image(film.width, film.height);
  for (auto number = next++; number < film.frames.size(); number = next++) {
    const Frame& frame = film.frames[number];
    if (tiles.size() == 1) {
      renderers.front()(frame.placements, camera_of(film, number), image);
    } else {
      for (std::size_t view = 0; view < tiles.size(); ++view) {
        Image part(tiles[view].width, tiles[view].height);
        renderers[view](frame.placements, camera_of(film, number, view), part);
        paste(part, tiles[view], image);
      }
    }
    overlays.draw(number, image);
    caption.draw(frame, image);
    write_file(directory / frame_name(number), png_bytes(image));
    drawn();
  }
}

}  // namespace

void require_drawable(const Film& film) {
  require(std::min(film.width, film.height) >= smallest_picture &&
              std::max(film.width, film.height) <= largest_picture,
          fmt::format("size {}x{} cannot be drawn; width and height are {} to {} pixels", film.width,
                      film.height, smallest_picture, largest_picture));
  require(!film.follow || *film.follow < film.parts.size(), "the camera follows a part that is not there");
  require_sees(film.camera);
  for (const View& view : film.beside) require_sees(view.camera);
  require(film.beside.size() < 4, "one to four cameras share a picture");
  for (const SolidPart& part : film.parts) {
    require(all_positive(part.size), fmt::format("part '{}': sizes must be more than 0 m", part.name));
    require(find_material(part.material) != nullptr,
            fmt::format("part '{}': unknown material '{}'; known: {}", part.name, part.material,
                        material_names()));
  }
  for (std::size_t f = 0; f < film.frames.size(); ++f) {
    const Frame& frame = film.frames[f];
    require(
        frame.placements.size() == film.parts.size(),
        fmt::format("frame {}: {} placements for {} parts", f, frame.placements.size(), film.parts.size()));
    for (std::size_t i = 0; i < film.parts.size(); ++i) {
      const Placement& p = frame.placements[i];
      const bool turned = p.rotation.allFinite() && p.rotation != Vec4::Zero();
      require(!p.visible || (p.position.allFinite() && turned && all_positive(p.scale)),
              fmt::format(
                  "frame {}: part '{}' has no place that can be drawn (a number is not finite, the rotation "
                  "is 0 0 0 0 or a scale is not more than 0)",
                  f, film.parts[i].name));
    }
  }
}

std::vector<std::string> frame_names(const Film& film) {
  std::vector<std::string> names;
  for (std::size_t number = 0; number < film.frames.size(); ++number) names.push_back(frame_name(number));
  return names;
}

std::vector<std::filesystem::path> draw_film(const Film& film, const std::filesystem::path& directory,
                                             const std::function<void(int)>& progress, int threads) {
  require_drawable(film);
  std::vector<std::filesystem::path> files;
  if (film.frames.empty()) return files;
  const CaptionLayout caption(film);
  require(
      film.height - caption.height() >= smallest_picture / 4,
      fmt::format("size {}x{} leaves no room above the caption; make it higher", film.width, film.height));
  std::filesystem::create_directories(directory);
  const std::vector<Stage> stages = stages_of(film);
  const Overlays overlays(film, caption.height());

  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  int done = 0;
  std::exception_ptr trouble;
  const auto drawn = [&] {
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress(done);
  };
  const auto work = [&] {
    try {
      draw_frames(film, stages, overlays, caption, directory, next, drawn);
    } catch (...) {
      const std::lock_guard lock(mutex);
      trouble = std::current_exception();
      next = film.frames.size();
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i) helpers.emplace_back(work);
    work();
  }
  if (trouble) std::rethrow_exception(trouble);
  for (const auto& name : frame_names(film)) files.push_back(directory / name);
  return files;
}

}  // namespace drycut::renders
