#include "plants/materials.hpp"

namespace drycut::plants {

namespace {

// How long a strain lags behind its stress [s]: loss factor over the angular frequency.
constexpr double fibre = 50e-6;
constexpr double metal = 2e-6;
constexpr std::string_view fibre_loss = "estimate: loss factor of 3 % at 100 Hz";
constexpr std::string_view metal_loss = "estimate: loss factor of 0.1 % at 100 Hz";

struct MaterialValues {
  double density;  ///< [kg/m3]
  std::string_view density_from;
  double shear;  ///< [Pa]
  std::string_view shear_from;
  double elasticity;  ///< [Pa]
  std::string_view elasticity_from;
};

Preset material(std::string_view name, std::string_view meaning, const MaterialValues& of, bool is_metal) {
  return {name,
          meaning,
          {{"density", of.density, of.density_from},
           {"shear_strength", of.shear, of.shear_from},
           {"elasticity", of.elasticity, of.elasticity_from},
           {"retardation", is_metal ? metal : fibre, is_metal ? metal_loss : fibre_loss}}};
}

}  // namespace

const std::vector<Preset>& materials() {
  static const std::vector<Preset> all = {
      material("board", "solid board",
               {700, "solid board", 5e6, "estimate: solid board, blade with a slight helix", 3e9,
                "estimate: solid board along the machine"},
               false),
      material("corrugated", "corrugated board of one flute, whole height",
               {125, "estimate: 500 g/m2 of 4 mm", 0.9e6, "estimate: solid board's, by their densities",
                0.58e9, "estimate: two liners of 0.18 mm with 6.5 GPa in 4 mm; the flutes give way"},
               false),
      material("paper", "paper",
               {800, "estimate: 80 g/m2 of 0.1 mm", 5e6, "estimate: as solid board", 5e9,
                "estimate: along the machine, 4 to 8 GPa"},
               false),
      material("film", "film of polyester",
               {1390, "data sheet DuPont Mylar 92A, physical-thermal properties", 118e6,
                "estimate: 0.6 of the tensile strength 196 MPa of Mylar 92A", 4.8e9,
                "data sheet DuPont Mylar 92A: 490 kg/mm2 along the machine"},
               false),
      material("pvc", "hard PVC, pipes and profiles",
               {1400, "estimate: usual for hard PVC", 35e6, "estimate: 0.7 of a tensile strength of 50 MPa",
                3e9, "estimate: usual for hard PVC, short load"},
               false),
      material("aluminium", "soft aluminium sheet",
               {2700, "estimate: usual for its alloys", 130e6,
                "estimate: 0.65 of a tensile strength of 200 MPa", 70e9, "estimate: usual for its alloys"},
               true),
      material("steel", "structural steel S235",
               {7850, "EN 1993-1-1, design values of material", 290e6,
                "estimate: 0.8 of the tensile strength 360 MPa of S235, EN 1993-1-1 table 3.1", 210e9,
                "EN 1993-1-1, 3.2.6"},
               true),
  };
  return all;
}

}  // namespace drycut::plants
