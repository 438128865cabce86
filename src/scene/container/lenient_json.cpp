#include "scene/container/lenient_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "scene/container/gltf_advice.h"

namespace importon {
namespace {

using Json = nlohmann::json;

/// Parsers and destructors of JSON values recurse: a document of a million brackets must not reach them.
void checkDepth(std::string_view json, const GltfSource& source) {
  constexpr int kDeepest = 64;
  int depth = 0;
  bool isInString = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (isInString) {
      if (c == '\\') ++i;
      isInString = c != '"';
    } else if (c == '"') {
      isInString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) {
        throw SceneError(fmt::format("the JSON is nested deeper than {} levels", kDeepest), source.name(),
                         "remove deeply nested extras");
      }
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

/// The byte after the string that starts at `start`.
std::size_t endOfString(std::string_view text, std::size_t start) {
  std::size_t i = start + 1;
  while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
  return std::min(i + 1, text.size());
}

/// The byte after the comment that starts at `start`; `start` if none does.
std::size_t endOfComment(std::string_view text, std::size_t start) {
  const std::string_view rest = text.substr(start);
  if (rest.starts_with("//")) return std::min(text.find('\n', start), text.size());
  if (!rest.starts_with("/*")) return start;
  const std::size_t end = text.find("*/", start + 2);
  return end == std::string_view::npos ? text.size() : end + 2;
}

/// Comments, and commas before a closing bracket, become blanks: all else keeps its place.
std::string withoutExtras(std::string_view text) {
  std::string result(text);
  std::size_t comma = std::string::npos;  // the last token, if it is one
  for (std::size_t i = 0; i < result.size();) {
    const char c = result[i];
    const std::size_t commentEnd = endOfComment(result, i);
    if (commentEnd > i) {
      std::fill(result.begin() + static_cast<std::ptrdiff_t>(i),
                result.begin() + static_cast<std::ptrdiff_t>(commentEnd), ' ');
      i = commentEnd;
      continue;
    }
    if ((c == '}' || c == ']') && comma != std::string::npos) result[comma] = ' ';
    if (std::isspace(static_cast<unsigned char>(c)) == 0) comma = c == ',' ? i : std::string::npos;
    i = c == '"' ? endOfString(result, i) : i + 1;
  }
  return result;
}

/// A word of `text`, outside of strings, that stands for a number that JSON does not have; empty: none.
std::string_view strayNumber(std::string_view text) {
  constexpr std::array<std::string_view, 6> kWords = {"NaN", "nan", "Infinity", "infinity", "Inf", "inf"};
  for (std::size_t i = 0; i < text.size();) {
    for (const std::string_view word : kWords)
      if (text.substr(i).starts_with(word)) return text.substr(i, word.size());
    i = text[i] == '"' ? endOfString(text, i) : i + 1;
  }
  return {};
}

[[noreturn]] void refuse(std::string_view text, const char* reason, const GltfSource& source) {
  const std::string_view word = strayNumber(text);
  if (word.empty()) {
    throw SceneError(fmt::format("the JSON is malformed: {}", printable(reason)), source.name(), kExportAgain);
  }
  throw SceneError(fmt::format("the JSON is malformed: it has {} for a number at byte {}", word,
                               static_cast<std::size_t>(word.data() - text.data())),
                   source.name(), "write a finite number");
}

}  // namespace

Json parseLenient(std::string_view text, const GltfSource& source, const Faults& faults) {
  checkDepth(text, source);
  std::string reason;
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    reason = error.what();
  }
  const std::string plain = withoutExtras(text);
  checkDepth(plain, source);
  try {
    Json document = Json::parse(plain);
    faults.forgive("JSON with extras", "", "the JSON is malformed: " + printable(reason),
                   "comments, and commas before a closing bracket, are passed over");
    return document;
  } catch (const Json::exception&) {
    refuse(text, reason.c_str(), source);
  }
}

}  // namespace importon
