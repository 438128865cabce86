#include "app/commands.h"
#include "app/load_scene.h"
#include "app/render_loaded.h"
#include "base/clock.h"

namespace importon {

ExitStatus runRender(const RenderCommand& command, const std::atomic<bool>& isInterrupted, Clock::time_point start) {
  checkOutputs(command.job);
  Log log(command.verbosity);
  tellOfOptions(command, log);
  const Clock::time_point loadStart = Clock::now();
  LoadedScene loaded{loadScene(command.job, log)};
  loaded.seconds = secondsSince(loadStart);
  return renderLoaded(command.job, loaded, log, isInterrupted, start).status;
}

}  // namespace importon
