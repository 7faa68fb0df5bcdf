// dsc(1). In roff a line that begins with a dot or an apostrophe is a request, a backslash begins
// an escape, and a hyphen may be broken or curled: all of them are written as escapes.
#include "libdsc/cli/completion.h"
#include "libdsc/cli/help.h"

#include <sstream>

namespace dsc::cli {
namespace {

std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool line_begins = result.empty() || result.back() == '\n';
    if (line_begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else if (c == '^') {
      result += "\\(ha";
    } else if (c == '~') {
      result += "\\(ti";
    } else {
      result += c;
    }
  }
  return result;
}

std::string as_it_stands(const std::string& text) { return ".nf\n" + roff(text) + "\n.fi\n"; }

std::string entry(const CLI::Option& option) {
  std::string names;
  const auto add = [&](const std::string& name) {
    names += (names.empty() ? "" : ", ") + ("\\fB" + roff(name) + "\\fR");
  };
  for (const std::string& name : option.get_snames()) add("-" + name);
  for (const std::string& name : option.get_lnames()) add("--" + name);
  if (option.get_positional()) add(option.get_name(true));
  if (option.get_items_expected_max() > 0 && !option.get_type_name().empty()) {
    names += " \\fI" + roff(option.get_type_name()) + "\\fR";
  }
  return ".TP\n" + names + "\n" + roff(option.get_description()) +
         (option.get_required() ? " Required." : "") + "\n";
}

}  // namespace

std::string manual_page(const CLI::App& app) {
  std::string text =
      std::string(".TH DSC 1 \"\" \"dsc ") + DSC_VERSION +
      "\" \"User Commands\"\n.SH NAME\ndsc \\- discrete differential calculus on "
      "digital surfaces\n.SH SYNOPSIS\n.B dsc\n.I COMMAND INPUT\n[\\fIOPTION\\fR ...]\n"
      ".SH DESCRIPTION\n";
  text += roff(app.get_description()) + "\n";
  for (const CLI::Option* option : app.get_options()) text += entry(*option);
  for (const CLI::App* sub : app.get_subcommands({})) {
    text += ".SH \"dsc " + sub->get_name() + "\"\n" +
            roff(sub->get_description()) + "\n";
    std::string group;
    for (const CLI::Option* option : sub->get_options()) {
      if (option == sub->get_help_ptr()) continue;
      if (option->get_group() != group && !option->get_positional()) {
        group = option->get_group();
        text += ".SS " + roff(group) + "\n";
      }
      text += entry(*option);
    }
    text += ".PP\n" + as_it_stands(sub->get_footer());
  }
  text += ".SH NOTES\n" + as_it_stands(app.get_footer());
  return text;
}

}  // namespace dsc::cli
