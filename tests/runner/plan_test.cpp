// Tasks of a plan by their numbers.
#include "experiments/runner/cluster/plan.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "experiments/runner/base/build_info.h"
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
    plan_.groups = {{true, 0, 0, 2500, 1024}, {false, 0, 0, 7, 3}, {false, 1, 0, 1, 3}};
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
  plan_.groups.push_back({true, 0, 2500, 4000, 1024});
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
  plan_.groups[0].of = 1;
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

}  // namespace

}  // namespace restlab
