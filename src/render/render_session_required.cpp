// Required density that knows more than where the camera looks: the talk's future work.
#include <algorithm>

#include "render/photon_pass.h"
#include "render/render_session.h"
#include "shared/bindings.h"

namespace importon {

void RenderSession::addPilotLight(MapKind kind, std::vector<LightPoint>& light) {
  const std::uint32_t photons = std::min(plan_.batch, plan_.whole.photonsFor(kind));
  if (photons == 0) return;
  tracePilot({kind, nullptr, true}, 0, photons);
  recorder_->submitAndWait();
  const float perPass = static_cast<float>(plan_.whole.photonsFor(kind)) / static_cast<float>(photons);
  const uint count = work_->counters.download<uint>(1, kCounterRecords * sizeof(uint)).front();
  const auto points = work_->recordPoints.download<MapPoint>(count);
  const auto records = work_->records.download<Record>(count);
  for (std::size_t i = 0; i < count; ++i) {
    if ((records[i].kind & recordMask(kind)) == 0) continue;
    const vec3 flux = records[i].flux;
    light.push_back({points[i].position, perPass * (flux.x + flux.y + flux.z), kind == MapKind::caustic});
  }
}

void RenderSession::knowOtherLight() {
  if (job_.requiredBy != RequiredBy::contribution || !causticMap_ || importance_.caustic.count == 0) return;
  startPass(0);
  std::vector<LightPoint> light;
  addPilotLight(MapKind::caustic, light);
  addPilotLight(MapKind::global, light);
  const LightShare share(light, parameters_.gridOrigin, parameters_.gridExtent);
  ImportanceMap& map = importance_.caustic;
  const gpu::Buffer& known = map.bound ? map.bound : map.importance;
  std::vector<float> required = known.download<float>(map.sites());
  const std::vector<MapPoint> sites = map.readPoints();
  for (std::size_t i = 0; i < required.size(); ++i)
    required[i] *= static_cast<float>(share.requiredShareAt(sites[i].position));
  map.bound = gpu::makeBuffer(device_->context, "required by other light", std::span<const float>(required), gpu::TexelFormat::float1);
}

}  // namespace importon
