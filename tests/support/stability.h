/// Writes down what the tests of hard cases find, for docs/stability.md (scripts/stability_table).
#pragma once
#include <string>

namespace importon::test {

/// One hard case while a test is about it. Checks of render_helper.h note themselves; others by note(). When the case
/// ends, its narrowest check goes as a line of JSON to the file that IMPORTON_STABILITY_FILE names, if it names one.
class StabilityCase {
 public:
  /// `number` and `expected` as in the list of cases.
  StabilityCase(int number, std::string what, std::string expected);
  ~StabilityCase();
  StabilityCase(const StabilityCase&) = delete;
  StabilityCase& operator=(const StabilityCase&) = delete;

  /// A check that found `measured`. `margin`: how far it is from failing, 1 where nothing is off, 0 at the limit.
  void note(const std::string& measured, double margin);

 private:
  int number_;
  std::string what_, expected_, measured_;
  double margin_ = 2;  // above any
  int checks_ = 0;
};

/// A check for the case that is running, if one is.
void noteCheck(const std::string& measured, double margin);

}  // namespace importon::test
