// Tasks of a plan by their numbers.
#include "experiments/runner/cluster/plan.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/cluster/sbatch_options.h"
#include "experiments/runner/cluster/submissions.h"
#include "experiments/runner/cluster/tasks_there.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

class PlanTest : public TemporaryFolder {
 protected:
  PlanTest() {
    plan_.build = buildJson();
    plan_.references.resize(1);
    plan_.references[0].key = "k";
    plan_.references[0].label = "ref";
    plan_.tables.resize(2);
    plan_.tables[0].label = "a";
    plan_.tables[1].label = "b";
    plan_.add({true, 0, 0, 2500, 1024});
    plan_.add({false, 0, 0, 7, 3});
    plan_.add({false, 1, 0, 1, 3});
  }
  Plan plan_;
};

TEST_F(PlanTest, TasksAreCountedThroughTheGroups) {
  ASSERT_EQ(plan_.tasks(), 7u);
  EXPECT_EQ(plan_.describe(plan_.task(0)), "samples 0 to 1023 of reference ref");
  EXPECT_EQ(plan_.describe(plan_.task(2)), "samples 2048 to 2499 of reference ref");
  EXPECT_EQ(plan_.describe(plan_.task(3)), "runs 0 to 2 of a");
  EXPECT_EQ(plan_.describe(plan_.task(5)), "run 6 of a");
  EXPECT_EQ(plan_.describe(plan_.task(6)), "run 0 of b");
  EXPECT_THROW(plan_.task(7), Error);
  // Chunks that are added later leave the numbers of all others.
  plan_.add({true, 0, 2500, 4000, 1024});
  EXPECT_EQ(plan_.describe(plan_.task(3)), "runs 0 to 2 of a");
  EXPECT_EQ(plan_.describe(plan_.task(8)), "samples 3524 to 3999 of reference ref");
}

TEST_F(PlanTest, APlanIsReadAsItWasWritten) {
  plan_.id = "x";
  plan_.tables[1].references = {0};
  plan_.tables[1].runS = 0.1 + 0.2;
  plan_.references[0].isWhole = true;
  writePlan(folder(), plan_);
  const Plan read = readPlan(folder());
  EXPECT_EQ(read.tasks(), plan_.tasks());
  EXPECT_EQ(read.tables[1].references, plan_.tables[1].references);
  EXPECT_EQ(read.tables[1].runS, 0.1 + 0.2);
  EXPECT_TRUE(read.references[0].isWhole);
  plan_.add({true, 1, 0, 1, 1});
  writePlan(folder(), plan_);
  EXPECT_THROW(readPlan(folder()), Error) << "a reference that is not there";
}

TEST_F(PlanTest, SubmissionsAreCountedByRound) {
  EXPECT_EQ(rangesText({0, 1, 2, 5, 7, 8}), "0-2,5,7-8");
  Submissions all;
  all.engine = "slurm";
  all.all = {{"1", {0, 1, 2}, {60.0, 100.0}, 1, "t"},
             {"2", {}, {}, 1, "t"},
             {"3", {1}, {120.0, 200.0}, 1, "t"}};
  writeSubmissions(folder(), all);
  Submissions read = readSubmissions(folder());
  EXPECT_EQ(read.attempts(0), 1);
  EXPECT_EQ(read.attempts(1), 2);
  EXPECT_EQ(read.attempts(3), 0);
  ASSERT_NE(read.last(1), nullptr);
  EXPECT_EQ(read.last(1)->asked.memoryMiB, 200.0);
  read.all.push_back({"4", {0}, {}, 2, "t"});
  EXPECT_EQ(read.attempts(1), 0) << "a call by hand begins anew";
}

TEST_F(PlanTest, MarksAreOfTheRoundThatHandedTheTaskOver) {
  Submissions all;
  all.all = {{"17", {0, 1}, {}, 1, "t"}, {"18", {0, 1}, {}, 2, "t"}, {"19", {1}, {}, 2, "t"}};
  Mark mark;
  mark.job = "17_1";
  EXPECT_FALSE(all.isOfRound(mark, 1));
  mark.job = "19_1";
  EXPECT_TRUE(all.isOfRound(mark, 1));
  EXPECT_FALSE(all.isOfRound(mark, 0));
  // Processes here have times instead.
  all.all = {{"", {0}, {}, 1, "2026-01-01T00:00:00Z"}, {"", {0}, {}, 2, "2026-01-01T00:00:09Z"}};
  mark.job = "";
  mark.started = "2026-01-01T00:00:05Z";
  EXPECT_FALSE(all.isOfRound(mark, 0));
  mark.started = "2026-01-01T00:00:10Z";
  EXPECT_TRUE(all.isOfRound(mark, 0));
}

TEST(SbatchOptions, OfTheUserAreDoubled) {
  const Asked planned = {600.0, 1000.0};
  const auto asked = [&](const std::string& options, double times) {
    const Asked own = withOptions(planned, options, times);
    return std::pair(own.memoryMiB, own.seconds);
  };
  EXPECT_EQ(asked("--partition=main -c 4", 2.0), std::pair(1000.0, 600.0)) << "as they come";
  EXPECT_EQ(asked("--mem=4G --time=90", 2.0), std::pair(8192.0, 10800.0));
  EXPECT_EQ(asked("--mem 512 -t 1:30:00", 1.0), std::pair(512.0, 5400.0));
  EXPECT_EQ(asked("-t90:30 --mem=1048576K", 1.0), std::pair(1024.0, 5430.0));
  EXPECT_EQ(asked("--time=2-12 --mem-bind=local", 2.0), std::pair(1000.0, 2 * 216000.0));
  EXPECT_EQ(asked("--mem-per-cpu=1G --time=UNLIMITED", 2.0), std::pair(0.0, 0.0)) << "they stay";
}

}  // namespace

}  // namespace restlab
