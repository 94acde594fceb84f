#include "cli/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "slipface/base/markdown.h"

namespace slipface::cli {
namespace {

std::vector<const CLI::App*> listed_verbs(const CLI::App& app) {
    return app.get_subcommands(
        [](const CLI::App* verb) { return !verb->get_name().empty() && !verb->get_group().empty(); });
}

std::vector<const CLI::Option*> listed_options(const CLI::App& verb) {
    const auto listed = [](const CLI::Option* option) { return !option->get_group().empty(); };
    std::vector<const CLI::Option*> options = verb.get_options(listed);
    // CLI11 stores a group of options as a subcommand without a name.
    for (const CLI::App* group :
         verb.get_subcommands([](const CLI::App* part) { return part->get_name().empty(); }))
        for (const CLI::Option* option : group->get_options(listed))
            options.push_back(option);
    return options;
}

// Escapes text so that troff shows it unchanged.
std::string plain(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '\\')
            escaped += "\\e";
        else if (c == '-')
            escaped += "\\-";
        else if (c == '\n')
            escaped += "\n.br\n";
        else if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n'))
            escaped += {'\\', '&', c};
        else
            escaped += c;
    }
    return escaped;
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return 'a' <= c && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    return text;
}

bool takes_value(const CLI::Option& option) {
    return option.get_items_expected_max() > 0;
}

// "-h, --help".
std::string option_names(const CLI::Option& option) {
    std::string names = option.get_name(false, true);
    if (const auto comma = names.find(','); comma != std::string::npos) names.insert(comma + 1, " ");
    return names;
}

// "LEVEL", "[LEVEL]", "LEVEL...".
std::string positional(const CLI::Option& option) {
    std::string name = upper(option.get_name(true));
    if (option.get_items_expected_max() > 1) name += "...";
    return option.get_required() ? name : "[" + name + "]";
}

std::string synopsis(const CLI::App& verb, const std::string& command) {
    std::string line = ".B " + plain(command) + "\n";
    for (const CLI::Option* option : listed_options(verb))
        if (option->get_positional()) line += plain(positional(*option)) + "\n";
    return line + "[options]\n";
}

std::string options(const CLI::App& verb) {
    std::string text;
    for (const CLI::Option* option : listed_options(verb)) {
        text += ".TP\n";
        if (option->get_positional()) {
            text += ".I " + plain(upper(option->get_name(true))) + "\n";
        } else {
            text += "\\fB" + plain(option_names(*option)) + "\\fR";
            if (takes_value(*option)) text += " \\fI" + plain(option->get_type_name()) + "\\fR";
            text += "\n";
        }
        text += plain(option->get_description());
        if (!option->get_default_str().empty())
            text += " (default: " + plain(option->get_default_str()) + ")";
        text += "\n";
    }
    return text;
}

std::string heading(const std::string& name, const std::string& version, const std::string& summary) {
    return fmt::format(".TH {} 1 \"\" \"slipface {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n",
                       upper(plain(name)), version, plain(name), plain(summary));
}

std::string verb_page(const CLI::App& verb, const std::string& version) {
    const std::string command = "slipface " + verb.get_name();
    std::string text = heading("slipface-" + verb.get_name(), version, verb.get_description());
    text += ".SH SYNOPSIS\n" + synopsis(verb, command) + ".SH OPTIONS\n" + options(verb);
    for (const CLI::App* part : listed_verbs(verb))
        text += ".SH " + plain(upper(command + " " + part->get_name())) + "\n" +
                plain(part->get_description()) + ".\n.PP\n" +
                synopsis(*part, command + " " + part->get_name()) + options(*part);
    return text + ".SH SEE ALSO\n.BR slipface (1)\n";
}

std::string program_page(const CLI::App& app, const std::string& version) {
    std::string description = app.get_description();
    if (const auto colon = description.find(": "); colon != std::string::npos)
        description.erase(0, colon + 2);
    std::string text = heading("slipface", version, description);
    text += ".SH SYNOPSIS\n" + synopsis(app, "slipface") + ".br\n.B slipface\n.I VERB\n[options]\n";
    text += ".SH DESCRIPTION\nWithout a verb the editor opens, with\n.I LEVEL\nif one is named.\n";
    text += ".SH OPTIONS\n" + options(app) + ".SH VERBS\n";
    for (const CLI::App* verb : listed_verbs(app))
        text += ".TP\n.BR " + plain("slipface-" + verb->get_name()) + " (1)\n" +
                plain(verb->get_description()) + "\n";
    return text + ".SH NOTES\n" + plain(app.get_footer()) + "\n";
}

