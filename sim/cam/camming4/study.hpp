#pragma once
#include "sim/cam/study.hpp"

namespace drycut::sim {

bool owns_camming4(std::string_view text);
bool check_camming4(std::string_view text, const std::string& file, Problems& problems);
CamStudy study_camming4(std::string_view text, const std::string& file, const CamRequest& request,
                        Problems& problems);
IdealCam ideal_camming4(std::string_view text, MasterRange range);

/// Sectors of CAMMING4 (000), run by the device's own cam engine.
inline constexpr CamKind camming4_cams = {"camming4",     "sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM",
                                          owns_camming4,  check_camming4,
                                          study_camming4, ideal_camming4};

}  // namespace drycut::sim
