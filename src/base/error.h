/// Errors that reach the user: one line `importon: error: WHAT (WHERE): WHAT TO DO` and an exit status.
#pragma once
#include <stdexcept>
#include <string>

namespace importon {

/// Exit statuses of the command line contract.
enum class ExitStatus { ok = 0, usage = 1, scene = 2, device = 3, output = 4, limitExceeded = 5, interrupted = 130 };

/// An error with its three parts and the exit status it leads to. `where` may be empty.
class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& what, const std::string& where, const std::string& remedy);
  [[nodiscard]] ExitStatus status() const { return status_; }
  [[nodiscard]] const std::string& problem() const { return problem_; }  // WHAT alone

 private:
  ExitStatus status_;
  std::string problem_;
};

/// Bad command line.
struct UsageError : Error {
  UsageError(const std::string& what, const std::string& where, const std::string& remedy)
      : Error(ExitStatus::usage, what, where, remedy) {}
};
/// Bad scene or input image; `where` is "FILE" or "FILE#/json/pointer".
struct SceneError : Error {
  SceneError(const std::string& what, const std::string& where, const std::string& remedy)
      : Error(ExitStatus::scene, what, where, remedy) {}
};
/// No device, lost device, out of device memory, missing feature.
struct DeviceError : Error {
  DeviceError(const std::string& what, const std::string& where, const std::string& remedy)
      : Error(ExitStatus::device, what, where, remedy) {}
};
/// Output cannot be written.
struct OutputError : Error {
  OutputError(const std::string& what, const std::string& where, const std::string& remedy)
      : Error(ExitStatus::output, what, where, remedy) {}
};

/// What an exception leads to: its line without "importon: error: ", and its exit status.
struct Failure {
  ExitStatus status = ExitStatus::ok;
  std::string message;
};

/// Of an Error, of memory that is not there, or of a bug.
[[nodiscard]] Failure failureOf(const std::exception& exception);

}  // namespace importon
