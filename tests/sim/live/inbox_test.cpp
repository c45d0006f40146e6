// Who may leave how much with a line, and who is served next.
#include "sim/live/inbox.hpp"

#include <gmock/gmock.h>

namespace drycut::sim::live {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct LiveInbox : testing::Test {
  bool act(Asker asker, std::size_t bytes = 10) { return inbox.put({asker, Act{"{}"}, bytes}); }
  /// Who asked, in the order in which they are served.
  std::vector<Asker> served(std::size_t most = 10'000) {
    std::vector<Asker> askers;
    while (askers.size() < most)
      if (const auto request = inbox.take())
        askers.push_back(request->asker);
      else
        break;
    return askers;
  }
  Inbox inbox;
};

TEST_F(LiveInbox, ServesClientsByTurnsAndEachInItsOrder) {
  for (int i = 0; i < 3; ++i) act(1);
  inbox.put({2, Go{true}});
  inbox.put({2, Go{false}});
  act(3);
  EXPECT_THAT(served(2), ElementsAre(1, 2));
  EXPECT_FALSE(inbox.take()->asker == 1) << "3 has not had its turn";
  EXPECT_EQ(inbox.take()->asker, 1U);
  const auto last_of_2 = inbox.take();
  EXPECT_EQ(last_of_2->asker, 2U);
  EXPECT_FALSE(std::get<Go>(last_of_2->what).on);
  EXPECT_THAT(served(), ElementsAre(1));
  EXPECT_FALSE(inbox.has_mail());
}

TEST_F(LiveInbox, AnEmergencyStopWaitsForOneRequestOfEachOther) {
  for (Asker flood = 1; flood <= 4; ++flood)
    while (act(flood)) {
    }
  ASSERT_TRUE(act(99));
  EXPECT_THAT(served(5), ElementsAre(1, 2, 3, 4, 99));
}

TEST_F(LiveInbox, HasRoomForSixtyFourOfAClient) {
  for (std::size_t i = 0; i < Inbox::most_of_one; ++i) EXPECT_TRUE(act(1));
  EXPECT_FALSE(act(1));
  EXPECT_TRUE(act(2)) << "another one";
  inbox.take();
  EXPECT_TRUE(act(1));
  EXPECT_FALSE(act(1));
}

TEST_F(LiveInbox, HasRoomForAMegabyteOfAClient) {
  const auto half = Inbox::most_bytes_of_one / 2;
  EXPECT_TRUE(act(1, half));
  EXPECT_TRUE(act(1, half));
  EXPECT_FALSE(act(1, 1));
  inbox.take();
  EXPECT_FALSE(act(1, half + 1));
  EXPECT_TRUE(act(1, half));
}

TEST_F(LiveInbox, HasRoomForSoManyOfAllAndOneOfEachMore) {
  const auto clients = Inbox::most_of_all / Inbox::most_of_one;
  for (Asker client = 1; client <= clients; ++client)
    for (std::size_t i = 0; i < Inbox::most_of_one; ++i) ASSERT_TRUE(act(client));
  EXPECT_TRUE(act(100));
  EXPECT_FALSE(act(100));
  EXPECT_TRUE(act(101));
  EXPECT_EQ(served().size(), Inbox::most_of_all + 2);
  EXPECT_TRUE(act(100));
}

TEST_F(LiveInbox, WhoGoesIsHeardHoweverFullItIs) {
  while (act(1)) {
  }
  EXPECT_TRUE(inbox.put({1, Leave{}}));
  EXPECT_TRUE(inbox.put({0, Visit{}}));
  EXPECT_EQ(served().size(), Inbox::most_of_one + 2);
}

TEST_F(LiveInbox, StopGoesBeforeAllThatWaits) {
  for (Asker client = 1; client <= 10; ++client) act(client);
  inbox.stop();
  EXPECT_TRUE(inbox.has_mail());
  EXPECT_THAT(served(), IsEmpty());
  EXPECT_TRUE(inbox.stopped());
}

TEST_F(LiveInbox, OneRestartDoesForAllThatAreNext) {
  const auto restart = [&](Asker asker) { inbox.put({asker, Restart{}}); };
  for (int i = 0; i < 5; ++i) restart(1);
  act(1);
  restart(1);
  act(2);
  restart(2);
  restart(3);
  EXPECT_TRUE(std::holds_alternative<Restart>(inbox.take()->what));
  EXPECT_THAT(inbox.take_restarts(), ElementsAre(1, 1, 1, 1, 3));
  // What stands before a restart is done before it.
  EXPECT_THAT(served(), ElementsAre(2, 1, 2, 1));
}

}  // namespace
}  // namespace drycut::sim::live
