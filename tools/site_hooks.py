# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hooks of mkdocs: README.md is the site's first page, and links into the sources become plain names."""
import pathlib
import posixpath
import re

PROJECT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s#]*)(#[^)\s]*)?\)")


def inside(target):
    """The target below docs/, there or not, which mkdocs then says; nothing for a folder and for what is elsewhere."""
    if not target.startswith("docs/") or (PROJECT / target).is_dir():
        return None
    return target[len("docs/"):]


def on_page_markdown(markdown, page, config, files):
    folder = posixpath.dirname("docs/" + page.file.src_uri)
    if page.file.src_uri == "index.md":
        markdown, folder = (PROJECT / "README.md").read_text(encoding="utf-8"), ""

    def replaced(match):
        image, text, target, anchor = match.groups()
        if not target or "://" in target:
            return match.group(0)
        found = inside(posixpath.normpath(posixpath.join(folder, target)))
        if found is None:
            return text if "`" in text else f"`{text}`"
        here = posixpath.dirname(page.file.src_uri)
        return f"{image}[{text}]({posixpath.relpath(found, here or '.')}{anchor or ''})"

    # Not inside of code, where brackets are brackets.
    parts = re.split(r"(```.*?```|`[^`\n]*`)", markdown, flags=re.DOTALL)
    joined, kept = "", []
    for part in parts:
        if part.startswith("`"):
            kept.append(part)
            part = f"\0{len(kept) - 1}\0"
        joined += part
    linked = LINK.sub(replaced, joined)
    return re.sub("\0(\\d+)\0", lambda m: kept[int(m.group(1))], linked)
