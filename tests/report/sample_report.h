/// A report of converge that nothing had to be rendered for.
#pragma once
#include "report/converge_files.h"

namespace importon::test {

/// One row of grey pixels.
[[nodiscard]] Image greyRow(const std::vector<float>& values);

/// Two configurations, "default" and "a<b", with seeds 1 and 2 and budgets 1, 2 and 4 s: the error of the first
/// falls with the square of time, 0.16/t², that of the second is four times as large.
[[nodiscard]] ConvergeReport sampleReport();
[[nodiscard]] ConvergeTitle sampleTitle();

}  // namespace importon::test
