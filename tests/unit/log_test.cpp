#include "base/log.h"

#include <gtest/gtest.h>

#include <thread>

namespace importon {
namespace {

using testing::internal::CaptureStderr;
using testing::internal::GetCapturedStderr;

TEST(Log, PrintsTheFirstWarningOfAKindAndCountsTheRest) {
  CaptureStderr();
  {
    Log log;
    log.warn("degenerate", "triangle 3 has no area");
    log.warn("degenerate", "triangle 9 has no area");
    log.warn("degenerate", "triangle 10 has no area");
    log.warn("points", "points are passed over");
    const std::vector<Warning> warnings = log.warnings();
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_EQ(warnings[0].kind, "degenerate");
    EXPECT_EQ(warnings[0].count, 3u);
    EXPECT_EQ(warnings[0].message, "triangle 3 has no area");
    EXPECT_EQ(warnings[1].count, 1u);
  }
  EXPECT_EQ(GetCapturedStderr(),
            "importon: warning: triangle 3 has no area\n"
            "importon: warning: points are passed over\n"
            "importon: warning: 2 more like \"triangle 3 has no area\"\n");
}

TEST(Log, SaysWhatItsVerbosityAllows) {
  const auto said = [](Log::Verbosity verbosity) {
    CaptureStderr();
    {
      Log log(verbosity);
      log.warn("k", "warning");
      log.note("note");
      log.detail("detail");
    }
    return GetCapturedStderr();
  };
  EXPECT_EQ(said(Log::Verbosity::quiet), "importon: warning: warning\n");
  EXPECT_EQ(said(Log::Verbosity::normal), "importon: warning: warning\nimporton: note\n");
  EXPECT_EQ(said(Log::Verbosity::verbose), "importon: warning: warning\nimporton: note\nimporton: detail\n");
}

TEST(Log, PrintsNothingThatOthersHaveTold) {
  CaptureStderr();
  {
    std::set<std::string> told;
    for (const char* more : {"first", "second"}) {
      Log log(Log::Verbosity::normal, "a.glb");
      log.hold();
      log.note("no camera");
      log.warn("k", "warning");
      log.warn("k", "another");
      log.release(told);
      log.note(more);
      log.note("no light");
      log.error("failed");
      EXPECT_EQ(log.warnings().at(0).count, 2u) << "it is counted all the same";
    }
  }
  EXPECT_EQ(GetCapturedStderr(),
            "importon: a.glb: no camera\nimporton: warning: a.glb: warning\nimporton: a.glb: first\n"
            "importon: a.glb: no light\nimporton: error: failed\nimporton: warning: a.glb: 1 more like \"warning\"\n"
            "importon: a.glb: second\n");
}

TEST(Log, NamesItsSubjectButNotInErrors) {
  CaptureStderr();
  {
    Log log(Log::Verbosity::quiet, "chair.glb");
    log.warn("k", "warning");
    log.warn("k", "warning");
    log.error("error");
  }
  EXPECT_EQ(GetCapturedStderr(),
            "importon: warning: chair.glb: warning\nimporton: error: error\n"
            "importon: warning: chair.glb: 1 more like \"warning\"\n");
}

TEST(Log, HoldsBackWhatIsSaidAhead) {
  CaptureStderr();
  {
    Log never;
    never.hold();
    never.warn("k", "never");
    Log log;
    log.hold();
    log.warn("k", "first");
    EXPECT_EQ(log.warnings().size(), 1u);
    log.note("second");
    std::fputs("before\n", stderr);
    log.release();
    log.note("third");
  }
  EXPECT_EQ(GetCapturedStderr(), "before\nimporton: warning: first\nimporton: second\nimporton: third\n");
}

TEST(Log, ShowsNoProgressWhereThereIsNoTerminal) {
  CaptureStderr();
  {
    Log log(Log::Verbosity::verbose);
    log.progress("pass 1/4");
    log.endProgress();
  }
  EXPECT_EQ(GetCapturedStderr(), "");
}

TEST(Log, CountsWarningsOfAllThreads) {
  CaptureStderr();
  std::size_t count = 0;
  {
    Log log;
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&log] {
        for (int i = 0; i < 1000; ++i) log.warn("k", "message");
      });
    }
    threads.clear();
    count = log.warnings().at(0).count;
  }
  GetCapturedStderr();
  EXPECT_EQ(count, 4000u);
}

}  // namespace
}  // namespace importon
