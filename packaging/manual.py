#!/usr/bin/env python3
"""Manual pages and completions of the program, made from its own --help and from docs/cli.md.

manual.py --dotek PROGRAM --cli docs/cli.md --out SHARE [--epoch SECONDS]

Writes SHARE/man/man1/*.1.gz, SHARE/bash-completion/completions/dotek, SHARE/zsh/vendor-completions/_dotek and
SHARE/fish/vendor_completions.d/dotek.fish. The same program and the same docs give the same bytes.
"""
import argparse
import datetime
import gzip
import os
import re
import subprocess
import sys

# What `dotek list` knows of the values of a flag or of an argument.
TABLES = {"--control": "controls", "--from-control": "controls", "--probe-macros": "macros", "--form": "forms", "--to": "targets",
          "--assume": "assumptions"}
FILES = re.compile(r"FILE|OUT|\.(txt|toml|cps|html|js|json|md|nc|cycle)\b|^PROG")
FOLDERS = re.compile(r"^(DIR|SITE|FOLDER)$")


class Flag:
    def __init__(self, names, value, text):
        self.names, self.value, self.text = names, value, text
        braces = re.search(r"\{(.*)\}", value)
        self.choices = braces.group(1).split(",") if braces else []
        if not self.choices and re.fullmatch(r"[a-z0-9]+(\|[a-z0-9]+)+", value):
            self.choices = value.split("|")

    def kind(self):
        """What completes its value: choices, a table, files, folders, nothing; None where it has no value."""
        if not self.value:
            return None
        if self.choices:
            return ("choices", self.choices)
        for name in self.names:
            if name in TABLES:
                return ("table", TABLES[name])
            if name in ("--select", "--ignore"):
                return ("codes",)
        if FOLDERS.search(self.value):
            return ("folders",)
        return ("files",) if FILES.search(self.value) else ("nothing",)


class Command:
    def __init__(self, name, about, usage):
        self.name, self.about, self.usage = name, about, usage
        self.positionals, self.flags, self.subcommands = [], [], []


