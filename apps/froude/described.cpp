#include "froude/described.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "froude/report.hpp"

namespace froude {
namespace {

/// A command as it is called, "bem info", with all that belongs to it.
struct DescribedCommand {
  std::string path;
  const CLI::App* app;
};

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); });
}

/// The program itself, as "", and all commands below, in the order of the help.
void list_commands(const std::string& path, const CLI::App& app, std::vector<DescribedCommand>& out) {
  out.push_back({path, &app});
  for (const CLI::App* sub : commands_of(app))
    list_commands(path.empty() ? sub->get_name() : path + ' ' + sub->get_name(), *sub, out);
}

std::vector<DescribedCommand> all_commands(const CLI::App& app) {
  std::vector<DescribedCommand> out;
  list_commands("", app, out);
  return out;
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_positional(); });
}
std::vector<const CLI::Option*> arguments_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

/// "-o", "--output"
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> out;
  for (const std::string& name : option.get_snames()) out.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) out.push_back("--" + name);
  return out;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// Of an option that is one of a few words: CLI11 tells them as "TEXT:{up,down,both}".
std::vector<std::string> words_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find('{'), shut = type.rfind('}');
  if (open == std::string::npos || shut == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 1, shut - open - 1), ',');
}

std::string replaced(const std::string& text, const std::vector<std::pair<char, std::string>>& by) {
  std::string out;
  for (const char c : text) {
    const auto at = std::find_if(by.begin(), by.end(), [&](const auto& pair) { return pair.first == c; });
    out += at == by.end() ? std::string(1, c) : at->second;
  }
  return out;
}

std::string in_quotes(const std::string& text) { return '\'' + replaced(text, {{'\'', R"('\'')"}}) + '\''; }

// ---- bash ----

/// Words that may come next in a command, quoted for its `case`.
std::string next_words(const CLI::App& app) {
  std::vector<std::string> out;
  for (const CLI::App* sub : commands_of(app)) out.push_back(sub->get_name());
  for (const CLI::Option* option : options_of(app))
    for (const std::string& name : names_of(*option)) out.push_back(name);
  return fmt::format("{}", fmt::join(out, " "));
}

std::string bash_completion(const std::vector<DescribedCommand>& commands) {
  std::string paths, words, values;
  const std::vector<const CLI::Option*> common = options_of(*commands.front().app);
  for (const auto& [path, app] : commands) {
    if (!path.empty()) paths += fmt::format("{}{}", paths.empty() ? "" : "|", in_quotes(path));
    std::string next = next_words(*app);
    if (!path.empty())
      for (const CLI::Option* option : common)
        if (const auto names = names_of(*option);
            (' ' + next + ' ').find(' ' + names.back() + ' ') == std::string::npos)
          next += ' ' + names.back();
    words += fmt::format("    {}) words={} ;;\n", in_quotes(path), in_quotes(next));
    for (const CLI::Option* option : options_of(*app)) {
      if (!takes_value(*option)) continue;
      for (const std::string& name : names_of(*option))
        values += fmt::format("    {}) of_value=1 choices={} ;;\n", in_quotes(path + ' ' + name),
                              in_quotes(fmt::format("{}", fmt::join(words_of(*option), "\n"))));
    }
  }
  return fmt::format(R"(# bash completion of froude; `froude completion bash` writes it
_froude() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command= next words= choices= of_value= word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD - 1}}"; do
    next=${{command:+$command }}$word
    case $next in
    {}) command=$next ;;
    esac
  done
  COMPREPLY=()
  case "$command $before" in
{}  esac
  if [ -n "$of_value" ]; then
    local IFS=$'\n'
    if [ -n "$choices" ]; then
      COMPREPLY=($(compgen -W "$choices" -- "$current"))
    else
      COMPREPLY=($(compgen -f -- "$current"))
      compopt -o filenames 2>/dev/null
    fi
    return
  fi
  case $command in
{}  esac
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  if [ ${{#COMPREPLY[@]}} -eq 0 ] || {{ [ -n "$command" ] && [[ $current != -* ]]; }}; then
    local IFS=$'\n'
    COMPREPLY+=($(compgen -f -- "$current"))
    compopt -o filenames 2>/dev/null
  fi
}}
complete -F _froude froude
)",
                     paths, values, words);
}

// ---- zsh ----

std::string zsh_function(const std::string& path) {
  return "_froude" + (path.empty() ? "" : replaced(' ' + path, {{' ', "_"}}));
}

/// "'(-o --output)'{-o,--output}'[result]:value:_files'"
std::string zsh_option(const CLI::Option& option) {
  const std::vector<std::string> names = names_of(option);
  const std::string told = replaced(option.get_description(), {{'[', "\\["}, {']', "\\]"}, {':', "\\:"}, {'\n', " "}});
  std::string rest = '[' + told + ']';
  const std::vector<std::string> words = words_of(option);
  if (takes_value(option))
    rest += words.empty() ? ":value:_files"
                          : fmt::format(":value:({})", replaced(fmt::format("{}", fmt::join(words, "\n")),
                                                                {{' ', "\\ "}, {'\n', " "}}));
  if (names.size() == 1) return in_quotes(names.front() + rest);
  return fmt::format("'({})'{{{}}}{}", fmt::join(names, " "), fmt::join(names, ","), in_quotes(rest));
}

