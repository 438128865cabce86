/// What each command of the command line does.
#pragma once
#include <atomic>
#include <chrono>

#include "app/command_line.h"
#include "base/error.h"

namespace importon {

/// Loads, renders and writes. `start` is when the process started. Every output is checked before anything is
/// loaded. Throws SceneError, DeviceError and OutputError.
[[nodiscard]] ExitStatus runRender(const RenderCommand& command, const std::atomic<bool>& isInterrupted,
                                   std::chrono::steady_clock::time_point start);

/// Renders one job after another on one device, and loads the next scene meanwhile. A job that fails says so, and the
/// others go on; the numerically highest exit status is that of the batch. Throws OutputError where a folder or the
/// summary cannot be written.
[[nodiscard]] ExitStatus runBatch(const BatchCommand& command, const std::atomic<bool>& isInterrupted,
                                  std::chrono::steady_clock::time_point start);

/// Prints to stdout. Throws SceneError.
[[nodiscard]] ExitStatus runInfo(const InfoCommand& command);

/// Prints to stdout; ExitStatus::limitExceeded when a limit is. Throws SceneError.
[[nodiscard]] ExitStatus runCompare(const CompareCommand& command);

/// Renders, and writes results.json, results.csv and index.html. Throws SceneError, DeviceError and OutputError.
[[nodiscard]] ExitStatus runConverge(const ConvergeCommand& command, const std::atomic<bool>& isInterrupted);

/// Renders, and writes study.json and index.html. Throws SceneError, DeviceError and OutputError.
[[nodiscard]] ExitStatus runStudy(const StudyCommand& command, const std::atomic<bool>& isInterrupted);

/// Writes the average. Throws SceneError and OutputError.
[[nodiscard]] ExitStatus runMerge(const MergeCommand& command);

/// Prints to stdout. Throws DeviceError when there is no device.
[[nodiscard]] ExitStatus runDevices();

}  // namespace importon
