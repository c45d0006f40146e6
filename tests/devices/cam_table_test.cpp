// A cam table as it goes from a device to whoever looks at it: devices/cam knows none of its kinds.
#include <gtest/gtest.h>

#include <any>
#include <string_view>
#include <tuple>

#include "base/state_archive.hpp"
#include "devices/cam/table.hpp"
#include "devices/lx3vp/ecam_table.hpp"

namespace drycut::devices {
namespace {

/// A kind that no device has.
struct PaperCam {
  static constexpr std::string_view kind = "paper";
  int teeth = 0;
  bool operator==(const PaperCam&) const = default;
  void visit(StateArchive& archive) { STATE(archive, teeth); }
};

TEST(CamTable, HoldsAKindThatNobodyKnows) {
  CamTable table = PaperCam{12};
  EXPECT_EQ(table.kind(), "paper");
  EXPECT_EQ(table.as<PaperCam>().teeth, 12);
  table.as<PaperCam>().teeth = 13;
  EXPECT_EQ(table.as<PaperCam>().teeth, 13);
  EXPECT_THROW(std::ignore = table.as<lx3vp::EcamTable>(), std::bad_any_cast);
}

TEST(CamTable, IsEqualByKindAndContent) {
  EXPECT_EQ(CamTable(PaperCam{12}), CamTable(PaperCam{12}));
  EXPECT_NE(CamTable(PaperCam{12}), CamTable(PaperCam{13}));
  EXPECT_NE(CamTable(PaperCam{12}), CamTable(lx3vp::EcamTable{}));
  EXPECT_NE(CamTable(PaperCam{12}), CamTable());
  EXPECT_EQ(CamTable(), CamTable());
}

}  // namespace
}  // namespace drycut::devices
