#include "irk/collections.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

#include "core/base/text.h"
#include "irk/misuse.h"
#include "irk/scene.h"

namespace irk {
namespace {

struct Origin {
  std::string_view scene;
  std::string_view collections;  // separated by blanks
  std::string_view literature = {};
};

// Sorted by scene.
constexpr Origin kOrigins[] = {
    {"ancf_cantilever", "multibody"},
    {"ancf_leaf_stop", "multibody switching"},
    {"ancf_pendulum", "multibody"},
    {"ancf_stop", "multibody switching"},
    {"andrews", "ivp multibody", "IVP test set, ANDREWS; HW II (VII.7)"},
    {"beam", "ivp multibody", "IVP test set, BEAM; HW II (IV.10)"},
    {"beam_chain", "multibody"},
    {"bouncing_mass", "switching"},
    {"caraxis", "ivp multibody", "IVP test set, CARAXIS"},
    {"chemakzo", "ivp", "IVP test set, CHEMAKZO"},
    {"dahlquist", "probes", "HW II (IV.3)"},
    {"dc_motor_chopper", "switching"},
    {"e5", "ivp", "IVP test set, E5; HW II (IV.10)"},
    {"elastica", "probes"},
    {"elastoplastic", "switching"},
    {"heavy_top", "multibody", "O. Bruels, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121-137"},
    {"hires", "ivp", "IVP test set, HIRES; HW II (IV.10)"},
    {"hydraulic_arm", "multibody switching"},
    {"hydraulic_manipulator", "multibody switching"},
    {"index1_nonlinear", "probes"},
    {"index2_nonlinear", "probes", "E. Hairer, Ch. Lubich, M. Roche, LNM 1409, Springer 1989"},
    {"index3_nonlinear", "probes"},
    {"kaps", "probes"},
    {"kepler", "probes"},
    {"mechanical_dae", "probes"},
    {"mechatronic_crank", "multibody switching"},
    {"medakzo", "ivp", "IVP test set, MEDAKZO"},
    {"nand", "ivp", "IVP test set, NAND"},
    {"orego", "ivp", "IVP test set, OREGO; HW II (IV.10)"},
    {"pendulum", "ivp multibody", "HW II (VII.1)"},
    {"pollution", "ivp", "IVP test set, POLLU; J. G. Verwer, SIAM J. Sci. Comput. 15 (1994) 1243-1250"},
    {"prothero_robinson", "probes", "A. Prothero, A. Robinson, Math. Comp. 28 (1974) 145-162"},
    {"pump", "ivp switching", "IVP test set, PUMP"},
    {"riccati_tracking", "probes"},
    {"ringmod", "ivp", "IVP test set, RINGMOD"},
    {"robertson", "ivp", "IVP test set, ROBER; HW II (IV.10)"},
    {"sampled_control", "switching"},
    {"slider_crank", "multibody"},
    {"slider_crank_flexible", "ivp multibody", "IVP test set, CRANK"},
    {"sliding_mass", "multibody switching",
     "H. Sugiyama, J. L. Escalona, A. A. Shabana, Nonlinear Dyn. 31 (2003) 167-195"},
    {"spatial_slider_crank", "multibody", "E. J. Haug, Computer-Aided Kinematics and Dynamics, 1989"},
    {"stick_slip", "switching"},
    {"stick_slip_lugre", "switching"},
    {"transamp", "ivp", "IVP test set, TRANSAMP; HW II (VI.1)"},
    {"van_der_pol", "ivp", "IVP test set, VDPOL; HW II (IV.10)"},
};

std::vector<std::string> words(std::string_view text) {
  std::istringstream in{std::string(text)};
  return {std::istream_iterator<std::string>(in), {}};
}

Origin originOf(std::string_view scene) {
  const auto at =
      std::find_if(std::begin(kOrigins), std::end(kOrigins), [&](const auto& o) { return o.scene == scene; });
  return at == std::end(kOrigins) ? Origin{} : *at;
}

}  // namespace

std::vector<std::string> collections() {
  std::set<std::string> names;
  for (const Origin& origin : kOrigins) {
    for (const std::string& name : words(origin.collections)) names.insert(name);
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> collectionsOf(std::string_view scene) { return words(originOf(scene).collections); }

std::string_view literatureOf(std::string_view scene) { return originOf(scene).literature; }

std::vector<std::string> scenesOf(std::string_view collection) {
  std::vector<std::string> ids;
  for (const SceneEntry& entry : sceneCatalogue()) {
    const auto of = collectionsOf(entry.id);
    if (std::find(of.begin(), of.end(), collection) != of.end()) ids.push_back(entry.id);
  }
  if (ids.empty()) throw Misuse(unknownName("collection", collection, collections()));
  return ids;
}

}  // namespace irk
