#include "experiments/own/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <vector>

#include "core/base/input_file.h"
#include "experiments/base/numbers.h"
#include "experiments/own/compiler.h"
#include "experiments/own/crash.h"
#include "experiments/own/fmu/scene.h"
#include "experiments/own/foreign/scene_library.h"
#include "experiments/own/shared_library.h"
#include "irk/options.h"
#include "irk/registration.h"
#include "irk/scene.h"

namespace irk::own {
namespace {

std::ostream* report = nullptr;
std::ostream& log() { return report ? *report : std::cerr; }

bool isFmu(std::string_view text) { return text.ends_with(".fmu"); }

// Objects are never unloaded, not even at the program's end: what they have registered is destroyed later.
const SharedLibrary& load(const std::filesystem::path& object, const std::filesystem::path& source) {
  static auto& loaded = *new std::vector<std::unique_ptr<SharedLibrary>>;
  explainCrashes(source);
  try {
    return *loaded.emplace_back(std::make_unique<SharedLibrary>(object));
  } catch (const Misuse& misuse) {
    const std::string_view reason = misuse.what(), name = object.c_str();
    throw Misuse(fmt::format("{}: compiled, but {}", source.string(),
                             reason.starts_with(name) ? reason.substr(name.size() + 2) : reason));
  }
}

SceneEntry entryIn(const SharedLibrary& object) {
  SceneEntry entry;
  object.get<void(SceneEntry*)>("irk_scene")(&entry);
  return entry;
}

// `make`, whose exceptions become a Misuse that names the file: the settings do not go together.
template <class Make>
Make refusing(Make make, const std::filesystem::path& file) {
  return [make = std::move(make), file](const Settings& settings) {
    try {
      return make(settings);
    } catch (const Misuse&) {
      throw;
    } catch (const std::exception& error) {
      throw Misuse(fmt::format("{}: it throws while the scene is made: {}", file.string(), error.what()));
    }
  };
}

/// Makes the scene of a file in multiprecision: compiles and loads the file anew when this is asked for first.
class MoreDigits {
 public:
  explicit MoreDigits(std::filesystem::path source) : source_(std::move(source)) {}

  Scene<BigFloat> operator()(const Settings& settings) {
    const std::lock_guard lock(mutex_);
    if (!refusal_.empty()) throw Misuse(refusal_);
    if (!made_) compileAndLoad();
    return made_(settings);
  }

 private:
  void compileAndLoad() {
    try {
      const Compiled compiled = compile(source_, 50, log());
      made_ = entryIn(load(compiled.object, source_)).make_big_float;
    } catch (const Misuse& misuse) {
      refusal_ = misuse.what();
      throw;
    }
  }

