// Named options of a profile: policies where a manual is silent or leaves the choice to the machine. An option that is
// in no table is an error, so a misspelt one cannot be ignored. Those that any control may set stand in options.cpp;
// those of one language in dialects/<language>/options.h.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/text.h"
#include "machine/profile.h"

namespace cnctrans::machine {

/// An option and where its value goes: a field of Fields.
template <class Fields>
struct OptionRow {
  std::string_view name;
  std::string_view values;    ///< allowed values parted by '|'; "number": a decimal number; "text": anything
  std::string_view fallback;  ///< what holds when a profile does not say
  /// Puts the value, which is number `at` of `values`, into its field; null: a field of a language's own.
  void (*put)(Fields& out, std::string_view value, std::size_t at);
  std::string_view meaning;
};
using OptionSpec = OptionRow<Policies>;

template <auto Field>
struct FieldOf;
template <class Fields, class T, T Fields::*Field>
struct FieldOf<Field> {
  using Type = Fields;
};
/// Puts a text, a number, or an enum or bool whose values stand in the order of the row.
template <auto Field, class Fields>
void put_option(Fields& out, std::string_view value, std::size_t at) {
  using T = std::remove_reference_t<decltype(out.*Field)>;
  if constexpr (std::is_same_v<T, std::string>) {
    out.*Field = value;
  } else if constexpr (std::is_same_v<T, double>) {
    out.*Field = parse_decimal(value).value_or(0);
  } else {
    out.*Field = static_cast<T>(at);
  }
}

/// The row of a field.
template <auto Field>
constexpr auto option(std::string_view name, std::string_view values, std::string_view fallback,
                      std::string_view meaning) {
  using Fields = typename FieldOf<Field>::Type;
  return OptionRow<Fields>{name, values, fallback, &put_option<Field, Fields>, meaning};
}

/// Which of the values, parted by '|', it is.
std::optional<std::size_t> value_number(std::string_view value, std::string_view values);

/// The rows of a language's own fields as rows of a table, which checks their values and keeps their text.
template <class Fields, std::size_t N>
constexpr std::array<OptionSpec, N> specs_of(const std::array<OptionRow<Fields>, N>& rows) {
  std::array<OptionSpec, N> out{};
  for (std::size_t i = 0; i < N; ++i)
    out[i] = {rows[i].name, rows[i].values, rows[i].fallback, nullptr, rows[i].meaning};
  return out;
}

/// A language's own fields as the profile sets them.
template <class Fields, std::size_t N>
Fields read_options(const Profile& profile, const std::array<OptionRow<Fields>, N>& rows) {
  Fields out;
  for (const auto& row : rows) {
    const auto it = profile.options.find(row.name);
    if (it != profile.options.end()) row.put(out, it->second, value_number(it->second, row.values).value_or(0));
  }
  return out;
}

/// The options that any control may set.
std::span<const OptionSpec> common_options();

/// Every option that a profile may set.
class OptionTable {
 public:
  /// The common options and those of each language, whose names begin with its own ("num.m30").
  explicit OptionTable(const std::vector<std::span<const OptionSpec>>& languages);

  [[nodiscard]] std::span<const OptionSpec> rows() const { return rows_; }
  [[nodiscard]] const OptionSpec* find(std::string_view name) const;
  /// False, and a sentence in `error`, when the option does not exist or does not take the value.
  bool check(std::string_view name, std::string_view value, std::string* error) const;
  /// Sets it, as text and as its field of Policies. False, with the profile as it was, where check() says no.
  bool set(Profile& profile, std::string_view name, std::string_view value, std::string* error) const;
  /// Puts what holds when the profile does not say into the fields that options of its language set.
  void begin(Profile& profile) const;

 private:
  std::vector<OptionSpec> rows_;
};

}  // namespace cnctrans::machine
