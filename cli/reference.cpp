// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace wellknit {

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Text of a manual page: what man would take for its own language is written out.
std::string roff(std::string text) {
  text = replaced(replaced(replaced(std::move(text), "\\", "\\e"), "-", "\\-"), "`", "\"");
  text = replaced(std::move(text), "\n", "\n.br\n");
  if (!text.empty() && (text.front() == '.' || text.front() == '\'')) text.insert(0, "\\&");
  return text;
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_positional(); });
}

std::vector<const CLI::Option*> positionals_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

/// "-o", "--output".
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> out;
  for (const std::string& name : option.get_snames()) out.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.push_back("--" + name);
  return out;
}

bool takes_value(const CLI::Option& option) { return option.get_expected_max() > 0; }

/// Words such as auto|plain|off where an option takes one of some.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string kind = option.get_type_name();
  std::vector<std::string> out{""};
  for (const char c : kind) {
    if (c == '|')
      out.emplace_back();
    else if (c >= 'a' && c <= 'z')
      out.back() += c;
    else
      out.back() += '\0';  // a placeholder such as N or FORMAT=PATH
  }
  std::erase_if(out, [](const std::string& word) { return word.empty() || word.find('\0') != std::string::npos; });
  return kind.find('|') == std::string::npos ? std::vector<std::string>{} : out;
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  return fmt::format("{}", fmt::join(words, between));
}

std::string page_name(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  return parent == nullptr ? app.get_name() : parent->get_name() + "-" + app.get_name();
}

std::string synopsis(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  std::string out = ".B " + (parent == nullptr ? app.get_name() : parent->get_name() + " " + app.get_name()) + "\n";
  for (const CLI::Option* option : positionals_of(app))
    out += ".I " + roff(option->get_required() ? option->get_name() : "[" + option->get_name() + "]") + "\n";
  return out + (commands_of(app).empty() ? ".RI [ options ]\n" : ".I command\n.RI [ options ]\n");
}

std::string option_entry(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : names_of(option)) names.push_back("\\fB" + roff(name) + "\\fR");
  std::string head = option.get_positional() ? "\\fI" + roff(option.get_name()) + "\\fR" : joined(names, ", ");
  if (takes_value(option) && !option.get_positional()) head += " \\fI" + roff(option.get_type_name()) + "\\fR";
  return ".TP\n" + head + "\n" + roff(option.get_description()) + "\n";
}

std::string see_also(const CLI::App& app) {
  std::vector<std::string> pages;
  const CLI::App* parent = app.get_parent();
  if (parent != nullptr) pages.push_back(".BR " + roff(page_name(*parent)) + " (1)");
  for (const CLI::App* command : commands_of(app)) pages.push_back(".BR " + roff(page_name(*command)) + " (1)");
  return ".SH SEE ALSO\n" + joined(pages, ",\n") + "\n";
}

std::string option_words(const CLI::App& app) {
  std::vector<std::string> words;
  for (const CLI::Option* option : options_of(app))
    for (std::string& name : names_of(*option)) words.push_back(std::move(name));
  return joined(words, " ");
}

std::string bash_script(const CLI::App& program) {
  std::string cases;
  std::string values;
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(program)) {
    names.push_back(command->get_name());
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), option_words(*command));
    for (const CLI::Option* option : options_of(*command))
      if (const auto choices = choices_of(*option); !choices.empty())
        values += fmt::format("    \"{} {}\") COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return ;;\n",
                              command->get_name(), names_of(*option).back(), joined(choices, " "));
  }
  return fmt::format(
      "# bash completion for wellknit\n_wellknit() {{\n  local word=${{COMP_WORDS[COMP_CWORD]}} "
      "before=${{COMP_WORDS[COMP_CWORD-1]}} "
      "words=\n  COMPREPLY=()\n  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    COMPREPLY=($(compgen -W \"{} {}\" -- "
      "\"$word\"))\n    return\n  fi\n  case \"${{COMP_WORDS[1]}} $before\" in\n{}  esac\n  case "
      "\"${{COMP_WORDS[1]}}\" "
      "in\n{}  esac\n  case \"$word\" in\n    -*) COMPREPLY=($(compgen -W \"$words\" -- \"$word\")) ;;\n  esac\n}}\n"
      "complete -o default -F _wellknit wellknit\n",
      joined(names, " "), option_words(program), values, cases);
}

