#pragma once
#include "sim/cam/study.hpp"

namespace drycut::sim {

bool owns_mc_camin(std::string_view text);
bool check_mc_camin(std::string_view text, const std::string& file, Problems& problems);
CamStudy study_mc_camin(std::string_view text, const std::string& file, const CamRequest& request,
                        Problems& problems);
IdealCam ideal_mc_camin(std::string_view text, MasterRange range);

/// Cam tables of the ISG kernel's MC_CamIn (004): its .tab files, or CSV.
inline constexpr CamKind mc_camin_cams = {
    "mc_camin",
    "slave (or a0,a1,a2,a3, or master,slave below # interpolation: POLY5_LINE; or a .tab file)",
    owns_mc_camin,
    check_mc_camin,
    study_mc_camin,
    ideal_mc_camin};

}  // namespace drycut::sim
