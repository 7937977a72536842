#include "experiments/report/figure_path.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/input_file.h"
#include "experiments/base/failure.h"
#include "irk/misuse.h"

namespace irk {

void requirePlainPath(std::string_view option, const std::string& path) {
  const auto special = [](char c) {
    return std::string_view("'\"`\\$").find(c) != std::string_view::npos || static_cast<unsigned char>(c) < 0x20;
  };
  const auto at = std::find_if(path.begin(), path.end(), special);
  if (at == path.end()) return;
  throw Misuse(fmt::format("{} '{}': '{}' is not allowed in the path of a figure", option, path, *at));
}

std::filesystem::path figurePath(std::string_view option, const std::string& path) {
  requirePlainPath(option, path);
  std::filesystem::path figure(path);
  const auto ending = figure.extension();
  if (ending == ".svg" || ending == ".png") figure.replace_extension();
  if (!figure.has_filename() || figure.filename() == "." || figure.filename() == "..") {
    throw Misuse(fmt::format("{} '{}': the name of a figure is expected, not a folder", option, path));
  }
  const auto folder = figure.parent_path();
  std::error_code none;
  if (!folder.empty() && !std::filesystem::is_directory(folder, none)) {
    throw Misuse(fmt::format("{} '{}': there is no folder '{}'", option, path, folder.string()));
  }
  if (access(folder.empty() ? "." : folder.c_str(), W_OK) != 0) {
    throw Failure(fmt::format("{} '{}': no file can be written there: {}", option, path, std::strerror(errno)));
  }
  for (const char* its : {".svg", ".png", ".csv"}) requireRegularFile(figure.string() + its);
  return figure;
}

}  // namespace irk