// "--out FILE", "LEVEL...".
std::string shown_name(const CLI::Option& option) {
    if (option.get_positional()) return positional(option);
    const std::string names = option_names(option);
    return takes_value(option) ? names + " " + option.get_type_name() : names;
}

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string markdown_of(const CLI::App& verb, const std::string& command) {
    std::string usage = command;
    for (const CLI::Option* option : listed_options(verb))
        if (option->get_positional()) usage += " " + positional(*option);
    const bool alone = listed_verbs(verb).empty();
    std::string text = fmt::format("\n## {}\n\n{}.\n\n    {}{}\n", command, verb.get_description(), usage,
                                   alone ? " [options]" : "");
    std::string rows;
    for (const CLI::Option* option : listed_options(verb)) {
        if (option->get_name(false, true) == "-h,--help") continue;
        std::string what = one_line(option->get_description());
        if (!option->get_default_str().empty())
            what += fmt::format(" (default: `{}`)", option->get_default_str());
        rows += markdown_row({markdown_code(shown_name(*option).c_str()), what});
    }
    if (!rows.empty()) text += "\n| Option | What it does |\n| --- | --- |\n" + rows;
    for (const CLI::App* part : listed_verbs(verb))
        text += markdown_of(*part, command + " " + part->get_name());
    return text;
}

// One row of the completion's tables per verb: the words that lead to it, and the words that can follow.
void completion_rows(const CLI::App& verb, const std::string& path, std::string& paths, std::string& follow) {
    std::string words;
    for (const CLI::App* part : listed_verbs(verb)) {
        words += part->get_name() + " ";
        const std::string below = path + "/" + part->get_name();
        paths += (paths.empty() ? "" : "|") + below;
        completion_rows(*part, below, paths, follow);
    }
    for (const CLI::Option* option : listed_options(verb))
        for (const std::string& name : option->get_lnames())
            words += "--" + name + " ";
    if (!words.empty()) words.pop_back();
    follow += fmt::format("        \"{}\") words=\"{}\" ;;\n", path, words);
}

}  // namespace

std::vector<ManualPage> manual_pages(const CLI::App& app, const std::string& version) {
    std::vector<ManualPage> pages{{"slipface.1", program_page(app, version)}};
    for (const CLI::App* verb : listed_verbs(app))
        pages.push_back({"slipface-" + verb->get_name() + ".1", verb_page(*verb, version)});
    return pages;
}

std::string command_line_markdown(const CLI::App& app) {
    std::string text =
        "# The command line\n\n"
        "**What it is.** Every verb of the program with its options, from what it reads.\n\n"
        "**How you use it.** `slipface VERB --help` prints the same.\n\n"
        "**What it costs.** No display and no network; each verb says what it writes.\n\n"
        "| Verb | What it does |\n| --- | --- |\n";
    for (const CLI::App* verb : listed_verbs(app))
        text +=
            markdown_row({fmt::format("[`{0}`](#slipface-{0})", verb->get_name()), verb->get_description()});
    text += "\n" + app.get_footer() + "\n";
    for (const CLI::App* verb : listed_verbs(app))
        text += markdown_of(*verb, "slipface " + verb->get_name());
    return text;
}

std::string bash_completion(const CLI::App& app) {
    std::string paths, follow;
    completion_rows(app, "", paths, follow);
    return fmt::format(R"(# Completion of slipface for bash, made by: slipface docs --completion FILE
_slipface() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} path= word words=
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case "$path/$word" in
            {}) path+=/$word ;;
        esac
    done
    case "$path" in
{}    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current"; [[ $current == -* ]] || compgen -f -- "$current")
    compopt -o filenames 2>/dev/null
}}
complete -F _slipface slipface
)",
                       paths, follow);
}

}  // namespace slipface::cli
