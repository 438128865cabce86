#include "support/stability.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

namespace importon::test {
namespace {

StabilityCase* running = nullptr;  // tests of one process run one after another

}  // namespace

StabilityCase::StabilityCase(int number, std::string what, std::string expected)
    : number_(number), what_(std::move(what)), expected_(std::move(expected)) {
  running = this;
}

StabilityCase::~StabilityCase() {
  running = nullptr;
  const char* const file = std::getenv("IMPORTON_STABILITY_FILE");
  const ::testing::TestInfo* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  if (file == nullptr || test == nullptr || checks_ == 0) return;
  const nlohmann::ordered_json line = {{"case", number_},
                                       {"what", what_},
                                       {"expected", expected_},
                                       {"measured", measured_},
                                       {"margin", margin_},
                                       {"checks", checks_},
                                       {"test", std::string(test->test_suite_name()) + "." + test->name()},
                                       {"passed", !test->result()->Failed()}};
  std::ofstream(file, std::ios::app) << line.dump() + "\n";
}

void StabilityCase::note(const std::string& measured, double margin) {
  ++checks_;
  if (!(margin < margin_)) return;
  margin_ = margin;
  measured_ = measured;
}

void noteCheck(const std::string& measured, double margin) {
  if (running != nullptr) running->note(measured, margin);
}

}  // namespace importon::test
