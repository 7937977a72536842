// A file that gets its name when it is whole, so that readers never see a part of it.
#pragma once

#include <filesystem>
#include <fstream>

namespace irk {

/// Makes an empty file FILE.<host>.<process>.<number>.new beside `file`, which no other process uses, and returns its
/// name; makes the folder, too. A link of that name, which could lead anywhere, is not followed. Throws Failure if it
/// cannot be made, and Misuse if `file` is a device or a folder, in whose place renaming would put the file.
std::filesystem::path newBeside(const std::filesystem::path& file);

/// Until then it has a name beside it (newBeside). Throws as that.
class NewFile {
 public:
  explicit NewFile(std::filesystem::path file);
  /// Removes the file unless `close` was called.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  std::ostream& out() { return out_; }
  /// Throws Failure if anything could not be written so far.
  void check();
  /// Gives it its name. Throws Failure if anything could not be written.
  void close();

 private:
  std::filesystem::path file_, beside_;
  std::ofstream out_;
};

}  // namespace irk
