/// What to do about a file that is wrong.
#pragma once

namespace importon {

inline constexpr const char* kExportAgain = "correct the file or export it again";

}  // namespace importon
