#include "libdsc/cli/completion.h"

#include "libdsc/voxels/shape_spec.h"

#include <algorithm>
#include <vector>

namespace dsc::cli {
namespace {

using Strings = std::vector<std::string>;

Strings names(const CLI::Option& option) {
  Strings all;
  for (const std::string& name : option.get_snames()) all.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) all.push_back("--" + name);
  return all;
}

/// The words of a type name like a|b|c; empty for another.
Strings choices(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type.find('|') == std::string::npos) return {};
  return CLI::detail::split(type, '|');
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }
bool takes_file(const CLI::Option& option) {
  return option.get_type_name() == "FILE" || option.get_positional();
}

std::string joined(const Strings& words, const char* between = " ") {
  return CLI::detail::join(words, between);
}

/// The shapes that INPUT has after shape:, by name.
Strings shapes() {
  Strings all;
  for (const std::string& line : known_shapes()) {
    all.push_back(line.substr(0, line.find_first_of(" ,:=")));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// What zsh must not read inside '…[…]' of a specification.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_action(const CLI::Option& option) {
  const Strings words = choices(option);
  if (!words.empty()) return "(" + joined(words) + ")";
  return takes_file(option) ? "_files" : " ";
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string text =
      "# bash completion of dsc; made by dsc --completion bash\n"
      "_dsc() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} "
      "command=${COMP_WORDS[1]}\n"
      "  COMPREPLY=()\n"
      // A colon parts words: what comes after it is completed alone.
      "  if [[ ${COMP_LINE:0:COMP_POINT} =~ shape:([a-z]*)$ ]]; then\n    COMPREPLY=($(compgen -W "
      "'" +
      joined(shapes()) + "' -- \"${BASH_REMATCH[1]}\"))\n    return\n  fi\n";
  Strings commands;
  for (const CLI::App* sub : app.get_subcommands({})) commands.push_back(sub->get_name());
  Strings top;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : names(*option)) top.push_back(name);
  }
  text += "  if ((COMP_CWORD == 1)); then\n    COMPREPLY=($(compgen -W '" + joined(commands) + " " +
          joined(top) + "' -- \"$word\"))\n    return\n  fi\n";
  text += "  case $command:$before in\n";
  for (const CLI::App* sub : app.get_subcommands({})) {
    for (const CLI::Option* option : sub->get_options()) {
      if (!takes_value(*option)) continue;
      Strings keys;
      for (const std::string& name : names(*option)) keys.push_back(sub->get_name() + ":" + name);
      if (keys.empty()) continue;
      const Strings words = choices(*option);
      std::string action = ":";  // a number or a text: nothing to offer
      if (!words.empty()) {
        action = "COMPREPLY=($(compgen -W '" + joined(words) + "' -- \"$word\"))";
      } else if (takes_file(*option)) {
        action = "COMPREPLY=($(compgen -f -- \"$word\"))";
      }
      text += "    " + joined(keys, " | ") + ") " + action + "; return ;;\n";
    }
  }
  text += "  esac\n  case $command in\n";
  for (const CLI::App* sub : app.get_subcommands({})) {
    Strings all;
    for (const CLI::Option* option : sub->get_options()) {
      for (const std::string& name : names(*option)) all.push_back(name);
    }
    text += "    " + sub->get_name() + ") set -- " + joined(all) + " ;;\n";
  }
  text +=
      "    *) set -- ;;\n  esac\n"
      "  if [[ $word == -* ]]; then\n    COMPREPLY=($(compgen -W \"$*\" -- \"$word\"))\n"
      "  else\n    COMPREPLY=($(compgen -f -- \"$word\") $(compgen -W 'shape:' -- \"$word\"))\n  "
      "fi\n}\n"
      "complete -o filenames -F _dsc dsc\n";
  return text;
}

std::string zsh_completion(const CLI::App& app) {
  std::string text =
      "#compdef dsc\n# zsh completion of dsc; made by dsc --completion zsh\n"
      "_dsc() {\n  if ((CURRENT == 2)); then\n    local -a commands=(\n";
  for (const CLI::App* sub : app.get_subcommands({})) {
    text += "      '" + sub->get_name() + ":" + zsh_text(sub->get_description()) + "'\n";
  }
  text += "    )\n    _describe command commands\n    return\n  fi\n  local command=$words[2]\n";
  text += "  shift words\n  ((CURRENT--))\n  case $command in\n";
  for (const CLI::App* sub : app.get_subcommands({})) {
    text += "    " + sub->get_name() + ")\n      _arguments \\\n";
    for (const CLI::Option* option : sub->get_options()) {
      for (const std::string& name : names(*option)) {
        text += "        '*" + name + "[" + zsh_text(option->get_description()) + "]";
        if (takes_value(*option)) {
          text += ":" + zsh_text(option->get_type_name()) + ":" + zsh_action(*option);
        }
        text += "' \\\n";
      }
    }
    text +=
        "        '1:input:{_files; compadd -P shape\\: -- " + joined(shapes()) + "}'\n      ;;\n";
  }
  text += "  esac\n}\n_dsc \"$@\"\n";
  return text;
}

}  // namespace dsc::cli
