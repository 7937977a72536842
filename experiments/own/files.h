// A user's files: scenes, integrators and strategies that are compiled and loaded when they are named.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

#include "irk/scene.h"

namespace irk::own {

/// Whether a text names a file of C++ or an FMU: it ends with `.cpp` or `.fmu`.
bool isFile(std::string_view text);

/// As long as an object exists, loadFile reports on `log` that it compiles; otherwise on standard error.
class ReportTo {
 public:
  explicit ReportTo(std::ostream& log);
  ~ReportTo();
  ReportTo(const ReportTo&) = delete;
  ReportTo& operator=(const ReportTo&) = delete;
};

/// Loads a file once: compiles a file of C++ and runs its registrations, or takes the scene of a shared library
/// (irk/scene_c.h) or an FMU. Returns the id of its scene, empty if it has none. Numbers of 50 and 100 digits are
/// compiled when a run asks for them; libraries and FMUs have double only. Throws as `compile`, sceneOfLibrary and
/// sceneOfFmu, and Misuse for a file that registers nothing, for an id that is taken, and for an object that cannot be
/// loaded.
std::string loadFile(const std::filesystem::path& file);

/// The hash of the loaded file that has registered `id`, its included files and those of irk/data_files.h, for `kind`
/// scene or the name of an axis; empty for what belongs to the program. Part of a run's key. Safe from any number of
/// threads, but not beside loadFile.
std::string hashOf(std::string_view kind, std::string_view id);

/// The hash of the contents of the files that a scene's tables read with these settings (irk/table.h); empty for a
/// scene without tables. Part of a run's key, beside hashOf. Throws Misuse as makeScene. Safe from any number of
/// threads.
std::string hashOfTables(const SceneEntry& scene, const Settings& settings);

/// The hash of a loaded file, by its name; empty for others.
std::string hashOfFile(const std::string& file);

/// How the user has named a loaded file, from its absolute path; the path itself if loadFile has not loaded it.
std::string givenName(const std::string& path);

/// The absolute path of the loaded file that has this hash; empty if there is none.
std::string fileWithHash(std::string_view hash);

}  // namespace irk::own
