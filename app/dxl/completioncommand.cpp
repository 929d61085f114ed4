// SPDX-License-Identifier: GPL-3.0-or-later
// Completion scripts for the shells.
#include "app/dxl/commands.h"
#include "app/dxl/completionwords.h"

namespace dynascope::dxl {

namespace {

QStringList valuedNames(const Completions &all)
{
    QStringList names;
    for (const ValuedOption &option : all.valued)
        names << option.name;
    return names;
}

QString bashScript(const Completions &all)
{
    QString commands, values;
    for (const Words &command : all.commands) {
        QString more;
        if (command.fields == Words::Fields::Names)
            more += QStringLiteral(" fields=1");
        else if (command.fields == Words::Fields::Assignments)
            more += QStringLiteral(" fields=1 suffix==");
        if (command.takesFiles)
            more += QStringLiteral(" files=1");
        commands += QStringLiteral("        %1) words=\"%2\"%3 ;;\n")
                        .arg(command.name, (command.options + command.words).join(u' '), more);
    }
    for (const ValuedOption &option : all.valued) {
        values += QStringLiteral("        %1) words=\"%2\"%3 ;;\n")
                      .arg(option.name, option.values.join(u' '),
                           option.takesFiles ? QStringLiteral(" files=1") : QString());
    }
    return QStringLiteral(R"sh(# bash completion for dxl; made by: dxl completion bash
_dxl() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev= command= words= fields= suffix= files= word i
    COMPREPLY=()
    if [ "$COMP_CWORD" -gt 0 ]; then prev=${COMP_WORDS[COMP_CWORD-1]}; fi
    if [ "$prev" = = ]; then prev=${COMP_WORDS[COMP_CWORD-2]}; fi
    case $prev in
%2        *) prev= ;;
    esac
    if [ -z "$prev" ]; then
        for ((i = 1; i < COMP_CWORD; ++i)); do
            word=${COMP_WORDS[i]}
            case $word in %3) ((++i)); continue ;; esac
            case " %1 " in *" $word "*) command=$word; break ;; esac
        done
        case $command in
%4            *) words="%1" ;;
        esac
        words="$words %5"
    elif [ "$prev" = --port ]; then
        words="$words $(compgen -G '/dev/ttyUSB*') $(compgen -G '/dev/ttyACM*')"
    fi
    COMPREPLY=($(compgen -W "$words" -- "$cur"))
    if [ -n "$fields" ]; then
        COMPREPLY+=($(compgen -W "%6" -S "$suffix" -- "$cur"))
        if [ -n "$suffix" ]; then compopt -o nospace 2>/dev/null; fi
    fi
    if [ -n "$files" ]; then
        COMPREPLY+=($(compgen -f -- "$cur"))
        compopt -o filenames 2>/dev/null
    fi
    return 0
}
complete -F _dxl dxl
)sh")
        .arg(all.names().join(u' '), values, valuedNames(all).join(u'|'), commands, all.program.options.join(u' '),
             all.fields.join(u' '));
}

/// For zsh, between single quotes; behind the first colon it may stand as it is.
QString zshQuoted(QString text)
{
    return text.replace(u'\'', QStringLiteral("'\\''"));
}

QString zshOptions(const Words &words)
{
    QString text;
    for (qsizetype i = 0; i < words.options.size(); ++i)
        text += QStringLiteral(" '%1:%2'").arg(words.options[i], zshQuoted(words.helps[i]));
    return text.trimmed();
}