std::string zsh_quoted(const std::string& text) {
  return replaced(replaced(replaced(replaced(text, "'", "'\\''"), "[", "("), "]", ")"), ":", "\\:");
}

std::string zsh_script(const CLI::App& program) {
  std::string commands;
  std::string cases;
  for (const CLI::App* command : commands_of(program)) {
    commands += fmt::format("    '{}:{}'\n", command->get_name(), zsh_quoted(command->get_description()));
    cases += fmt::format("    {})\n      _arguments \\\n", command->get_name());
    for (const CLI::Option* option : options_of(*command)) {
      const auto choices = choices_of(*option);
      const std::string value = !takes_value(*option) ? ""
                                : choices.empty()     ? ":value:_files"
                                                      : fmt::format(":value:({})", joined(choices, " "));
      for (const std::string& name : names_of(*option))
        cases += fmt::format("        '*{}[{}]{}' \\\n", name, zsh_quoted(option->get_description()), value);
    }
    cases += "        '*:file:_files'\n      ;;\n";
  }
  return "#compdef wellknit\n_wellknit() {\n  local -a commands\n  commands=(\n" + commands +
         "  )\n  if (( CURRENT == 2 )); then\n    _describe 'command' commands\n    return\n  fi\n  local "
         "command=$words[2]\n"
         "  shift words\n  (( CURRENT-- ))\n  case $command in\n" +
         cases + "  esac\n}\n_wellknit \"$@\"\n";
}

std::string fish_quoted(const std::string& text) { return replaced(replaced(text, "\\", "\\\\"), "'", "\\'"); }

std::string fish_script(const CLI::App& program) {
  std::string out = "# fish completion for wellknit\n";
  for (const CLI::App* command : commands_of(program))
    out += fmt::format("complete -c wellknit -n __fish_use_subcommand -f -a {} -d '{}'\n", command->get_name(),
                       fish_quoted(command->get_description()));
  for (const CLI::App* command : commands_of(program))
    for (const CLI::Option* option : options_of(*command)) {
      out += fmt::format("complete -c wellknit -n '__fish_seen_subcommand_from {}'", command->get_name());
      for (const std::string& name : option->get_snames()) out += " -s " + name;
      for (const std::string& name : option->get_lnames()) out += " -l " + name;
      if (const auto choices = choices_of(*option); !choices.empty())
        out += fmt::format(" -x -a '{}'", joined(choices, " "));
      else if (takes_value(*option))
        out += " -r";
      out += fmt::format(" -d '{}'\n", fish_quoted(option->get_description()));
    }
  return out;
}

}  // namespace

std::string manual_page(const CLI::App& app, const std::string& version) {
  const std::string name = page_name(app);
  std::string title = name;
  std::ranges::transform(title, title.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; });
  std::string out = fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
                                roff(title), roff(version), roff(name), roff(app.get_description()));
  out += synopsis(app);
  const auto commands = commands_of(app);
  if (!commands.empty()) {
    out += ".SH COMMANDS\n";
    for (const CLI::App* command : commands)
      out += ".TP\n.B " + roff(command->get_name()) + "\n" + roff(command->get_description()) + "\n";
  }
  out += ".SH OPTIONS\n";
  for (const CLI::Option* option : positionals_of(app)) out += option_entry(*option);
  for (const CLI::Option* option : options_of(app)) out += option_entry(*option);
  if (!app.get_footer().empty()) out += ".SH NOTES\n" + roff(app.get_footer()) + "\n";
  out +=
      ".SH EXIT STATUS\n.TP\n.B 0\nDone.\n.TP\n.B 1\nSomething is wrong with the data.\n.TP\n.B 2\nSomething is wrong "
      "with the command line.\n";
  return out + see_also(app);
}

std::string completion_script(const CLI::App& program, const std::string& shell) {
  if (shell == "bash") return bash_script(program);
  if (shell == "zsh") return zsh_script(program);
  if (shell == "fish") return fish_script(program);
  return "";
}

}  // namespace wellknit
