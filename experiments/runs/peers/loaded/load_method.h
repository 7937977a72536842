// Methods from the user's files.
#pragma once

#include <string>
#include <string_view>

namespace irk {

/// The id of a method that a user names. Loads a solver's shared library, PATH.so (irk/peer_c.h) or CODE@PATH.so (a
/// Fortran code's calling sequence), or a file PATH.cpp with a solver (irk/peer.h), and registers it under the name of
/// the file or of the code, once; returns any other text unchanged. Throws Misuse for a library that cannot be used,
/// and for an id that is taken. Not while other threads use the catalogue of peers.
std::string loadMethod(std::string_view given);

/// Throws Misuse, with the nearest name, for a text without '.' and '/' that is neither the id of a peer nor begins
/// with the id of a family.
void refuseUnknownMethod(const std::string& method);

/// Whether a text names a solver's library, as loadMethod takes it.
bool isLibrary(std::string_view given);

/// The library of a loaded method as loadMethod takes it, with its absolute path; empty for other methods.
std::string libraryOf(const std::string& method);

}  // namespace irk
