#pragma once
#include "sim/cams/study.hpp"

namespace drycut::devices {
namespace camming4 {
struct CamSectors;
}
namespace lx3vp {
struct EcamTable;
}
namespace plcopen {
struct CamFile;
}
}  // namespace drycut::devices

// What each kind of cam has of its own: how its tables are read and written, and what its manual says of
// them.
namespace drycut::sim::cams {

using CammingTable = devices::camming4::CamSectors;
using devices::lx3vp::EcamTable;
using devices::plcopen::CamFile;

CammingTable read_camming4(std::string_view text, const std::string& file, Problems& problems);
std::vector<CamKey> camming4_keys();
std::vector<CamKey> camming4_columns();
CamStudy study_of(const CammingTable& table, const CamRequest& request, Problems& problems);
IdealCam ideal_of(const CammingTable& table, MasterRange range);
std::string file_of(CammingTable& table, const std::string& file);

EcamTable read_lx3vp(std::string_view text, const std::string& file, Problems& problems);
std::vector<CamKey> lx3vp_keys();
std::vector<CamKey> lx3vp_columns();
CamStudy study_of(const EcamTable& table, const CamRequest& request, Problems& problems);
IdealCam ideal_of(const EcamTable& table, MasterRange range);
std::string file_of(EcamTable& table, const std::string& file);

CamFile read_mc_camin(std::string_view text, const std::string& file, Problems& problems);
std::vector<CamKey> mc_camin_keys();
std::vector<CamKey> mc_camin_columns();
CamStudy study_of(const CamFile& cam, const CamRequest& request, Problems& problems);
IdealCam ideal_of(const CamFile& cam, MasterRange range);
std::string file_of(CamFile& cam, const std::string& file);

}  // namespace drycut::sim::cams
