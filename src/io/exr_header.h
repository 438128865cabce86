/// What OpenEXR's library takes on trust.
#pragma once
#include <filesystem>
#include <string>

namespace importon {

/// Throws SceneError at `where` if an attribute of the header is said to be longer than the file, or of another length
/// than its type has: the library would take memory for it before it reads. Leaves all other checks to the library.
/// [OpenEXR File Layout, "Header" and "Predefined Attribute Types"]
void checkExrHeader(const std::filesystem::path& file, const std::string& where);

}  // namespace importon
