// One setting as data: its name, its meaning, its legal values, and how it is read and set. Command-line options, study
// keys, columns, messages and validation are generated from tables of fields.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/number_text.h"
#include "irk/options.h"

namespace irk {

enum class FieldKind {
  kAxis,     ///< one of `choices`
  kNumber,   ///< a double of `range`
  kInteger,  ///< an integer of `range`
  kText,
};

/// One id of an axis.
struct Choice {
  std::string id;
  std::string meaning;
};

/// One setting of a `Spec`.
template <class Spec>
struct Field {
  std::string name;     ///< `max_steps`: in options, files, tables and messages
  std::string meaning;  ///< one sentence
  FieldKind kind = FieldKind::kText;
  Range range{};       ///< numbers and integers only
  std::string form{};  ///< texts only: what is expected, in words
  /// Axes only: the ids that are known now, the default first.
  std::function<std::vector<Choice>()> choices{};

  /// The value as text, which `set` reads back to the same value.
  std::function<std::string(const Spec&)> get{};
  /// Sets the value from text. Throws Misuse; the message names the field, the value, and the range or the nearest id.
  std::function<void(Spec&, std::string_view)> set{};
  /// Numbers and integers only: reads the value, and sets it without a check.
  std::function<double(const Spec&)> number{};
  std::function<void(Spec&, double)> assign{};
  /// Why the field has no effect in a spec; empty if it may have one. Null: it always may have one.
  std::function<std::string_view(const Spec&)> unused{};

  bool isNumeric() const { return kind == FieldKind::kNumber || kind == FieldKind::kInteger; }
  /// The legal values in words: `simplified | broyden`, `> 0`.
  std::string allowed() const {
    if (isNumeric()) return range.text();
    std::string ids;
    for (const auto& choice : kind == FieldKind::kAxis ? choices() : std::vector<Choice>{})
      ids += (ids.empty() ? "" : " | ") + choice.id;
    return kind == FieldKind::kAxis ? ids : form;
  }
  /// The value in a default Spec.
  std::string defaultText() const { return get(Spec{}); }
};

/// The field of an axis, named like the axis. `member(spec)` returns a reference to the id.
template <class Spec, class Member>
Field<Spec> axisField(const std::string& meaning, Member member) {
  using Axis = std::remove_cvref_t<decltype(member(std::declval<Spec&>()))>;
  Field<Spec> field{.name = std::string(axisName<Axis>()),
                    .meaning = meaning,
                    .kind = FieldKind::kAxis,
                    .get = [member](const Spec& spec) { return std::string(idOf(member(spec))); },
                    .set = [member](Spec& spec, std::string_view id) { member(spec) = parseId<Axis>(id); }};
  field.choices = [] {
    std::vector<Choice> choices;
    for (const auto& entry : named<Axis>()) choices.push_back({std::string(entry.id), std::string(entry.meaning)});
    return choices;
  };
  return field;
}

/// The field of a number. `member(spec)` returns a reference to a double, or to an integer if the range is one of
/// integers.
template <class Spec, class Member>
Field<Spec> numberField(const std::string& name, const std::string& meaning, const Range& range, Member member) {
  using Number = std::remove_cvref_t<decltype(member(std::declval<Spec&>()))>;
  Field<Spec> field{.name = name,
                    .meaning = meaning,
                    .range = range,
                    .number = [member](const Spec& spec) { return static_cast<double>(member(spec)); },
                    .assign = [member](Spec& spec, double x) { member(spec) = static_cast<Number>(x); }};
  if constexpr (std::is_integral_v<Number>) {
    field.kind = FieldKind::kInteger;
    field.get = [member](const Spec& spec) { return std::to_string(member(spec)); };
    field.set = [member, name, range](Spec& spec, std::string_view text) {
      member(spec) = static_cast<Number>(parseInteger(name, text, range));
    };
  } else {
    field.kind = FieldKind::kNumber;
    field.get = [member](const Spec& spec) { return numberText(member(spec)); };
    field.set = [member, name, range](Spec& spec, std::string_view text) {
      member(spec) = parseNumber(name, text, range);
    };
  }
  return field;
}

/// Makes a field of an inner struct a field of the outer struct that holds the inner one as `member`.
template <class Outer, class Inner>
Field<Outer> fieldOfMember(const Field<Inner>& inner, Inner Outer::*member) {
  Field<Outer> field{.name = inner.name,
                     .meaning = inner.meaning,
                     .kind = inner.kind,
                     .range = inner.range,
                     .form = inner.form,
                     .choices = inner.choices,
                     .get = [get = inner.get, member](const Outer& s) { return get(s.*member); },
                     .set = [set = inner.set, member](Outer& s, std::string_view text) { set(s.*member, text); }};
  if (inner.number) {
    field.number = [number = inner.number, member](const Outer& s) { return number(s.*member); };
    field.assign = [assign = inner.assign, member](Outer& s, double x) { assign(s.*member, x); };
  }
  if (inner.unused) {
    field.unused = [unused = inner.unused, member](const Outer& s) { return unused(s.*member); };
  }
  return field;
}

/// Converts to any type; used by memberCount only, never called.
struct AnyMember {
  template <class T>
  operator T() const;
};
/// The number of members of an aggregate. A table of its fields must have as many lines.
template <class Aggregate, class... Members>
consteval std::size_t memberCount() {
  if constexpr (requires { Aggregate{Members{}..., AnyMember{}}; }) {
    return memberCount<Aggregate, Members..., AnyMember>();
  } else {
    return sizeof...(Members);
  }
}

}  // namespace irk
