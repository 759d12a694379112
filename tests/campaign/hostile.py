"""Texts that grow along one dimension, as each kind of file, at two sizes: nothing crashes or hangs."""

import pathlib

# One piece of the text; it is repeated up to the size, between a beginning and an end.
NC = [
    ("", "(", ""), ("", ")", ""), ("", "[", ""), ("", "]", ""), ("", "#", ""), ("#1=", "#", "1"), ("#1=", "[", "1"),
    ("#1=", "-", "1"), ("#1=1", "+1", ""), ("#1=1", "*[1", ""), ("#1=", "SIN[", "1"), ("IF[1EQ1", "AND[1EQ1]", "]GOTO1"),
    ("", "IF[1EQ1]THEN", "#1=1"), ("", "WHILE[1EQ1]DO1\n", ""), ("", "DO1\nEND1\n", ""), ("", "END1\n", ""),
    ("", "N1 GOTO 1\n", ""), ("", "GOTO#1\n", ""), ("", "O1\n", "M99\n"), ("", "%\n", ""), ("", "%", ""), ("", "/", ""),
    ("", "G65P9810", ""), ("", "G65P1\n", ""), ("", "M98P1\n", ""), ("", "M98P1L9999\n", ""), ("", "X", ""), ("", "X1.", ""),
    ("", "9", ""), ("", ".", ""), ("X", "0", "1"), ("", "\0", ""), ("", "\xff", ""), ("", "\r", ""), ("", "\n", ""),
    ("", "\t", ""), ("", " ", "X"), ("", "\xe2\x80\xae", ""), ("", "\x1b[2J", ""), ("", "DPRNT[X#1[53]]\n", ""),
    ("DPRNT[", "X#1[53]", "]"), ("POPEN\n", "BPRNT[X#1[3]]\n", ""), ("SETVN 500[", "A,", "A]"), ("", "G31X1.F1.\n", ""),
    ("", "G2X1.I1.\n", ""), ("", "G91G28Z0.\n", ""), ("", "G10L2P1X1.\n", ""), ("", "#3000=1(T)\n", ""),
    ("", "#[#1]=#[#[1]]\n", ""), ("#1=", "#[", "1"), ("(DOTEK: IGNORE ", "A,", ")"), ("", "(DOTEK: IGNORE-START A)\n", ""),
]
MAC = [
    ("", "if a then ", "b=1"), ("", "[", ""), ("", "if a then [\n", ""), ("", "for i=1 to 9\n", ""), ("", ":a\ngoto a\n", ""),
    ("x=", "(", "1"), ("x=", "-", "1"), ("x=1", "+1", ""), ("x=", "sin(", "1"), ("", 'call "a.mac"\n', ""),
    ("", '#include "a.mac"\n', ""), ("", '"', ""), ("message ", '"a"&', '"b"'), ("", "!", ""), ("", "global a\n", ""),
    ("", "dialog \"a\",1,1,1,1\n", ""), ("", "a,", ""), ("if a", " and a", " then b=1"), ("", "x=1e9\n", ""), ("", "else ", ""),
]
PROG = [
    ("a:\n", "IF CycleType?('a')\n", ""), ("a:\n", "END\n", ""), ("", "a:\nRETURN\n", ""), ("a:\n", "CALL a\n", "RETURN\n"),
    ("a:\n", "SeqC 'G1' EOL\n", "RETURN\n"), ("", "'", ""), ("a:\nSeqC ", "'x'", " EOL\n"), ("", "#1='#.#'\n", ""),
    ("#1='", "#", "'\n"), ("", "FORMAT(a,1)\n", ""), ("a:\n", "IF 1 ELSE ", ""), ("", "(", ""), ("", "a:", ""), ("", "! x\n", ""),
]
SUF = [
    ("", "N1 G0 X1\n", ""), ("", "G31 X1 L10\n", ""), ("", "N10 M20 L10\n", ""), ("", "#1=#1+1\n", ""), ("", "(", ""), ("", "L1", ""),
    ("", "G92 X1\n", ""), ("", "%", ""), ("", "9", ""), ("", ";", ""),
]
TOML = [
    ("a=", "[", ""), ("", "[a]\n", ""), ("", "[a.", ""), ("a=", "{b=", ""), ("a='", "x", "'"), ('a="', "\\u0041", '"'), ("", "a=1\n", ""),
    ("a", ".a", "=1"), ("", '"', ""), ("", "[[lint.path]]\n", ""), ("a=", "1", ""), ("", "#", ""),
]
STL = [
    ("solid\n", "facet normal 0 0 1\n", ""), ("solid\n", "vertex 1 1 1\n", ""), ("", "\0", ""), ("solid ", "x", ""),
    ("x" * 80 + "\xff\xff\xff\x7f", "\1", ""), ("solid\n", "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 "
     "vertex 0 1 0 endloop endfacet\n", "endsolid\n"),
]
CYCLE = [
    ("", "x = ", "1 mm\n"), ("x = ", "(", "1 mm\n"), ("x = ", "-", "1 mm\n"), ("x = 1 mm", " + 1 mm", "\n"), ("x = 1 mm", " +\n 1 mm", "\n"),
    ("if 1 > 2", " and 1 > 2", " then\n"), ("", "if yes then\n", ""), ("", "repeat 2 times\n", ""), ("", "end\n", ""), ("", '"', ""),
    ("", "//", ""), ("", "move by x 1 mm\n", ""), ("touch x by 1 mm", ", y 1 mm", "\n"), ("", "touch x by 1 mm -> a else\n", ""),
    ("", "call grows\n", ""), ("", "call bore diameter = 30 mm\n", ""), ("", "use datum\n", ""), ("", "use a,", "\n"), ("", "cycle b\n", ""),
    ("", "parameter p : length\n", ""), ("", "\0", ""), ("", "\xff", ""), ("", "\t", ""), ("", "9", " mm\n"), ("x = ", "sqrt(", "\n"),
    ("", "set G54: 0 mm becomes x 0 mm\n", ""), ("", "zzz\n", ""), ("", "repeat 999999999 times\nend\n", ""), ("", "not ", "\n"),
]
CYCLE = [('cycle grows "Grows"\nspindle off\n' + begin, piece, end) for begin, piece, end in CYCLE]
KINDS = [
    (CYCLE, "grows.cycle", [["check", "grows.cycle"], ["fmt", "grows.cycle"], ["dump", "grows.cycle", "--stage", "ir"],
                            ["sim", "--json", "grows.cycle"], ["convert", "grows.cycle", "--to", "fanuc"]]),
    (NC, "a.nc", [["lint", "--select", "all", "a.nc"], ["sim", "--json", "a.nc"], ["dump", "a.nc"],
                  ["convert", "a.nc", "--to", "fanuc", "--control", "fanuc-31i-b"]]),
    (MAC, "a.mac", [["lint", "--select", "all", "--from", "mac", "a.mac"]]),
    (PROG, "p.txt", [["lint", "--select", "all", "--from", "prog", "p.txt"]]),
    (SUF, "a.SUF", [["lint", "--select", "all", "a.SUF"], ["sim", "--json", "a.SUF"]]),
    (TOML, "dotek.toml", [["lint", "b.nc"], ["sim", "--json", "--part", "dotek.toml", "b.nc"], ["sim", "--json", "--job", "dotek.toml", "b.nc"]]),
    (STL, "a.stl", [["sim", "--json", "--part", "part.toml", "--tool", "1", "--length", "50", "--diameter", "6", "b.nc"]]),
]
SIZES = (20_000, 400_000)  # bytes
DRAWN = 100  # files


