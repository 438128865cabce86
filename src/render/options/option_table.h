/// The table of the options of `importon render`: docs/adding.md.
#pragma once
#include <string_view>

#include "render/options/option_row.h"

namespace importon {

[[nodiscard]] const std::vector<OptionRow>& optionTable();

/// The heading of a group in the help.
[[nodiscard]] std::string_view headingOf(OptionGroup group);

/// A setting of the talk, by the name of its option.
struct TalkSetting {
  const char *option, *value;
};

/// What --talk sets: the settings of the talk and its author's program.
[[nodiscard]] const std::vector<TalkSetting>& talkSettings();

}  // namespace importon
