#include <LinearMath/btScalar.h>
#include <cairo.h>
#include <fmt/format.h>
#include <Eigen/Core>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>
#include <nlopt.hpp>

#include "renders/picture_library.hpp"
#include "sim/cli/help.hpp"
#include "sim/record/hdf5_file.hpp"

namespace drycut::sim::cli {

std::string version_text() {
  const int bullet = btGetVersion();
  constexpr int hundred = 100;
  return fmt::format(
      "drycut {}\ncommit {}\ncompiler {}\nBullet {}.{} ({}), Eigen {}.{}.{}, assimp {}, cairo {}, HDF5 {}\n"
      "NLopt {}.{}.{}, CLI11 {}, fmt {}.{}.{}, nlohmann-json {}.{}.{}, Boost {}.{}",
      DRYCUT_VERSION, DRYCUT_COMMIT, DRYCUT_COMPILER, bullet / hundred, bullet % hundred,
      sizeof(btScalar) == sizeof(double) ? "float64" : "float32", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
      EIGEN_MINOR_VERSION, renders::picture_library().assimp_version(), cairo_version_string(),
      record::hdf5_version(), nlopt::version_major(), nlopt::version_minor(), nlopt::version_bugfix(),
      CLI11_VERSION, FMT_VERSION / 10000, FMT_VERSION / 100 % hundred, FMT_VERSION % hundred,
      NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH,
      BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000);
}

}  // namespace drycut::sim::cli