def run(program, *arguments):
    env = dict(os.environ, LC_ALL="C.UTF-8", NO_COLOR="1")
    done = subprocess.run([program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=env)
    if done.returncode != 0:
        sys.exit(f"manual.py: {' '.join([program, *arguments])} ended with {done.returncode}")
    return done.stdout.decode()


def rows(lines):
    """Entries of a section: (left, right), the right one from its own line where the left one is long."""
    out = []
    for line in lines:
        if not line.strip():
            continue
        if re.match(r"^ {20,}\S", line):
            out[-1] = (out[-1][0], (out[-1][1] + " " + line.strip()).strip())
            continue
        left, right = line.strip(), ""
        if len(line) > 30 and line[29] == " ":
            left, right = line[:30].strip(), line[30:].strip()
        out.append((left, right))
    return out


def parsed(text, name):
    lines = text.rstrip("\n").split("\n")
    at = next(i for i, line in enumerate(lines) if line.startswith("Usage:"))
    out = Command(name, " ".join(line.strip() for line in lines[:at] if line.strip()), lines[at][len("Usage: "):])
    section, held = "", {}
    for line in lines[at + 1:]:
        if line and not line.startswith(" "):
            section = line.rstrip(":")
            held[section] = []
        elif section:
            held[section].append(line)
    for left, right in rows(held.get("Options", [])):
        left = re.sub(r" (Needs|Excludes): .*", "", left).replace(" ...", "")
        names, _, value = left.partition(" ")
        out.flags.append(Flag(names.split(","), value, right))
    out.examples = [line[2:] for line in held.get("Examples", []) if line.strip()]
    for left, right in rows(held.get("Positionals", [])):
        out.positionals.append((left.split(" ")[0], right))
    for left, right in rows(held.get("Subcommands", [])):
        out.subcommands.append((left, right))
    return out


def commands_of(program):
    top = parsed(run(program, "--help"), "dotek")
    out = []
    for name, about in top.subcommands:
        command = parsed(run(program, name, "--help"), name)
        command.about = command.about or about
        command.children = [parsed(run(program, name, child, "--help"), name + " " + child) for child, _ in command.subcommands]
        out.append(command)
    return top, out


# Manual pages


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join(("\\&" + line) if line[:1] in (".", "'") else line for line in text.split("\n"))


def inline(text):
    """Markdown of a line: code is bold, of a link the words stay."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    out = ""
    for index, part in enumerate(re.split(r"`", text)):
        part = roff(part if index % 2 else part.replace("**", "").replace("*", ""))
        out += "\\fB" + part + "\\fR" if index % 2 else part
    return "\\&" + out if out[:1] in (".", "'") else out


def markdown(text):
    out, fresh, verbatim = [], True, False
    for line in text.strip("\n").split("\n"):
        code = line.startswith("    ") and (fresh or verbatim)
        if code and not verbatim:
            out += [".PP", ".nf"]
        if verbatim and not code and line.strip():
            out.append(".fi")
            verbatim = False
        verbatim = verbatim or code
        if code:
            out.append(roff(line[4:]) or "\\&")
        elif not line.strip():
            out.append("\\&" if verbatim else ".PP")
            fresh = True
            continue
        elif line.startswith("- "):
            out += [".IP \\(bu 2", inline(line[2:])]
        elif line.startswith("|"):
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if not all(re.fullmatch(r"-*", cell) for cell in cells):
                out += [".TP", inline(cells[0]), inline("; ".join(cells[1:]))] if any(cells) else []
        elif line.startswith("#"):
            out += [".SS " + inline(line.lstrip("# "))]
        else:
            out.append(inline(line.strip()))
        fresh = False
    if verbatim:
        out.append(".fi")
    return out


def sections(path):
    """Sections of docs/cli.md by their titles."""
    out, title = {}, ""
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("## "):
                title = line[3:].strip()
            out[title] = out.get(title, "") + ("" if line.startswith("## ") else line)
    return out


def options(command):
    out = []
    for flag in command.flags:
        names = ", ".join("\\fB" + roff(name) + "\\fR" for name in flag.names)
        value = re.sub(r":\{.*\}", "", flag.value)
        choices = " (" + ", ".join(flag.choices) + ")" if "{" in flag.value else ""
        out += [".TP", names + (" \\fI" + roff(value) + "\\fR" if value else ""), roff(flag.text + choices)]
    return out


def head(name, date, version, about, usage):
    return [f'.TH "{roff(name).upper()}" 1 "{date}" "dotek {version}" "Dotek"', ".SH NAME", roff(name) + " \\- " + roff(about),
            ".SH SYNOPSIS", "\\fB" + roff(usage) + "\\fR"]


def command_page(command, texts, date, version):
    page = head("dotek-" + command.name, date, version, command.about, command.usage)
    body = [text for title, text in texts.items() if command.name in re.split(r", | and ", title)]
    page += [".SH DESCRIPTION"] + (markdown("\n".join(body)) if body else [roff(command.about) + "."])
    if command.positionals:
        page.append(".SH ARGUMENTS")
        for name, text in command.positionals:
            page += [".TP", "\\fI" + roff(name) + "\\fR", roff(text)]
    page += [".SH OPTIONS"] + options(command)
    for child in command.children:
        page += [".SH " + roff(child.name).upper(), roff(child.about) + "."] + options(child)
    if command.examples:
        page += [".SH EXAMPLES", ".nf"] + [roff(line) for line in command.examples] + [".fi"]
    return page + [".SH EXIT STATUS"] + markdown(texts.get("Exit status", "")) + [".SH SEE ALSO", "\\fBdotek\\fR(1)"]


def top_page(top, commands, texts, date, version):
    page = head("dotek", date, version, "read, run, check and translate programs of CNC probing", "dotek COMMAND [OPTIONS] ...")
    page += [".SH DESCRIPTION", roff(top.about) + ".", ".SH COMMANDS"]
    for command in commands:
        page += [".TP", "\\fBdotek\\-" + roff(command.name) + "\\fR(1)", roff(command.about)]
    page += [".SH OPTIONS"] + options(top)
    for title in ("Reading", "The job file", "Files that are written", "Exit status"):
        page += [".SH " + roff(title).upper()] + markdown(texts.get(title, ""))
    page += [".SH FILES", ".TP", "\\fIdotek.toml\\fR", roff("settings of a project, in its folder or above"), ".SH SEE ALSO"]
    return page + [", ".join("\\fBdotek\\-" + roff(command.name) + "\\fR(1)" for command in commands)]


# Completions


def table_words(name):
    return "dotek list " + name + " 2>/dev/null | cut -d' ' -f1"


# Rules stand below headings, which begin with a capital; codes of messages stand at the margin.
CODE_WORDS = "{ dotek list rules; dotek list messages; } 2>/dev/null | sed -nE 's/^ *([a-z][a-z0-9-]+) .*/\\1/p'"
# Pages below "Pages:", without those that stand for many.
TOPIC_WORDS = "dotek help 2>/dev/null | sed -nE 's/^  ([a-z][a-z0-9./-]*) .*/\\1/p'"


def bash_reply(kind):
    if kind[0] == "choices":
        return "COMPREPLY=($(compgen -W '" + " ".join(kind[1]) + "' -- \"$cur\"))"
    if kind[0] == "table":
        return 'COMPREPLY=($(compgen -W "$(' + table_words(kind[1]) + ')" -- "$cur"))'
    if kind[0] == "codes":
        return 'COMPREPLY=($(compgen -W "$(' + CODE_WORDS + ')" -- "$cur"))'
    if kind[0] == "nothing":
        return "COMPREPLY=()"
    return "COMPREPLY=($(compgen -%s -- \"$cur\")); compopt -o filenames" % ("d" if kind[0] == "folders" else "f")


# Arguments that are words, not files.
def words_of(command):
    if command.name == "list":
        return re.findall(r"[a-z]+", command.positionals[0][1].split(";")[0].replace(" or ", ", "))
    return [child.name.split(" ")[1] for child in command.children]


def bash(commands):
    out = ["# bash completion of dotek, made from its flags", "_dotek() {", "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}",
           "  COMPREPLY=()", "  if ((COMP_CWORD == 1)); then",
           "    COMPREPLY=($(compgen -W '" + " ".join(c.name for c in commands) + " --help --version' -- \"$cur\"))", "    return", "  fi",
           '  case "${COMP_WORDS[1]} $prev" in']
    for command in commands:
        for flag in all_flags(command):
            if flag.kind():
                out.append("    " + "|".join('"%s %s"' % (command.name, name) for name in flag.names) + ") " + bash_reply(flag.kind()) + "; return ;;")
    out += ["  esac", "  case ${COMP_WORDS[1]} in"]
    for command in commands:
        names = " ".join(name for flag in all_flags(command) for name in flag.names)
        out += ["    %s)" % command.name, "      if [[ $cur == -* ]]; then COMPREPLY=($(compgen -W '%s' -- \"$cur\")); return; fi" % names]
        words = words_of(command)
        if command.name == "explain":
            out.append("      " + bash_reply(("codes",)) + "; return ;;")
        elif command.name == "help":
            out.append("      COMPREPLY=($(compgen -W \"$(" + TOPIC_WORDS + ")\" -- \"$cur\")); return ;;")
        elif command.name == "list":
            out += ["      if ((COMP_CWORD == 2)); then COMPREPLY=($(compgen -W '%s' -- \"$cur\")); return; fi" % " ".join(words),
                    "      COMPREPLY=($(compgen -W \"$(dotek list \"${COMP_WORDS[2]}\" 2>/dev/null | sed -nE 's/^([a-z][a-z0-9-]+) .*/\\1/p')\" -- \"$cur\")); return ;;"]
        elif command.name == "new":
            out += ["      if ((COMP_CWORD == 2)); then COMPREPLY=($(compgen -W '%s' -- \"$cur\")); return; fi" % " ".join(words),
                    "      if [[ ${COMP_WORDS[2]} == macros ]]; then COMPREPLY=($(compgen -W dotek -- \"$cur\")); return; fi ;;"]
        elif words:
            out.append("      if ((COMP_CWORD == 2)); then COMPREPLY=($(compgen -W '%s' -- \"$cur\")); return; fi ;;" % " ".join(words))
        else:
            out.append("      ;;")
    out += ["  esac", "  COMPREPLY=($(compgen -f -- \"$cur\")); compopt -o filenames", "}", "complete -F _dotek dotek"]
    return out


def all_flags(command):
    out, seen = [], set()
    for one in [command] + command.children:
        for flag in one.flags:
            if flag.names[-1] not in seen:
                seen.add(flag.names[-1])
                out.append(flag)
    return out


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def zsh_action(kind):
    if kind[0] == "choices":
        return "(" + " ".join(kind[1]) + ")"
    if kind[0] == "table":
        return "{compadd -- ${(f)\"$(" + table_words(kind[1]) + ")\"}}"
    if kind[0] == "codes":
        return "{compadd -- ${(f)\"$(" + CODE_WORDS + ")\"}}"
    return {"folders": "_files -/", "files": "_files", "nothing": " "}[kind[0]]


def zsh(commands):
    out = ["#compdef dotek", "# zsh completion of dotek, made from its flags", "local -a commands", "commands=("]
    out += ["  " + quoted(c.name + ":" + c.about.replace(":", "\\:")) for c in commands]
    out += [")", "if ((CURRENT == 2)); then", "  _describe command commands", "  return", "fi", "local command=$words[2]", "shift words", "((CURRENT--))",
            "case $command in"]
    for command in commands:
        out += ["%s)" % command.name, "  _arguments -s \\"]
        for flag in all_flags(command):
            text = re.sub(r"([\[\]:\\])", r"\\\1", flag.text)
            for name in flag.names:
                spec = "*" + name + "[" + text + "]"
                if flag.kind():
                    spec += ":" + re.sub(r"([\[\]:\\])", r"\\\1", re.sub(r":\{.*\}", "", flag.value)) + ":" + zsh_action(flag.kind())
                out.append("    " + quoted(spec) + " \\")
        words = words_of(command)
        if command.name == "explain":
            out.append("    " + quoted("1:code:" + zsh_action(("codes",))))
        elif command.name == "help":
            out.append("    " + quoted("1:topic:{compadd -- ${(f)\"$(" + TOPIC_WORDS + ")\"}}"))
        else:
            out.append("    " + (quoted("1:word:(" + " ".join(words) + ")") + " " if words else "") + quoted("*:file:_files"))
        out.append("  ;;")
    return out + ["esac"]


def fish_quoted(text):
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def fish(commands):
    out = ["# fish completion of dotek, made from its flags", "complete -c dotek -n __fish_use_subcommand -f"]
    for command in commands:
        out.append("complete -c dotek -n __fish_use_subcommand -a %s -d %s" % (command.name, fish_quoted(command.about)))
    for command in commands:
        seen = "complete -c dotek -n '__fish_seen_subcommand_from %s'" % command.name
        words = words_of(command)
        if words:
            out.append(seen + " -a " + fish_quoted(" ".join(words)))
        if command.name == "explain":
            out.append(seen + " -f -a " + fish_quoted("(begin; dotek list rules; dotek list messages; end 2>/dev/null | string match -rg '^ *([a-z][a-z0-9-]+) ')"))
        if command.name == "help":
            out.append(seen + " -f -a " + fish_quoted("(dotek help 2>/dev/null | string match -rg '^  ([a-z][a-z0-9./-]*) ')"))
        for flag in all_flags(command):
            names = " ".join(("-l " + name[2:]) if name.startswith("--") else "-s " + name[1:] for name in flag.names)
            line = seen + " " + names
            kind = flag.kind()
            if kind:
                line += {"choices": " -x -a ", "table": " -x -a ", "folders": " -x -a '(__fish_complete_directories)'", "files": " -r -F", "nothing": " -x",
                         "codes": " -x -a " + fish_quoted("(dotek list rules 2>/dev/null | string match -rg '^ *([a-z][a-z0-9-]+) ')")}[kind[0]]
                line += fish_quoted(" ".join(kind[1])) if kind[0] == "choices" else ""
                line += '"(dotek list %s 2>/dev/null | string split -f1 \' \')"' % kind[1] if kind[0] == "table" else ""
            out.append(line + " -d " + fish_quoted(flag.text))
    return out


def write(path, lines, packed=False):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    bytes_ = ("\n".join(lines) + "\n").encode()
    if packed:
        # Neither a name nor a time in the head: the same text, the same bytes.
        bytes_ = gzip.compress(bytes_, 9, mtime=0)
    with open(path, "wb") as file:
        file.write(bytes_)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--dotek", required=True)
    parser.add_argument("--cli", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--epoch", type=int, default=int(os.environ.get("SOURCE_DATE_EPOCH", "0") or 0))
    given = parser.parse_args()
    version = run(given.dotek, "--version").split()[1]
    date = datetime.datetime.fromtimestamp(given.epoch, datetime.timezone.utc).strftime("%Y-%m-%d") if given.epoch else ""
    top, commands = commands_of(given.dotek)
    texts = sections(given.cli)
    manual = os.path.join(given.out, "man", "man1")
    write(os.path.join(manual, "dotek.1.gz"), top_page(top, commands, texts, date, version), True)
    for command in commands:
        write(os.path.join(manual, "dotek-" + command.name + ".1.gz"), command_page(command, texts, date, version), True)
    write(os.path.join(given.out, "bash-completion", "completions", "dotek"), bash(commands))
    write(os.path.join(given.out, "zsh", "vendor-completions", "_dotek"), zsh(commands))
    write(os.path.join(given.out, "fish", "vendor_completions.d", "dotek.fish"), fish(commands))


if __name__ == "__main__":
    main()
