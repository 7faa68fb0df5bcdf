/// \file
/// The kinds of options that `dsc` has beside CLI11's own. Their messages name the option and what
/// it takes.
#pragma once

#include "libdsc/base/error.h"
#include "libdsc/cli/numbers.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dsc::cli {

/// Words and what they stand for, the default first.
template <class Value>
using Words = std::vector<std::pair<std::string, Value>>;

/// One of a few words.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& target,
                        const Words<std::type_identity_t<Value>>& words, const std::string& help) {
  std::string list;
  for (const auto& [word, value] : words) list += (list.empty() ? "" : "|") + word;
  const auto read = [&target, words, name, list](const std::string& given) {
    for (const auto& [word, value] : words) {
      if (word == given) {
        target = value;
        return;
      }
    }
    throw UsageError(name + " " + given + ": expected " + list);
  };
  return app.add_option_function<std::string>(name, read, help)->type_name(list);
}

/// A finite number.
inline CLI::Option* add_number(CLI::App& app, const std::string& name,
                               std::optional<double>& target, const std::string& help) {
  const auto read = [&target, name](const std::string& text) {
    const std::vector<double> numbers = parse_numbers(text, name);
    if (numbers.size() != 1) throw UsageError(name + " " + text + ": expected one number");
    target = numbers[0];
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("NUMBER");
}

/// A positive finite number.
template <class Target>
CLI::Option* add_positive(CLI::App& app, const std::string& name, Target& target,
                          const std::string& help) {
  const auto read = [&target, name](const std::string& text) {
    const std::vector<double> numbers = parse_numbers(text, name);
    if (numbers.size() != 1) throw UsageError(name + " " + text + ": expected one number");
    if (!(numbers[0] > 0)) throw UsageError(name + " " + text + ": must be positive");
    target = numbers[0];
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("NUMBER");
}

/// Puts the options that are in no group yet under a heading of the help text.
inline void name_group(CLI::App& app, const std::string& heading) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_group() == "Options" && option != app.get_help_ptr()) option->group(heading);
  }
}

}  // namespace dsc::cli
