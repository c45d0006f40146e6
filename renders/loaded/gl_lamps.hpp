#pragma once
#include "renders/lamp.hpp"
#include "renders/loaded/gl_parts.hpp"

namespace drycut::renders {

/// The two lamps of the hall, the key light and the sky, each with a map of what it sees: the key's map tells
/// what is in shadow, the sky's, which holds heights and is blurred, what is under or close to something.
class GlLamps {
 public:
  using Name = unsigned int;  ///< of a GL object

  explicit GlLamps(const Stage& stage);

  /// The maps as they are without the moving parts.
  void draw_still(const GlParts& parts, const std::vector<Placement>& placements);
  /// The maps of a frame, with the corners of its moving parts.
  void draw_frame(const GlParts& parts, const std::vector<Placement>& placements,
                  const std::vector<std::array<Vec3, 8>>& moving);

  /// What a program that uses shaders::kLamps wants to know, but for the maps.
  void tell(const GlProgram& program) const;
  Name key_map() const { return key_map_.depth(); }
  Name sky_map() const { return sky_means_.colour(0); }

  /// Where parts with these corners change the light on the floor.
  std::vector<Patch> shade_on_floor(const std::vector<std::array<Vec3, 8>>& parts) const;

 private:
  void draw_into_key(const GlParts& parts, const std::vector<std::size_t>& which,
                     const std::vector<Placement>& placements) const;
  void draw_into_sky(const GlParts& parts, const std::vector<std::size_t>& which,
                     const std::vector<Placement>& placements) const;
  void blur_sky() const;

  const Stage& stage_;
  Lamp key_, sky_;
  Vec3 centre_;
  double reach_;  ///< of the maps from the centre [m]
  GlProgram depth_program_, height_program_, means_program_;
  GlCanvas key_map_, sky_map_, sky_means_;
  Name empty_array_ = 0;
};

}  // namespace drycut::renders