QString zshScript(const Completions &all)
{
    QString described, cases, values;
    for (const Words &command : all.commands) {
        described += QStringLiteral("        '%1:%2'\n").arg(command.name, zshQuoted(command.help));
        QString more;
        if (command.fields == Words::Fields::Names)
            more = QStringLiteral(" fields=names");
        else if (command.fields == Words::Fields::Assignments)
            more = QStringLiteral(" fields=assignments");
        if (command.takesFiles)
            more += QStringLiteral(" files=1");
        cases += QStringLiteral("        %1) options=(%2) values=(%3)%4 ;;\n")
                     .arg(command.name, zshOptions(command), command.words.join(u' '), more);
    }
    for (const ValuedOption &option : all.valued) {
        QString offered;
        if (!option.values.isEmpty())
            offered += QStringLiteral(" compadd -- %1;").arg(option.values.join(u' '));
        if (option.name == u"--port")
            offered += QStringLiteral(" compadd -- /dev/ttyUSB*(N) /dev/ttyACM*(N);");
        if (option.takesFiles)
            offered += QStringLiteral(" _files;");
        values += QStringLiteral("        %1)%2 return ;;\n").arg(option.name, offered);
    }
    return QStringLiteral(R"sh(#compdef dxl
# zsh completion for dxl; made by: dxl completion zsh
_dxl() {
    local -a commands options values common fieldnames
    local command fields files
    local -i i
    commands=(
%1    )
    common=(%2)
    fieldnames=(%3)
    case $words[CURRENT-1] in
%4    esac
    for (( i = 2; i < CURRENT; ++i )); do
        case $words[i] in
            %5) (( ++i )); continue ;;
        esac
        if (( ${commands[(I)$words[i]:*]} )); then command=$words[i]; break; fi
    done
    case $command in
%6        *) _describe command commands; _describe option common; return ;;
    esac
    _describe option options
    _describe option common
    (( $#values )) && compadd -- $values
    [[ $fields == names ]] && compadd -- $fieldnames
    [[ $fields == assignments ]] && compadd -S = -- $fieldnames
    [[ -n $files ]] && _files
}
_dxl "$@"
)sh")
        .arg(described, zshOptions(all.program), all.fields.join(u' '), values, valuedNames(all).join(u'|'), cases);
}

/// For fish, between single quotes.
QString fishQuoted(QString text)
{
    return text.replace(u'\\', QStringLiteral("\\\\")).replace(u'\'', QStringLiteral("\\'"));
}

/// One option of a command, or of the program where `condition` is empty.
QString fishOption(const Completions &all, const QString &condition, const QString &name, const QString &help)
{
    QString text = QStringLiteral("complete -c dxl%1 -l %2 -d '%3'").arg(condition, name.mid(2), fishQuoted(help));
    for (const ValuedOption &option : all.valued) {
        if (option.name != name)
            continue;
        text += option.takesFiles ? QStringLiteral(" -r -F") : QStringLiteral(" -x");
        QString values = option.values.join(u' ');
        if (name == u"--port")
            values += QStringLiteral(" (for p in /dev/ttyUSB* /dev/ttyACM*; echo $p; end)");
        if (!values.isEmpty())
            text += QStringLiteral(" -a '%1'").arg(values);
    }
    return text + u'\n';
}

QString fishScript(const Completions &all)
{
    QString text = QStringLiteral(R"sh(# fish completion for dxl; made by: dxl completion fish
function __dxl_command
    set -l words (commandline -opc)[2..-1]
    while set -q words[1]
        switch $words[1]
            case %1
                set words $words[3..-1]
            case '-*'
                set words $words[2..-1]
            case '*'
                echo $words[1]
                return
        end
    end
end
function __dxl_in
    set -l command (__dxl_command)
    test "$command" = "$argv[1]"
end
complete -c dxl -f
)sh").arg(valuedNames(all).join(u' '));
    for (qsizetype i = 0; i < all.program.options.size(); ++i)
        text += fishOption(all, QString(), all.program.options[i], all.program.helps[i]);
    for (const Words &command : all.commands) {
        text += QStringLiteral("complete -c dxl -n '__dxl_in \"\"' -a %1 -d '%2'\n")
                    .arg(command.name, fishQuoted(command.help));
        const QString inside = QStringLiteral(" -n '__dxl_in %1'").arg(command.name);
        for (qsizetype i = 0; i < command.options.size(); ++i)
            text += fishOption(all, inside, command.options[i], command.helps[i]);
        QStringList words = command.words;
        for (const QString &field : all.fields) {
            if (command.fields != Words::Fields::None)
                words << (command.fields == Words::Fields::Assignments ? field + u'=' : field);
        }
        if (!words.isEmpty())
            text += QStringLiteral("complete -c dxl%1 -a '%2'\n").arg(inside, words.join(u' '));
        if (command.takesFiles)
            text += QStringLiteral("complete -c dxl%1 -F\n").arg(inside);
    }
    return text;
}

} // namespace

ExitCode completionCommand(const Catalog &catalog, const Options &options, Output &output)
{
    const Completions all = completionsOf(catalog);
    const QString script = options.shell == u"bash"  ? bashScript(all)
                           : options.shell == u"zsh" ? zshScript(all)
                                                     : fishScript(all);
    output.line(script.trimmed().toUtf8());
    return ExitCode::Done;
}

} // namespace dynascope::dxl
