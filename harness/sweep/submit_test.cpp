#include "sweep/submit.h"

#include <cstdlib>

#include "sweep/sweep_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class SubmitTest : public SweepTest {
 protected:
  void SetUp() override {
    SweepTest::SetUp();
    path_ = std::getenv("PATH");
  }
  void TearDown() override {
    ::setenv("PATH", path_.c_str(), 1);
    SweepTest::TearDown();
  }
  // A programme that notes its arguments, a line a call, and says what sbatch says.
  void use_made(const std::string& programme, int code = 0) {
    write_text(
        root_ / "bin" / programme,
        fmt::format("#!/usr/bin/env bash\necho \"$*\" >> {}\necho \"$(wc -l < {});cluster\"\nexit {}\n",
                    shell_word((root_ / "calls").string()), shell_word((root_ / "calls").string()), code));
    fs::permissions(root_ / "bin" / programme, fs::perms::owner_all);
    ::setenv("PATH", ((root_ / "bin").string() + ":" + path_).c_str(), 1);
  }
  std::vector<std::string> calls() const {
    std::vector<std::string> lines;
    std::istringstream text(read_text(root_ / "calls"));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
  std::string path_;
};

std::vector<size_t> numbers(size_t count) {
  std::vector<size_t> out(count);
  for (size_t i = 0; i < count; ++i) out[i] = i;
  return out;
}

TEST_F(SubmitTest, ReferencesComeBeforeShards) {
  std::vector<Shard> shards = made_shards("cornell", 3, 1);
  for (const Shard& s : made_shards("ring", 2, 1)) shards.push_back(s);
  const MadeSweep sweep(root_ / "a sweep", shards);
  use_made("sbatch");
  const SubmitScripts scripts = write_scripts(
      sweep.folder.root(), sweep.plan, numbers(5),
      {.engine = Engine::slurm, .require = "NVIDIA H200", .arguments = {"-p", "gpu", "--comment=a b"}});
  EXPECT_EQ(run_scripts(scripts, Engine::slurm), 0);
  ASSERT_EQ(calls().size(), 2u);
  EXPECT_TRUE(holds(calls()[0], "--array=0-1 -p gpu --comment=a b " + scripts.references.string() + " 0"));
  EXPECT_EQ(calls()[0].find("--exclusive"), std::string::npos);
  EXPECT_TRUE(holds(calls()[1],
                    "--dependency=afterok:1 --kill-on-invalid-dep=yes --exclusive --gres=gpu:1 "
                    "--array=0-4 -p gpu --comment=a b " +
                        scripts.shard.string() + " 0"));
  EXPECT_TRUE(holds(read_text(scripts.shard), "--require-device 'NVIDIA H200'"));
  EXPECT_EQ(read_text(scripts.references).find("--require-device"), std::string::npos);
}

TEST_F(SubmitTest, OpenShardsAndTheirScenesAlone) {
  std::vector<Shard> shards = made_shards("cornell", 3, 1);
  for (const Shard& s : made_shards("ring", 2, 1)) shards.push_back(s);
  const MadeSweep sweep(root_ / "sweep", shards);
  use_made("sbatch");
  run_scripts(write_scripts(sweep.folder.root(), sweep.plan, {4}, {.engine = Engine::slurm, .gres = ""}),
              Engine::slurm);
  EXPECT_TRUE(holds(calls().at(0), "--array=1 "));
  EXPECT_TRUE(holds(calls().at(1), "--array=4 "));
  EXPECT_EQ(calls().at(1).find("--gres"), std::string::npos);
}

TEST_F(SubmitTest, MoreShardsThanAnArrayTakes) {
  const MadeSweep sweep(root_ / "sweep", made_shards("cornell", 2500, 1));
  use_made("sbatch");
  run_scripts(write_scripts(sweep.folder.root(), sweep.plan, numbers(2500), {.engine = Engine::slurm}),
              Engine::slurm);
  ASSERT_EQ(calls().size(), 4u);
  EXPECT_TRUE(holds(calls()[1], "--array=0-999 "));
  EXPECT_TRUE(holds(calls()[3], "--array=0-499 "));
  EXPECT_TRUE(calls()[3].ends_with("shard.sh 2000"));
  EXPECT_TRUE(holds(calls()[3], "afterok:1 "));
}

TEST_F(SubmitTest, GnuParallelRunsTheSameTasks) {
  const MadeSweep sweep(root_ / "sweep", made_shards("cornell", 3, 1));
  use_made("parallel");
  const SubmitScripts scripts =
      write_scripts(sweep.folder.root(), sweep.plan, {0, 2},
                    {.engine = Engine::parallel, .arguments = {"--sshlogin", "a,b"}});
  EXPECT_EQ(run_scripts(scripts, Engine::parallel), 0);
  EXPECT_TRUE(holds(calls().at(0), "--sshlogin a,b " + scripts.references.string() + " 0 {} ::: 0"));
  EXPECT_TRUE(holds(calls().at(1), "--sshlogin a,b " + scripts.shard.string() + " 0 {} ::: 0 2"));
  use_made("parallel", 3);
  EXPECT_EQ(run_scripts(scripts, Engine::parallel), 3);
  EXPECT_EQ(calls().size(), 3u);  // without references no shard
}

TEST_F(SubmitTest, AnEngineThatIsNotThereIsNamed) {
  const MadeSweep sweep(root_ / "sweep", made_shards("cornell", 1, 1));
  const SubmitScripts scripts =
      write_scripts(sweep.folder.root(), sweep.plan, {0}, {.engine = Engine::slurm});
  ::setenv("PATH", (root_ / "none").c_str(), 1);
  try {
    run_scripts(scripts, Engine::slurm);
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.exit_code(), 2);
    EXPECT_TRUE(holds(e.what(), "sbatch is not installed"));
  }
  EXPECT_THROW(engine_named("pbs"), Error);
}

TEST(IndexList, IsAsShortAsSlurmTakesIt) {
  EXPECT_EQ(index_list({0, 1, 2, 3, 7}), "0-3,7");
  EXPECT_EQ(index_list({5}), "5");
  EXPECT_EQ(index_list({1, 3, 4}), "1,3-4");
  EXPECT_EQ(index_list({}), "");
}

TEST(ShellWord, IsOneWordAsItWas) {
  for (const std::string text : {"plain", "", "a b", "it's", "$(echo no)", "a\"b", "*", "a;b", "~"}) {
    const std::string command = "printf '%s|' " + shell_word(text);
    FILE* pipe = ::popen(command.c_str(), "r");
    char out[64] = {};
    ASSERT_TRUE(std::fgets(out, sizeof out, pipe));
    ::pclose(pipe);
    EXPECT_EQ(out, text + "|");
  }
}

}  // namespace
}  // namespace vsglbench
