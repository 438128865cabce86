#include "app/named_job.h"

#include <iterator>
#include <sstream>

#include "base/error.h"
#include "fmt/format.h"

namespace importon {
namespace {

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

}  // namespace

NamedJob makeNamedJob(const std::string& name, const std::string& options, const std::filesystem::path& scene,
                      const std::vector<std::string>& common) {
  std::vector<std::string> words{"render", scene.string(), "-o", "unused"};
  words.insert(words.end(), common.begin(), common.end());
  const std::vector<std::string> own = wordsOf(options);
  words.insert(words.end(), own.begin(), own.end());
  try {
    const auto render = std::get<RenderCommand>(parseCommandLine(words));
    return {name, options, render.job};
  } catch (const std::bad_variant_access&) {
    throw UsageError(fmt::format("configuration {} does not render one picture", name), "command line",
                     "give options of importon render, for one scene and camera");
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("configuration {}: {}", name, error.what()), "", "see importon render --help");
  }
}

NamedJob parseNamedJob(const std::string& text, const std::filesystem::path& scene,
                       const std::vector<std::string>& common) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || text.find_first_of(",\"\n") < equals)
    throw UsageError(fmt::format("--config \"{}\" has no plain name", text), "command line", "give NAME=OPTIONS");
  return makeNamedJob(text.substr(0, equals), text.substr(equals + 1), scene, common);
}

void checkNames(const std::vector<NamedJob>& jobs) {
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (jobs[i].name == jobs[j].name)
        throw UsageError(fmt::format("configuration {} is there twice", jobs[i].name), "command line",
                         "give each its own name");
    }
  }
}

}  // namespace importon
