#pragma once
#include "sim/cam/study.hpp"

namespace drycut::sim {

bool owns_lx3vp(std::string_view text);
bool check_lx3vp(std::string_view text, const std::string& file, Problems& problems);
CamStudy study_lx3vp(std::string_view text, const std::string& file, const CamRequest& request,
                     Problems& problems);
IdealCam ideal_lx3vp(std::string_view text, MasterRange range);

/// Tables of the LX3VP's electronic cam (003), given or made by its own ECAMTBX.
inline constexpr CamKind lx3vp_cams = {"lx3vp",     "master,slave (or # ecamtbx: K100 and parameter,value)",
                                       owns_lx3vp,  check_lx3vp,
                                       study_lx3vp, ideal_lx3vp};

}  // namespace drycut::sim
