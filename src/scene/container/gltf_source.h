/// Names the place of an error in a glTF file: "FILE#/json/pointer".
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace importon {

/// `text` as one line of at most `longest` characters: control characters and what follows the limit are
/// replaced, so that names from a hostile file cannot break a message.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 120);

/// The name of the file that is being read, as it stands in messages.
class GltfSource {
 public:
  explicit GltfSource(std::string name) : name_(std::move(name)) {}
  [[nodiscard]] const std::string& name() const { return name_; }
  /// "FILE#/json/pointer"; `pointer` starts with '/' or is empty.
  [[nodiscard]] std::string at(std::string_view pointer) const;

 private:
  std::string name_;
};

/// `key` as a reference token of a JSON pointer [RFC 6901, section 3].
[[nodiscard]] std::string pointerToken(std::string_view key);

}  // namespace importon
