// A value, or an error with one line of text and the exit status of the program.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace hapticwall {

// The program's exit status for each kind of failure (docs/command-line.md).
enum class ErrorKind : std::uint8_t { kUsage = 2, kDevice = 3, kFile = 4, kDisplay = 5 };

struct Error {
  ErrorKind kind = ErrorKind::kUsage;
  std::string message;  // one line: what, where, what would be right
};

// An option or a file of the user is wrong.
[[nodiscard]] inline Error usage_error(std::string message) {
  return {ErrorKind::kUsage, std::move(message)};
}
// A device is missing, refuses or fails.
[[nodiscard]] inline Error device_error(std::string message) {
  return {ErrorKind::kDevice, std::move(message)};
}
// A file cannot be read or written.
[[nodiscard]] inline Error file_error(std::string message) {
  return {ErrorKind::kFile, std::move(message)};
}

// Both sides convert implicitly, so that a function returns the value or the error that it has.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : content_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const { return std::holds_alternative<T>(content_); }
  explicit operator bool() const { return ok(); }
  // Preconditions: ok() for the first three, !ok() for error().
  [[nodiscard]] T& operator*() { return std::get<T>(content_); }
  [[nodiscard]] const T& operator*() const { return std::get<T>(content_); }
  [[nodiscard]] T* operator->() { return &std::get<T>(content_); }
  [[nodiscard]] const T* operator->() const { return &std::get<T>(content_); }
  [[nodiscard]] const Error& error() const { return std::get<Error>(content_); }

 private:
  std::variant<T, Error> content_;
};

// nullopt on success.
using Failure = std::optional<Error>;

}  // namespace hapticwall