  std::filesystem::path source_;
  std::mutex mutex_;
  std::function<Scene<BigFloat>(const Settings&)> made_;
  std::string refusal_;  // every run of a study would compile the file again
};

std::function<Scene<BigFloat>(const Settings&)> whenAsked(const std::filesystem::path& source) {
  const auto maker = std::make_shared<MoreDigits>(source);
  return [maker](const Settings& settings) { return (*maker)(settings); };
}

using Id = std::pair<std::string, std::string>;  // kind, id

template <class... Axes>
std::set<Id> idsOfAxes() {
  std::set<Id> ids;
  const auto add = [&ids](std::string_view axis, const auto& entries) {
    for (const auto& entry : entries) ids.insert({std::string(axis), std::string(entry.id)});
  };
  (add(axisName<Axes>(), named<Axes>()), ...);
  return ids;
}

// All ids that a file can register.
std::set<Id> knownIds() {
  auto ids = idsOfAxes<NewtonKind, StageSolverKind, Predictor, ErrorEstimate, StepControl, OrderControl, Discontinuity,
                       JacobianTerms>();
  for (const auto& scene : sceneCatalogue()) ids.insert({"scene", scene.id});
  return ids;
}

struct LoadedFile {
  std::string scene, hash, given;
};
std::map<std::filesystem::path, LoadedFile>& loadedFiles() {
  static std::map<std::filesystem::path, LoadedFile> files;
  return files;
}
std::map<Id, std::string>& hashes() {
  static std::map<Id, std::string> all;
  return all;
}

// Runs registrations with this file as their source.
void registerSceneOf(SceneEntry entry, const std::filesystem::path& source) {
  static SceneEntry next;
  entry.folder = std::filesystem::absolute(source).parent_path().lexically_normal().string();
  if (entry.make) entry.make = refusing(std::move(entry.make), source);
  if (entry.make_big_float) entry.make_big_float = refusing(std::move(entry.make_big_float), source);
  next = std::move(entry);
  const Registration registration([] { registerScene(std::move(next)); });
  runRegistrations(source.string());
}

// The hash of a compiled file and of the files of numbers that it reads (irk/data_files.h). Throws Misuse.
std::string hashWithData(const Compiled& compiled, const SharedLibrary& object, const std::filesystem::path& source) {
  auto* const names = object.find<const char* const*()>("irk_data_files");
  if (!names) return compiled.hash;
  std::string hash = compiled.hash;
  for (auto name = names(); *name; ++name) {
    const auto file = source.parent_path() / *name;
    try {
      hash += ' ' + hexText(fnv1a(readInputFile(file)));
    } catch (const Misuse& misuse) {
      throw Misuse(fmt::format("{}: IRK_DATA_FILES: {}", source.string(), misuse.what()));
    }
  }
  return hexText(fnv1a(hash));
}

std::string loadNew(const std::filesystem::path& given, const std::filesystem::path& file) {
  const Compiled compiled = compile(given, 16, log());
  const auto before = knownIds();
  const SharedLibrary& object = load(compiled.object, given);
  // The hash is needed by what registers.
  LoadedFile& loaded = loadedFiles()[file] = {"", hashWithData(compiled, object, file), given.string()};
  const bool registers = runRegistrations(given.string()) > 0;
  if (object.find<void(SceneEntry*)>("irk_scene")) {
    SceneEntry entry = entryIn(object);
    loaded.scene = entry.id;
    entry.make_big_float = whenAsked(file);
    registerSceneOf(std::move(entry), given);
  }
  for (const auto& id : knownIds()) {
    if (before.contains(id)) continue;
    hashes()[id] = loaded.hash;
  }
  if (!registers && loaded.scene.empty()) {
    throw Misuse(
        fmt::format("{}: it registers nothing: IRK_SCENE(...) or IRK_REGISTER {{ ... }} is expected", given.string()));
  }
  return loaded.scene;
}

// A scene that is compiled already.
std::string loadCompiled(const std::filesystem::path& given, const std::filesystem::path& file) {
  LibraryScene loaded = isFmu(given.string()) ? sceneOfFmu(given) : sceneOfLibrary(given);
  const std::string id = loaded.entry.id;
  loadedFiles()[file] = {id, loaded.hash, given.string()};
  registerSceneOf(std::move(loaded.entry), given);
  hashes()[{"scene", id}] = loaded.hash;
  return id;
}

}  // namespace

bool isFile(std::string_view text) { return text.ends_with(".cpp") || isFmu(text); }

ReportTo::ReportTo(std::ostream& log) { report = &log; }
ReportTo::~ReportTo() { report = nullptr; }

std::string loadFile(const std::filesystem::path& file) {
  std::error_code error;
  const auto path = std::filesystem::canonical(file, error);
  const auto known = loadedFiles().find(path);
  if (!error && known != loadedFiles().end()) return known->second.scene;
  try {
    return file.extension() == ".cpp" ? loadNew(file, path) : loadCompiled(file, path);
  } catch (...) {
    loadedFiles().erase(path);
    throw;
  }
}

std::string hashOfFile(const std::string& file) {
  std::error_code error;
  const auto known = loadedFiles().find(std::filesystem::canonical(file, error));
  return error || known == loadedFiles().end() ? "" : known->second.hash;
}

std::string givenName(const std::string& path) {
  const auto loaded = loadedFiles().find(path);
  return loaded == loadedFiles().end() ? path : loaded->second.given;
}

std::string fileWithHash(std::string_view hash) {
  for (const auto& [file, loaded] : loadedFiles()) {
    if (!hash.empty() && loaded.hash == hash) return file.string();
  }
  return "";
}

std::string hashOf(std::string_view kind, std::string_view id) {
  if (hashes().empty()) return "";
  const auto at = hashes().find({std::string(kind), std::string(id)});
  return at == hashes().end() ? "" : at->second;
}

std::string hashOfTables(const SceneEntry& scene, const Settings& settings) {
  if (!scene.registered) return "";
  static std::mutex mutex;
  static std::map<std::pair<std::string, Settings>, std::set<std::string>> known;  // a study has many runs of a scene
  const std::pair name{scene.id, settings};
  std::unique_lock lock(mutex);
  auto found = known.find(name);
  if (found == known.end()) {
    lock.unlock();
    std::set<std::string> files;
    for (const auto& table : makeScene<double>(scene, settings).tables) files.insert(table.file);
    lock.lock();
    found = known.emplace(name, std::move(files)).first;
  }
  std::string all;
  for (const auto& file : found->second) all += ' ' + hexText(fnv1a(readInputFile(file)));
  return all.empty() ? "" : hexText(fnv1a(all));
}

}  // namespace irk::own
