# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program's messages, taken from its source.

    list_messages.py --dump              one line each: kind, file, line, text
    list_messages.py --page              writes the lists of docs/messages.md anew; --page --check only compares
    list_messages.py --produced FOLDER   which of them no test has produced: exit 1 where there is one

A message is what stands in a statement that throws one of the four errors, that adds a note to a summary, or, in algorithm/, any sentence: the
reasons of wells that are not meshed. What throws std::logic_error is none: no input leads there. Variable parts are written as `…`. FOLDER holds what tests/messages/record_messages.cpp wrote.
"""
import argparse
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ("model", "readers", "algorithm", "writers", "cli", "conversion", "report", "interface")
STRING = re.compile(r'R"\((.*?)\)"|"((?:\\.|[^"\\])*)"', re.S)
ERROR = re.compile(r"throw\s+(?:ParseError|InvalidInput|WriteError|UsageError)|\b(?:fail|refuse|bad_limit|complain)\w*\(|\bWhat\{|Refusal\s")
NOTE = re.compile(r"notes?_?(?:\.|->)(?:push_back|emplace_back)\(|\bnote\w*\(|\bwarn\w*\(")

Message = collections.namedtuple("Message", "kind file line text parts")


def statements(source):
    """(offset, text) of each piece that ends with a semicolon; comments are blanked out."""
    out, begin, at = [], 0, 0
    text = []
    while at < len(source):
        if source.startswith("//", at):
            end = source.find("\n", at)
            end = len(source) if end < 0 else end
            text.append(" " * (end - at))
            at = end
            continue
        found = STRING.match(source, at) if source[at] in 'R"' else None
        if source[at] == "'" and (found is None):
            end = re.compile(r"'(?:\\.|[^'\\])+'").match(source, at)
            if end:
                text.append(" " * (end.end() - at))
                at = end.end()
                continue
        if found:
            text.append(found.group(0))
            at = found.end()
        elif source[at] == ";":
            out.append((begin, "".join(text)))
            text = []
            at += 1
            begin = at
        else:
            text.append(source[at])
            at += 1
    return out


def literals(code):
    """(offset, text), those that only space divides joined."""
    out, last = [], None
    for found in STRING.finditer(code):
        raw = found.group(1)
        text = raw if raw is not None else re.sub(r"\\(.)", lambda m: {"n": " ", "t": " "}.get(m.group(1), m.group(1)), found.group(2))
        if last is not None and not code[last:found.start()].strip():
            out[-1][1] += text
        else:
            out.append([found.start(), text])
        last = found.end()
    return out


def arguments(code):
    """The text between the top-level commas of a brace or parenthesis that opens at the beginning of `code`, with offsets."""
    depth, begin, at, out = 0, 1, 0, []
    while at < len(code):
        found = STRING.match(code, at) if code[at] in 'R"' else None
        if found:
            at = found.end()
            continue
        c = code[at]
        if c in "({[":
            depth += 1
        elif c in ")}]":
            depth -= 1
            if depth == 0:
                out.append(code[begin:at])
                return out
        elif c == "," and depth == 1:
            out.append(code[begin:at])
            begin = at + 1
        at += 1
    return out


def plain(pattern):
    """A pattern of fmt as people read it."""
    text = re.sub(r"\{[^{}]*\}", "…", pattern.replace("{{", "\1").replace("}}", "\2")).replace("\1", "{").replace("\2", "}")
    return re.sub(r"…(?:[ ,x]*…)+", "…", text).strip()


def spoken(code):
    """Literals of an expression, alternatives divided by ' / '; '…' where there is none."""
    parts = [plain(t) for _, t in literals(code)]
    parts = [p for p in parts if re.search(r"\w", p)]
    return " / ".join(dict.fromkeys(parts)) or ("…" if code.strip() not in ("", '""') else "")


def words(text):
    return len(re.findall(r"[A-Za-z]{2,}", re.sub(r"\{[^}]*\}", " ", text)))


def messages_of(path):
    source = path.read_text()
    name = str(path.relative_to(ROOT))
    for begin, code in statements(source):
        if "std::logic_error" in code:  # a check of the program's own work: no input leads there
            continue
        error, note = ERROR.search(code), NOTE.search(code)
        # There a step that "failed" has a reason, and only what is thrown is an error.
        if name.startswith("algorithm/") and error and "throw" not in code:
            error = None
        kind = "error" if error else "note" if note else "reason" if name.startswith("algorithm/") else None
        if kind is None or "static_assert" in code or "#include" in code and not (error or note):
            code = re.sub(r"#include[^\n]*", "", code)
            if kind is None or "static_assert" in code:
                continue
        start = (error or note).start() if (error or note) else 0
        body = re.sub(r"#include[^\n]*", lambda m: " " * len(m.group(0)), code)[start:]
        said = [(o, t) for o, t in literals(body) if words(t) >= 2]
        # Keys of notes that are said once, and names that are put into them, are short.
        if not said or (kind != "error" and max(words(t) for _, t in said) < (3 if kind == "reason" else 4)):
            continue
        if kind == "note":
            said = [(o, t) for o, t in said if words(t) > 3 or len(said) == 1]
        line = source[:begin].count("\n") + 1 + code[:start + said[0][0]].count("\n")
        what = re.search(r"ParseError\(\s*[{\w]|What\{|fail\w*\(", body)
        text = None
        if kind == "error" and what:
            found = re.search(r"(?:What\{|,\s*\{|\(\s*\{|fail\w*\()(?=[^;]*\")", body)
            groups = [arguments(body[m.end() - 1:]) for m in re.finditer(r"(?:What\s*\{|\{|fail\w*\()", body)]
            groups = [g for g in groups if len(g) in (2, 3, 4) and sum(words(spoken(a)) for a in g) > 0]
            best = max(groups, key=lambda g: (sum('"' in a for a in g), len(g)), default=None)
            if best and found:
                # MeshFileReader::fail() has the object that is wrong before them.
                best = best[1:] if name == "readers/read_mesh.cpp" and len(best) == 3 and "throw" not in code else best
                best = [a for a in best if not re.fullmatch(r"\s*[\w.()>-]*(line|keyword|place|path)\w*\s*", a)]
                if len(best) in (2, 3):
                    text = f"expected {spoken(best[0])}, found {spoken(best[1])}"
                    advice = spoken(best[2]) if len(best) == 3 else ""
                    text += f"; {advice}" if advice not in ("", "…") else ""
        if text is None:
            text = " / ".join(dict.fromkeys(plain(t) for _, t in said))
        yield Message(kind, name, line, text, tuple(t for _, t in said if words(t) >= 2))


def all_messages():
    out = []
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).glob("*")):
            if path.suffix in (".cpp", ".h"):
                out += messages_of(path)
    return out


SECTIONS = (
    ("Commands and options", r"cli/"),
    ("Decks and GRDECL files", r"readers/(deck|cell_|grid_section|read_case|read_deck|block_centred|value_array|number_array|file_content|text)"),
    ("Binary grids, INIT, summaries and restarts", r"readers/(ecl|read_egrid|read_init|read_binary|read_grid_file|grid_part|read_run|find_|summary)"),
    ("ROFF", r"readers/(read_roff|roff)"),
    ("Well paths", r"readers/(read_trajectory|trajectory|station|fit_to_grid|minimum)"),
    ("Properties and tables", r"readers/(read_properties|read_value_table)"),
    ("Mesh files and other programs' meshes", r"readers/"),
    ("Grids", r"model/"),
    ("Meshes, wells, flow", r"algorithm/"),
    ("Whole decks", r"conversion/|readers/whole_deck"),
    ("Outputs", r"writers/|report/"),
    ("C, Fortran and Python", r"interface/"),
)

def section_of(message):
    if message.file.startswith("readers/whole_deck"):
        return "Whole decks"
    return next(title for title, pattern in SECTIONS if re.match(pattern, message.file))


def as_code(text):
    return f"`` {text} ``" if "`" in text else f"`{text}`"


def page_lists():
    """The generated part of docs/messages.md."""
    lists = {title: ([], []) for title, _ in SECTIONS}
    for m in all_messages():
        if m.kind == "reason":
            continue
        lists[section_of(m)][m.kind == "note"].append(m.text)
    out = []
    for title, (errors, notes) in lists.items():
        if not errors and not notes:
            continue
        out += ["", f"### {title}"]
        for name, texts in (("Errors", errors), ("Notes", notes)):
            if texts:
                out += ["", f"{name}:", ""] + [f"- {as_code(t)}" for t in sorted(set(texts), key=lambda t: (t.lstrip("…: '").lower(), t))]
    return "\n".join(out).strip() + "\n"


BEGIN, END = "<!-- Made by tools/list_messages.py --page. -->\n\n", "\n<!-- End of what is made. -->\n"


def write_page(only_check):
    path = ROOT / "docs" / "messages.md"
    old = path.read_text()
    head, rest = old.split(BEGIN)
    new = head + BEGIN + page_lists() + END + rest.split(END)[1]
    if new == old:
        return 0
    if only_check:
        print("docs/messages.md is not what tools/list_messages.py --page makes of the source")
        return 1
    path.write_text(new)
    return 0


def produced(folder):
    """Whether tests have produced a literal: a function of it."""
    patterns, said = set(), []
    for path in pathlib.Path(folder).iterdir():
        for line in path.read_text(errors="replace").splitlines():
            kind, _, text = line.partition("\t")
            if kind == "pattern":
                patterns.add(" ".join(text.split()))
            said.append(re.sub(r"\d+", "#", " ".join(text.split())))
    spoken_text = "\n".join(dict.fromkeys(said))
    # Reasons and notes that a unit test compares word by word are not printed anywhere.
    asserted = "\n".join(re.sub(r'"\s*"', "", p.read_text()) for p in sorted((ROOT / "tests").rglob("*_test.*")))

    def is_produced(literal):
        text = " ".join(literal.split())
        if text in patterns:
            return True
        fragment = max(re.split(r"\{[^{}]*\}", text), key=len).strip()
        return re.sub(r"\d+", "#", fragment) in spoken_text or fragment in asserted

    return is_produced


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--dump", action="store_true")
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--produced", metavar="FOLDER")
    asked = parser.parse_args()
    if asked.page:
        return write_page(asked.check)
    if asked.produced:
        is_produced = produced(asked.produced)
        every = [(m, t) for m in all_messages() for t in m.parts]
        missing = [(m, t) for m, t in every if not is_produced(t)]
        print(f"{len(every) - len(missing)} of {len(every)} texts are produced by tests")
        for m, t in missing:
            print(f"{m.file}:{m.line}: no test produces: {t}")
        return 1 if missing else 0
    if asked.dump:
        for m in all_messages():
            print(m.kind, f"{m.file}:{m.line}", m.text, sep="\t")


if __name__ == "__main__":
    sys.exit(main())
