/// Opens a page in headless Chromium without a network, and asks it things.
#pragma once
#include <optional>
#include <string>

namespace importon::test {

/// The name of a Chromium; empty: none is installed.
[[nodiscard]] std::optional<std::string> findBrowser();

/// What a page does when `script` has run in it after it has loaded.
struct PageVisit {
  std::string errors;  // of scripts, of the console, and of what could not be loaded; one a line
  std::string result;  // what `script` gave to `tell(text)`
};

/// Throws std::runtime_error if the browser fails.
[[nodiscard]] PageVisit visitPage(const std::string& browser, const std::string& page, const std::string& script);

}  // namespace importon::test
