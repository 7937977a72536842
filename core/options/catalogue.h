// Catalogues of strategies: each axis with behaviour has a list of entries, to which users can add their own.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "irk/multiprecision.h"
#include "irk/options.h"

namespace irk {

/// What a strategy requires of the method, the system and the other strategies; core/integration/rules.h checks it.
struct Needs {
  bool invertible_matrix = false;  ///< A of the method is invertible, without an explicit first stage
  bool stage_order = false;        ///< the method's stage order is at least 1
  bool coupled_solver = false;     ///< a stage solver that takes one linearization per stage
  bool kept_jacobian = false;      ///< a Newton method that keeps one Jacobian for all stages
  bool estimate = false;           ///< an error estimate
  bool embedded_estimate = false;  ///< an error estimate that can compare orders
  /// the method has embedded weights b_hat, and an invertible A but for an explicit first stage
  bool embedded_weights = false;
  std::string_view instead = "";  ///< for messages, what to use instead: "estimate 'richardson'"
};

/// One factory per scalar. An empty factory: the strategy does not exist in that scalar.
template <template <class> class Maker>
struct PerScalar {
  Maker<double> in_double;
  Maker<BigFloat> in_big_float;

  template <class Real>
  const Maker<Real>& of() const {
    if constexpr (std::is_same_v<Real, double>) {
      return in_double;
    } else {
      return in_big_float;
    }
  }
};

/// A factory that passes its arguments to the constructor of T.
template <class T>
inline constexpr auto kConstruct = [](auto&&... args) { return std::make_unique<T>(args...); };

/// Factories of T<Real> for all scalars.
template <template <class> class Maker, template <class> class T>
PerScalar<Maker> makes() {
  return {kConstruct<T<double>>, kConstruct<T<BigFloat>>};
}

/// One entry of the axis `Id`. It is specialised beside the strategies of the axis and has at least the members `Id
/// id`, `std::string meaning` and `Needs needs`.
template <class Id>
struct Strategy;

/// The entries of one axis, the default first.
template <class Id>
class Catalogue {
 public:
  explicit Catalogue(std::vector<Strategy<Id>> entries) {
    for (auto& entry : entries) add(std::move(entry));
  }
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;

  /// The entry with this id. Throws Misuse for an unknown id; the message names the axis, the nearest id and all ids.
  const Strategy<Id>& operator[](const Id& id) const {
    return *entryNamed(axisName<Id>(), id.id, entries_, [](const auto& entry) { return entry->id.id; });
  }
  /// All entries, the default first; the view is valid until the next `add`.
  std::span<const Named<Id>> named() const { return named_; }
  /// Adds an entry. Throws Misuse for an id that is taken; the message names both entries.
  void add(Strategy<Id> entry) {
    for (const auto& other : entries_) {
      if (other->id != entry.id) continue;
      throw Misuse(std::string(axisName<Id>()) + " '" + std::string(entry.id.id) + "' (" + entry.meaning +
                   "): the id is taken by '" + std::string(other->id.id) + "' (" + other->meaning + ")");
    }
    entries_.push_back(std::make_unique<Strategy<Id>>(std::move(entry)));
    const Strategy<Id>& kept = *entries_.back();
    named_.push_back({kept.id, kept.id.id, kept.meaning});
  }

 private:
  std::vector<std::unique_ptr<Strategy<Id>>> entries_;  // at fixed addresses
  std::vector<Named<Id>> named_;
};

/// The catalogue of an axis; defined beside its strategies. Any number of threads may read it.
template <class Id>
Catalogue<Id>& catalogue();

/// What the factory of a strategy makes. Throws Misuse if the factory is empty or returns null.
template <class Id, class Maker, class... Args>
auto madeBy(const Maker& make, const Id& id, Args&&... args) {
  decltype(make(args...)) made = make ? make(std::forward<Args>(args)...) : nullptr;
  if (made) return made;
  throw Misuse(std::string(axisName<Id>()) + " '" + std::string(id.id) + "': its factory " +
               (make ? "returns null" : "is empty for this scalar"));
}

/// Adds a strategy to its axis: from then on options, `parseId` and `named` accept its id like those of the library.
/// Throws Misuse for an id that is taken or has characters other than small letters, digits and '_', for an empty
/// meaning, and for a strategy without a factory in double. Must not be called while other threads use the axis.
template <class Id>
void registerStrategy(Strategy<Id> entry) {
  const auto require = [&entry](bool given, const char* what) {
    if (!given) throw Misuse(std::string(axisName<Id>()) + " '" + std::string(entry.id.id) + "': " + what);
  };
  const bool named = entry.id.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos;
  require(named && !entry.id.id.empty(), "an id has small letters, digits and '_'");
  require(!entry.meaning.empty(), "`meaning` is empty: say in a sentence what it is");
  if constexpr (requires { entry.make.in_double; }) {
    require(static_cast<bool>(entry.make.in_double), "`make` is empty for double");
  } else if constexpr (requires { static_cast<bool>(entry.make); }) {
    require(static_cast<bool>(entry.make), "`make` is empty");
  }
  catalogue<Id>().add(std::move(entry));
}

}  // namespace irk

/// Defines the functions that options.h declares for an axis; they read its catalogue.
#define IRK_STRATEGIES(Id, axis)           \
  template <>                              \
  std::string_view axisName<Id>() {        \
    return axis;                           \
  }                                        \
  template <>                              \
  std::span<const Named<Id>> named<Id>() { \
    return catalogue<Id>().named();        \
  }                                        \
  template <>                              \
  Id parseId<Id>(std::string_view id) {    \
    Id wanted{};                           \
    wanted.id = id;                        \
    return catalogue<Id>()[wanted].id;     \
  }
