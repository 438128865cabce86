# Writes OUTPUT, a C++ file that defines NAMESPACE::embedded::SYMBOL: the words of the SPIR-V module MODULE.
file(READ ${MODULE} hexText HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hexText}")
string(REPEAT "0x[0-9a-f]+," 8 line)
string(REGEX REPLACE "(${line})" "\\1\n" words "${words}")
file(WRITE ${OUTPUT} "#include <cstdint>
#include <span>
namespace ${NAMESPACE}::embedded {
static constexpr std::uint32_t words[] = {
${words}};
extern const std::span<const std::uint32_t> ${SYMBOL};
const std::span<const std::uint32_t> ${SYMBOL}(words);
}  // namespace ${NAMESPACE}::embedded
")
