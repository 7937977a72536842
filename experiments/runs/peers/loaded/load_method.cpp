#include "experiments/runs/peers/loaded/load_method.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "experiments/own/crash.h"
#include "experiments/own/files.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/loaded/adapters.h"
#include "irk/misuse.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

// The files or libraries that users named, by the id of the method, as absolute paths.
std::map<std::string, std::string>& libraries() {
  static std::map<std::string, std::string> all;
  return all;
}

// All codes of a library share one object, since they share what they keep in static storage.
std::shared_ptr<const SharedLibrary> libraryAt(const std::filesystem::path& path) {
  static std::map<std::filesystem::path, std::shared_ptr<const SharedLibrary>> all;
  auto made = std::make_shared<const SharedLibrary>(path);
  return all.try_emplace(std::filesystem::canonical(path), std::move(made)).first->second;
}

PeerEntry entryOf(std::string_view given) {
  const auto at = given.find('@');
  const auto library = libraryAt(at == given.npos ? given : given.substr(at + 1));
  const std::string file = library->path().filename().string();
  PeerEntry entry;
  if (at == given.npos) {
    entry = cPeer(library, file.substr(0, file.find(".so")));
  } else {
    const auto code = given.substr(0, at);
    entry = hairerPeer(library, code);
    if (!entry.make) entry = dasslPeer(library, code);
    if (!entry.make) {
      throw Misuse(unknownName("code", code, {"ddaspk", "ddassl", "radau", "radau5", "rodas", "seulex"}));
    }
  }
  entry.source = library->hash();
  own::explainCrashes(library->path());
  const auto path = std::filesystem::absolute(library->path()).lexically_normal().string();
  libraries()[entry.id] = at == given.npos ? path : std::string(given.substr(0, at + 1)) + path;
  return entry;
}

// The solver of a user's .cpp file.
std::string methodIn(const std::string& file) {
  own::loadFile(file);
  const std::string hash = own::hashOfFile(file);
  std::vector<std::string> ids;
  for (const PeerEntry& peer : peerCatalogue()) {
    if (peer.source == hash) ids.push_back(peer.id);
  }
  if (ids.empty()) throw Misuse(file + ": it holds no solver: IRK_REGISTER { irk::registerPeer(...); } is expected");
  if (ids.size() > 1) {
    throw Misuse(file + ": it holds more than one solver, as '" + ids[0] + "' and '" + ids[1] +
                 "': load it by --load, and name one of them by --method");
  }
  return ids.front();
}

}  // namespace

// A file may be called my_solver.so or my_solver.so.1; an '@' separates the name of a code from its library.
bool isLibrary(std::string_view given) {
  const auto at = given.find('@');  // CODE@LIBRARY; @ivp is a collection of scenes
  const bool code = at != 0 && given.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789") == at;
  return given.ends_with(".so") || given.find(".so.") != given.npos || (code && at != given.npos);
}

void refuseUnknownMethod(const std::string& method) {
  if (findPeer(method) || method.find_first_of("./") != method.npos || std::filesystem::exists(method)) return;
  const auto number = method.find_last_not_of("0123456789") + 1;
  const std::string stages = number < method.size() ? method.substr(number) : "S";
  std::vector<std::string> known;
  for (const auto& family : familyCatalogue()) {
    if (method.starts_with(family.id)) return;  // the catalogue of tableaus has a more precise message
    known.push_back(family.id + "_" + stages);
  }
  for (const auto& peer : peerCatalogue()) known.push_back(peer.id);
  throw Misuse(unknownName("method", method, known));
}

std::string libraryOf(const std::string& method) {
  const auto known = libraries().find(method);
  return known == libraries().end() ? "" : known->second;
}

std::string loadMethod(std::string_view given) {
  if (own::isFile(given)) return methodIn(std::string(given));
  if (!isLibrary(given)) return std::string(given);
  static std::map<std::string, std::string, std::less<>> loaded;
  const auto known = loaded.find(given);
  if (known != loaded.end()) return known->second;
  PeerEntry entry = entryOf(given);
  const std::string id = entry.id;
  registerPeer(std::move(entry));
  return loaded[std::string(given)] = id;
}

}  // namespace irk
