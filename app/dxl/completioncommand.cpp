// SPDX-License-Identifier: GPL-3.0-or-later
// Completion scripts, made from the one description of commands and options.
#include "app/dxl/commands.h"
#include "app/dxl/typed.h"

#include <CLI/CLI.hpp>

#include <set>

namespace dynascope::dxl {

namespace {

/// What can be typed behind `dxl`, or behind one of its commands.
struct Words {
    QString name; ///< of the command; empty: of the program itself
    QString help;
    QStringList options;
    QStringList helps; ///< of the options
    QStringList words; ///< what stands for itself: on, off...
    bool takesFields = false;
};

QString firstSentence(const std::string &help)
{
    return QString::fromStdString(help).section(QStringLiteral(". "), 0, 0).section(u'(', 0, 0).trimmed();
}

Words wordsOf(CLI::App &app)
{
    Words words;
    words.name = QString::fromStdString(app.get_name());
    words.help = firstSentence(app.get_description());
    for (const CLI::Option *option : app.get_options()) {
        for (const std::string &name : option->get_lnames()) {
            words.options << QStringLiteral("--") + QString::fromStdString(name);
            words.helps << firstSentence(option->get_description());
        }
        words.takesFields = words.takesFields || option->get_name() == "REGISTER" || option->get_name() == "FIELD"
                            || option->get_name() == "ASSIGNMENT";
    }
    const std::string &name = app.get_name();
    if (name == "torque" || name == "led")
        words.words = QStringList{QStringLiteral("on"), QStringLiteral("off")};
    else if (name == "reset")
        words.words =
            QStringList{QStringLiteral("all"), QStringLiteral("all-but-id"), QStringLiteral("all-but-id-and-baud")};
    else if (name == "clear")
        words.words = QStringList{QStringLiteral("position"), QStringLiteral("error")};
    else if (name == "backup")
        words.words = QStringList{QStringLiteral("store"), QStringLiteral("restore")};
    else if (name == "completion")
        words.words = QStringList{QStringLiteral("bash"), QStringLiteral("zsh"), QStringLiteral("fish")};
    return words;
}

QStringList fieldNames(const Catalog &catalog)
{
    std::set<QString> names;
    for (const Catalog::ModelInfo &model : catalog.models()) {
        const ControlTablePtr table = catalog.find(model.modelNumber, model.newestFirmware);
        for (const Field &field : table->fields()) {
            if (!field.name.startsWith(QLatin1String("Indirect")))
                names.insert(field.name.toLower().replace(u' ', u'_'));
        }
    }
    return {names.begin(), names.end()};
}

QStringList namesOf(const std::vector<Words> &commands)
{
    QStringList names;
    for (const Words &command : commands)
        names << command.name;
    return names;
}

QString bashScript(const Words &program, const std::vector<Words> &commands, const QStringList &fields)
{
    QString cases;
    for (const Words &command : commands) {
        cases += QStringLiteral("        %1) words=\"%2 %3\"%4 ;;\n")
                     .arg(command.name, command.options.join(u' '), command.words.join(u' '),
                          command.takesFields ? QStringLiteral(" fields=1") : QString());
    }
    return QStringLiteral(R"sh(# bash completion for dxl; made by: dxl completion bash
_dxl() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command= words= fields= word i
    COMPREPLY=()
    case $prev in
        --port)
            words="sim tcp:// rfc2217:// $(compgen -G '/dev/ttyUSB*') $(compgen -G '/dev/ttyACM*')"
            COMPREPLY=($(compgen -W "$words" -- "$cur"))
            return ;;
        --link) COMPREPLY=($(compgen -f -- "$cur")); return ;;
        --bauds) COMPREPLY=($(compgen -W "all 57600 115200 1000000 2000000 3000000 4000000" -- "$cur")); return ;;
        --baud) COMPREPLY=($(compgen -W "9600 57600 115200 1000000 2000000 3000000 4000000" -- "$cur")); return ;;
    esac
    for ((i = 1; i < COMP_CWORD; ++i)); do
        word=${COMP_WORDS[i]}
        case " %1 " in *" $word "*) command=$word; break ;; esac
    done
    case $command in
