/// Web pages that hold all that they show.
#pragma once
#include <string>
#include <string_view>

#include "io/png.h"

namespace importon {

/// The page of converge (converge_page.html), with a mark where its data goes.
extern const std::string_view kConvergePage;
/// The page of study (study_page.html), alike.
extern const std::string_view kStudyPage;

/// "data:image/png;base64,...".
[[nodiscard]] std::string dataUri(const PngPixels& pixels);

/// Puts JSON text in the place of the mark "@DATA@", so that it cannot end the script element it stands in.
[[nodiscard]] std::string fillPage(std::string_view page, const std::string& json);

}  // namespace importon
