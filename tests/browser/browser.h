// Opens pages in a headless Chromium.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/support.h"

namespace irk {

/// The program in PATH; empty if there is none.
inline std::string chromium() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    for (const auto* name : {"chromium", "chromium-browser", "google-chrome"}) {
      const auto file = std::filesystem::path(folder) / name;
      if (std::filesystem::is_regular_file(file)) return file.string();
    }
  }
  return "";
}

#define IRK_NEEDS_CHROMIUM() \
  if (chromium().empty()) GTEST_SKIP() << "no Chromium here: apt-get install chromium"

struct OpenedPage {
  int status = 0;                    ///< Chromium's
  std::string dom;                   ///< after its scripts
  std::vector<std::string> console;  ///< what it wrote there: errors, warnings, missing files
};

/// Opens file://`page`#`hash` and waits until its scripts have nothing left to do. Its profile lives in a folder of its
/// own and goes with it.
inline OpenedPage openPage(const std::filesystem::path& page, const std::string& hash = "") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "dom.html", err = folder.path() / "messages";
  const std::string url = "file://" + page.string() + (hash.empty() ? "" : "#" + hash);
  const std::string command =
      "timeout 100 '" + chromium() +
      "' --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --hide-scrollbars --no-first-run "
      "--allow-file-access-from-files --enable-logging=stderr --virtual-time-budget=10000 --dump-dom "
      "--user-data-dir='" +
      (folder.path() / "profile").string() + "' '" + url + "' >'" + out.string() + "' 2>'" + err.string() + "'";
  OpenedPage opened;
  opened.status = std::system(command.c_str());
  opened.dom = readInputFile(out);
  std::ifstream messages(err);
  for (std::string line; std::getline(messages, line);) {
    if (line.find("CONSOLE") != line.npos) opened.console.push_back(line);
  }
  return opened;
}

/// Opens `page` in a frame `width` wide and calls the body of an async function there with `page` (its document),
/// `view` (its window) and the helpers of drive.js; returns what it returns. Errors on the console fail the test.
inline nlohmann::json drive(const std::filesystem::path& page, const std::string& hash, const std::string& body,
                            int width = 1300) {
  const auto driver = page.parent_path() / "drive.html";
  std::ofstream(driver) << "<!DOCTYPE html><meta charset=\"utf-8\"><iframe id=\"frame\" width=\"" << width
                        << "\" height=\"900\" src=\"" << page.filename().string() << '#' << hash
                        << "\"></iframe><pre id=\"answer\"></pre>\n<script>"
                        << readInputFile(std::string(IRK_SOURCE_DIR) + "/tests/browser/drive.js")
                        << "\ndrive(async (page, view) => {" << body << "});</script>\n";
  const OpenedPage opened = openPage(driver);
  std::filesystem::remove(driver);
  for (const auto& line : opened.console) ADD_FAILURE() << line;
  const std::string begin = "<pre id=\"answer\">", end = "</pre>";
  const auto from = opened.dom.find(begin);
  const auto to = opened.dom.find(end, from);
  if (from == opened.dom.npos || to == from + begin.size()) {
    ADD_FAILURE() << "no answer from " << page << ", status " << opened.status;
    return {};
  }
  std::string text = opened.dom.substr(from + begin.size(), to - from - begin.size());
  for (const auto& [entity, sign] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}}) {
    for (auto at = text.find(entity); at != text.npos; at = text.find(entity, at + 1)) {
      text.replace(at, std::string(entity).size(), sign);
    }
  }
  const auto answer = nlohmann::json::parse(text);
  if (answer.contains("failed")) ADD_FAILURE() << answer["failed"];
  return answer.value("value", nlohmann::json());
}

}  // namespace irk