%2        *) words="%1 %3" ;;
    esac
    words="$words %3"
    if [ -n "$fields" ]; then words="$words %4"; fi
    COMPREPLY=($(compgen -W "$words" -- "$cur"))
}
complete -F _dxl dxl
)sh")
        .arg(namesOf(commands).join(u' '), cases, program.options.join(u' '), fields.join(u' '));
}

/// What stands between single quotes in zsh and fish.
QString quoted(QString text)
{
    return text.remove(u'\'').remove(u'[').remove(u']').replace(u':', u',').remove(u'`');
}

QString zshScript(const Words &program, const std::vector<Words> &commands, const QStringList &fields)
{
    QString described, cases, common;
    for (qsizetype i = 0; i < program.options.size(); ++i)
        common += QStringLiteral(" '%1:%2'").arg(program.options[i], quoted(program.helps[i]));
    for (const Words &command : commands) {
        described += QStringLiteral("        '%1:%2'\n").arg(command.name, quoted(command.help));
        QString values;
        for (qsizetype i = 0; i < command.options.size(); ++i)
            values += QStringLiteral(" '%1:%2'").arg(command.options[i], quoted(command.helps[i]));
        cases += QStringLiteral("        %1) options=(%2) values=(%3)%4 ;;\n")
                     .arg(command.name, values.trimmed(), command.words.join(u' '),
                          command.takesFields ? QStringLiteral(" fields=1") : QString());
    }
    return QStringLiteral(R"sh(#compdef dxl
# zsh completion for dxl; made by: dxl completion zsh
_dxl() {
    local -a commands options values common
    local command fields word
    commands=(
%1    )
    common=(%2)
    if [[ $words[CURRENT-1] == --port ]]; then
        compadd -- sim tcp:// rfc2217:// /dev/ttyUSB*(N) /dev/ttyACM*(N)
        return
    fi
    for word in ${words[2,CURRENT-1]}; do
        if (( ${commands[(I)$word:*]} )); then command=$word; break; fi
    done
    case $command in
%3        *) _describe command commands; _describe option common; return ;;
    esac
    _describe option options
    _describe option common
    (( $#values )) && compadd -- $values
    [[ -n $fields ]] && compadd -- %4
}
_dxl "$@"
)sh")
        .arg(described, common.trimmed(), cases, fields.join(u' '));
}

QString fishScript(const Words &program, const std::vector<Words> &commands, const QStringList &fields)
{
    QString text = QStringLiteral("# fish completion for dxl; made by: dxl completion fish\ncomplete -c dxl -f\n");
    const auto option = [&text](const QString &condition, const QString &name, const QString &help) {
        text += QStringLiteral("complete -c dxl%1 -l %2 -d '%3'\n").arg(condition, name.mid(2), quoted(help));
    };
    for (qsizetype i = 0; i < program.options.size(); ++i)
        option(QString(), program.options[i], program.helps[i]);
    text += QStringLiteral("complete -c dxl -l port -x -a 'sim tcp:// rfc2217:// (ls /dev/ttyUSB* /dev/ttyACM* "
                           "2>/dev/null)'\n");
    for (const Words &command : commands) {
        text += QStringLiteral("complete -c dxl -n __fish_use_subcommand -a %1 -d '%2'\n")
                    .arg(command.name, quoted(command.help));
        const QString inside = QStringLiteral(" -n '__fish_seen_subcommand_from %1'").arg(command.name);
        for (qsizetype i = 0; i < command.options.size(); ++i)
            option(inside, command.options[i], command.helps[i]);
        const QStringList words = command.words + (command.takesFields ? fields : QStringList());
        if (!words.isEmpty())
            text += QStringLiteral("complete -c dxl%1 -a '%2'\n").arg(inside, words.join(u' '));
    }
    return text;
}

} // namespace

ExitCode completionCommand(const Catalog &catalog, const Options &options, Output &output)
{
    CLI::App app("", "dxl");
    Typed typed;
    describe(app, typed);
    const Words program = wordsOf(app);
    std::vector<Words> commands;
    for (CLI::App *command : app.get_subcommands({}))
        commands.push_back(wordsOf(*command));
    const QStringList fields = fieldNames(catalog);
    const QString script = options.shell == u"bash"  ? bashScript(program, commands, fields)
                           : options.shell == u"zsh" ? zshScript(program, commands, fields)
                                                     : fishScript(program, commands, fields);
    output.line(script.trimmed().toUtf8());
    return ExitCode::Done;
}

} // namespace dynascope::dxl
