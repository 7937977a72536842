// A shared library of the user's, loaded while the program runs.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

namespace irk {

/// Stays loaded as long as an object of it lives.
class SharedLibrary {
 public:
  /// Throws Misuse for a file that is missing or cannot be loaded, with its path and the loader's reason.
  explicit SharedLibrary(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  /// A hash of the file's contents.
  const std::string& hash() const { return hash_; }
  /// The address of a function; nullptr if the library has none of this name.
  template <class Function>
  Function* find(const char* name) const {
    return reinterpret_cast<Function*>(address(name));
  }
  /// As `find`. Throws Misuse naming path and function if it is missing.
  template <class Function>
  Function* get(const char* name) const {
    if (auto* const function = find<Function>(name)) return function;
    refuse(std::string("it has no function '") + name + "'");
  }
  /// To be held while functions run that keep numbers in static storage, as Fortran codes do in COMMON blocks. The
  /// codes of one library share some of them.
  std::mutex& oneAtATime() const { return *one_at_a_time_; }
  /// Throws Misuse with the path.
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  void* address(const char* name) const;

  std::filesystem::path path_;
  std::string hash_;
  std::shared_ptr<void> library_;  // of Boost.DLL
  std::shared_ptr<std::mutex> one_at_a_time_ = std::make_shared<std::mutex>();
};

}  // namespace irk
