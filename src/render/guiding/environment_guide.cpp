#include "render/guiding/environment_guide.h"

#include "kernels/escape_note.h"
#include "render/lists/counters.h"

namespace importon {

EnvironmentGuide::EnvironmentGuide(gpu::Context& context, std::uint32_t paths)
    : context_(context), escapes_(gpu::makeZeros(context, "escapes", std::uint64_t{paths} * sizeof(Escape))) {}

void EnvironmentGuide::note(const Stage& stage, uint counter, const gpu::Buffer& queue, std::uint32_t first,
                            bool isCaustic) const {
  overItems<kernels::EscapeNote>(stage, counter, {.source = counter, .first = first, .isCaustic = isCaustic},
                                 buffers::Queue{queue}, buffers::Escapes{escapes_});
}

EnvironmentGuide::Worth EnvironmentGuide::update(std::uint32_t paths, double discArea) {
  const EscapeTree tree = buildEscapeTree(escapes_.download<Escape>(paths), discArea);
  if (paths * sizeof(Escape) == escapes_.bytes()) escapes_ = {};
  if (tree.leaves == 0) return Worth::unknown;
  if (!tree.isWorthIt()) return Worth::little;
  texels_ = gpu::makeBuffer<uvec4>(context_, "environment guide", tree.texels, gpu::TexelFormat::uint4);
  return Worth::much;
}

}  // namespace importon
