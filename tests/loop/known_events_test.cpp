// How bad an event is stands with the event, and nowhere else.
#include "sim/loop/known_events.hpp"

#include <gmock/gmock.h>

#include "plants/plant.hpp"
#include "sim/scenario/specimens.hpp"

namespace drycut::sim::loop {
namespace {

TEST(KnownEvents, AFileThatDoesNotSayHowBadAnEventIsIsReadAsItsPlantHasIt) {
  EXPECT_EQ(severity_of("cut"), Severity::note);
  EXPECT_EQ(severity_of("saturated"), Severity::warning);
  EXPECT_EQ(severity_of("tear"), Severity::error);
  EXPECT_EQ(severity_of("pulled_out"), Severity::error) << "of a drive that is not the default one";
  EXPECT_EQ(severity_of("crash"), Severity::damage);
  EXPECT_EQ(severity_of("errorstop"), Severity::error);
  EXPECT_EQ(severity_of("of_another_program"), Severity::note);
}

// Else a file could not tell which of them is meant.
TEST(KnownEvents, OneNameIsAsBadEverywhere) {
  for (const auto& event : events_of_every_run()) EXPECT_EQ(severity_of(event.name), event.severity);
  for (const auto& type : plants::plant_types())
    for (const auto& specimen : scenario::specimens_of(type))
      for (const auto& kind : specimen->plant().event_types())
        EXPECT_EQ(severity_of(std::string(kind.name)), kind.severity) << type.name << "." << kind.name;
}

TEST(KnownEvents, WhatAControllerTellsIsInTheTable) {
  EXPECT_EQ(severity_of_every_run("held_up"), Severity::warning);
  EXPECT_THROW(severity_of_every_run("odd"), std::logic_error);
  EXPECT_TRUE(is_of_program("overrun"));
  EXPECT_FALSE(is_of_program("refused"));
}

}  // namespace
}  // namespace drycut::sim::loop