std::string zsh_function_of(const DescribedCommand& command, const std::vector<const CLI::Option*>& common) {
  std::string out = fmt::format("{}() {{\n  local state line\n  _arguments -C \\\n", zsh_function(command.path));
  for (const CLI::Option* option : options_of(*command.app)) out += "    " + zsh_option(*option) + " \\\n";
  if (!command.path.empty())
    for (const CLI::Option* option : common)
      if (names_of(*option).back() != "--help") out += "    " + zsh_option(*option) + " \\\n";
  const auto below = commands_of(*command.app);
  if (below.empty()) return out + "    '*:file:_files'\n}\n";
  out += "    '1:command:->command' '*::argument:->argument'\n  case $state in\n  command)\n    local -a commands=(\n";
  std::string calls;
  for (const CLI::App* sub : below) {
    out += fmt::format("      {}\n", in_quotes(sub->get_name() + ':' + sub->get_description()));
    calls += fmt::format("    {}) {} ;;\n", sub->get_name(),
                         zsh_function(command.path.empty() ? sub->get_name() : command.path + ' ' + sub->get_name()));
  }
  return out + "    )\n    _describe command commands ;;\n  argument)\n    case $line[1] in\n" + calls +
         "    esac ;;\n  esac\n}\n";
}

std::string zsh_completion(const std::vector<DescribedCommand>& commands) {
  std::string out = "#compdef froude\n# zsh completion of froude; `froude completion zsh` writes it\n";
  const std::vector<const CLI::Option*> common = options_of(*commands.front().app);
  for (const DescribedCommand& command : commands) out += zsh_function_of(command, common);
  return out + "if [ \"$funcstack[1]\" = _froude ]; then\n  _froude \"$@\"\nelse\n  compdef _froude froude\nfi\n";
}

// ---- man ----

/// Text of roff: no word of it is a request.
std::string in_roff(const std::string& text) {
  std::string out = replaced(text, {{'\\', "\\e"}, {'-', "\\-"}, {'\n', "\n\\&"}});
  if (out.starts_with('.') || out.starts_with('\'')) out.insert(0, "\\&");
  return out;
}

std::string of_option(const CLI::Option& option) {
  const auto words = words_of(option);
  std::vector<std::string> names;
  for (const std::string& name : names_of(option)) names.push_back("\\fB" + in_roff(name) + "\\fR");
  std::string out = fmt::format(".TP\n{}", fmt::join(names, ", "));
  if (takes_value(option))
    out += " \\fI" + (words.empty() ? "VALUE" : in_roff(fmt::format("{}", fmt::join(words, " | ")))) + "\\fR";
  out += '\n' + in_roff(option.get_description());
  if (!option.get_default_str().empty()) out += in_roff("; if left out: " + option.get_default_str());
  if (option.get_required()) out += "; it must be given";
  return out + '\n';
}

std::string of_command(const DescribedCommand& command) {
  std::string out = fmt::format(".SS froude {}\n{}\n", in_roff(command.path), in_roff(command.app->get_description()));
  for (const CLI::Option* argument : arguments_of(*command.app))
    out += fmt::format(".TP\n\\fI{}\\fR\n{}\n", in_roff(argument->get_name()), in_roff(argument->get_description()));
  for (const CLI::Option* option : options_of(*command.app))
    if (names_of(*option).back() != "--help") out += of_option(*option);
  // A command without examples has those of the one above.
  if (const std::string footer = command.app->get_footer(); footer != command.app->get_parent()->get_footer())
    out += fmt::format(".PP\n.nf\n{}\n.fi\n", in_roff(footer));
  return out;
}

}  // namespace

std::string completion(const CLI::App& app, const std::string& shell) {
  const auto commands = all_commands(app);
  return shell == "zsh" ? zsh_completion(commands) : bash_completion(commands);
}

std::string manual_page(const CLI::App& app) {
  const auto commands = all_commands(app);
  std::string out = fmt::format(
      ".TH FROUDE 1 \"\" \"froude {}\"\n.SH NAME\nfroude \\- {}\n.SH SYNOPSIS\n.B froude\n[\\fIOPTIONS\\fR] "
      "\\fICOMMAND\\fR "
      "[\\fIOPTIONS OF THE COMMAND\\fR]\n.SH OPTIONS\nThey stand anywhere.\n",
      FROUDE_VERSION, in_roff(app.get_description()));
  for (const CLI::Option* option : options_of(app)) out += of_option(*option);
  out += ".SH COMMANDS\n";
  for (std::size_t i = 1; i < commands.size(); ++i) out += of_command(commands[i]);
  return out + fmt::format(".SH EXAMPLES AND EXIT STATUS\n.nf\n{}\n.fi\n", in_roff(app.get_footer()));
}

void add_described(CLI::App& app, Request& request) {
  const auto tells = [&request](const std::function<std::string()>& text) {
    return [&request, text] {
      request.call = [text](const Console& console) {
        const std::string whole = text();
        Report report;
        report.say("{}", fact("text", whole, whole.substr(0, whole.size() - 1)));  // a line has its end
        tell(report, console);
        return done;
      };
    };
  };
  auto* complete = app.add_subcommand("completion", "a script by which a shell completes commands and options");
  complete->footer(
      "Examples:\n  froude completion bash > ~/.local/share/bash-completion/completions/froude\n"
      "  froude completion zsh > ~/.zfunc/_froude");
  auto shell = std::make_shared<std::string>();
  complete->add_option("shell", *shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
  complete->callback(tells([&app, shell] { return completion(app, *shell); }));
  auto* manual = app.add_subcommand("man", "the manual page, in roff: every command with its options");
  manual->footer("Example:\n  froude man > froude.1; man -l froude.1");
  manual->callback(tells([&app] { return manual_page(app); }));
}

}  // namespace froude