def drawn(random, texts):
    """A text of several pieces of a kind: in turn, one within the other, or one after the other at a length of its own."""
    begin, _, end = random.choice(texts)
    pieces = [piece for _, piece, _ in random.sample(texts, random.choice([2, 2, 3]))]
    pieces.append(random.choice(["\n", "", " ", "1", "(", "X" * random.randrange(1, 90)]))
    random.shuffle(pieces)
    way = random.choice(["turn", "nest", "runs"])

    def text(size):
        if way == "turn":
            one = "".join(pieces) or "x"
            return begin + one * (size // len(one)) + end
        if way == "nest":
            half = size // 2
            return begin + (pieces[0] or "x") * (half // len(pieces[0] or "x")) + (pieces[1] or "x") * (half // len(pieces[1] or "x")) + end
        share = size // len(pieces)
        return begin + "".join((piece or "x") * (share // len(piece or "x")) for piece in pieces) + end

    return text, f"{way}: {begin!r} {pieces!r}"


def run(judge, folder, random):
    folder = pathlib.Path(folder)
    (folder / "b.nc").write_text("%\nO1\nG90 G54 G0 X0 Y0\nG31 Z-5. F100.\nM30\n%\n")
    (folder / "part.toml").write_text('schema = 1\n[[shape]]\nkind = "mesh"\nfile = "a.stl"\nunit = "mm"\n')
    for texts, name, commands in KINDS:
        for begin, piece, end in texts:
            for size in SIZES:
                text = begin + piece * (size // len(piece)) + end
                (folder / name).write_bytes(text.encode("latin1"))
                for command in commands:
                    prints = "sim" if "--json" in command else None
                    fault = judge.run(command, folder, prints=prints)
                    yield fault and f"{fault} ({begin!r} {piece!r} to {size} bytes)", command, folder
        (folder / name).unlink()
    for _ in range(DRAWN):
        texts, name, commands = random.choice(KINDS)
        text, what = drawn(random, texts)
        command = random.choice(commands)
        for size in SIZES:
            (folder / name).write_bytes(text(size).encode("latin1"))
            fault = judge.run(command, folder, prints="sim" if "--json" in command else None)
            yield fault and f"{fault} ({what} to {size} bytes)", command, folder
        (folder / name).unlink()
