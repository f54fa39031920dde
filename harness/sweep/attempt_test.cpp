#include "sweep/attempt.h"

#include <sys/wait.h>

#include "sweep/sweep_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class AttemptTest : public SweepTest {
 protected:
  void SetUp() override {
    SweepTest::SetUp();
    fs::create_directories(root_);
  }
  std::optional<AttemptLock> take(double silent_s = kSilent_s) {
    return AttemptLock::take(root_, &holder_, silent_s);
  }
  // A process that takes the shard and ends without a word.
  void take_and_die() {
    const pid_t pid = ::fork();
    if (pid == 0) {
      take();
      ::_exit(0);
    }
    ::waitpid(pid, nullptr, 0);
  }
  // So many processes at once; how many of them have taken the shard while all of them live.
  size_t race(size_t count) {
    int start[2], told[2], home[2];
    if (::pipe(start) != 0 || ::pipe(told) != 0 || ::pipe(home) != 0) return 0;
    std::vector<pid_t> pids;
    for (size_t i = 0; i < count; ++i) {
      const pid_t pid = ::fork();
      if (pid == 0) {
        ::close(start[1]);
        ::close(home[1]);
        char byte = 0;
        [[maybe_unused]] ssize_t n = ::read(start[0], &byte, 1);  // until the start is closed
        byte = take() ? 'T' : 'H';
        n = ::write(told[1], &byte, 1);
        n = ::read(home[0], &byte, 1);
        ::_exit(0);
      }
      pids.push_back(pid);
    }
    ::close(start[1]);
    size_t taken = 0;
    for (size_t i = 0; i < count; ++i) {
      char byte = 0;
      if (::read(told[0], &byte, 1) == 1) taken += byte == 'T';
    }
    ::close(home[1]);
    for (const pid_t pid : pids) ::waitpid(pid, nullptr, 0);
    for (const int end : {start[0], told[0], told[1], home[0]}) ::close(end);
    return taken;
  }
  Attempt holder_;
};

// Each round ends with the death of its holder, which the next one's processes all find.
TEST_F(AttemptTest, OneOfManyTasksTakesAShard) {
  for (size_t round = 1; round <= 20; ++round) {
    ASSERT_EQ(race(12), 1u) << round;
    ASSERT_EQ(attempts_in(root_).size(), round);
  }
}

TEST_F(AttemptTest, TheHolderIsNamed) {
  const auto lock = take();
  ASSERT_TRUE(lock);
  EXPECT_EQ(lock->number(), 1u);
  EXPECT_FALSE(take());
  EXPECT_EQ(holder_.number, 1u);
  EXPECT_EQ(holder_.owner.pid, ::getpid());
  EXPECT_TRUE(holds(holder_.told(), "attempt 1 on " + this_process().host + ", since 20"));
}

TEST_F(AttemptTest, AProcessOfThisMachineThatIsGoneIsDeadAtOnce) {
  take_and_die();
  const std::vector<Attempt> attempts = attempts_in(root_);
  ASSERT_EQ(attempts.size(), 1u);
  EXPECT_TRUE(attempts[0].failed());
  EXPECT_TRUE(attempts[0].certain);
  EXPECT_TRUE(holds(attempts[0].told(), "its process is gone, and wrote no end"));
  const auto lock = take();
  ASSERT_TRUE(lock);
  EXPECT_EQ(lock->number(), 2u);
}

TEST_F(AttemptTest, AnotherProcessOfTheSameNumberIsNotTheHolder) {
  take_and_die();
  Json lock = Json::parse(read_text(root_ / "attempt-1.lock"));
  lock["pid"] = ::getpid();  // which has begun at another time
  write_text(root_ / "attempt-1.lock", lock.dump());
  EXPECT_TRUE(attempts_in(root_)[0].failed());
}

TEST_F(AttemptTest, OnAnotherMachineSilenceIsDeath) {
  const MadeSweep sweep(root_ / "sweep", made_shards("cornell", 1, 1));
  const fs::path folder = sweep.folder.attempts(0);
  sweep.attempt_elsewhere(0, 1, 20);
  EXPECT_TRUE(attempts_in(folder).at(0).alive);
  EXPECT_FALSE(AttemptLock::take(folder, &holder_));
  EXPECT_EQ(holder_.owner.host, "far");
  sweep.attempt_elsewhere(0, 1, kSilent_s + 5);
  const Attempt dead = attempts_in(folder).at(0);
  EXPECT_TRUE(dead.failed());
  EXPECT_FALSE(dead.certain);
  EXPECT_TRUE(holds(dead.told(), "attempt 1 on n9: no sign of life for 1 min 5 s"));
  const auto lock = AttemptLock::take(folder, &holder_);
  ASSERT_TRUE(lock);
  EXPECT_EQ(lock->number(), 2u);
}

TEST_F(AttemptTest, ATouchIsASignOfLife) {
  const auto lock = take();
  ASSERT_TRUE(lock);
  const fs::path file = root_ / "attempt-1.lock";
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::seconds(100));
  EXPECT_GT(attempts_in(root_)[0].silent_s, 99);
  lock->beat();
  EXPECT_LT(attempts_in(root_)[0].silent_s, 10);
}

TEST_F(AttemptTest, AnEndIsTheEndWhateverTheClock) {
  const auto lock = take();
  ASSERT_TRUE(lock);
  lock->end({"2024-05-01T12:00:00Z", 3, false, "the device was lost"});
  const Attempt ended = attempts_in(root_).at(0);
  EXPECT_TRUE(ended.failed());
  ASSERT_TRUE(ended.end);
  EXPECT_EQ(ended.end->exit_code, 3);
  EXPECT_TRUE(holds(ended.told(), ": the device was lost"));
  const auto next = take();
  ASSERT_TRUE(next);
  next->end({"2024-05-01T12:00:00Z", 0, true, ""});
  EXPECT_FALSE(attempts_in(root_).at(1).failed());
}

TEST_F(AttemptTest, ALockThatNobodyCanReadIsDeadWhenItIsSilent) {
  write_text(root_ / "attempt-1.lock", "");
  EXPECT_TRUE(attempts_in(root_).at(0).alive);
  EXPECT_FALSE(take());
  EXPECT_TRUE(take(0));
}

}  // namespace
}  // namespace vsglbench
