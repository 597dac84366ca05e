"""Pages of the site that are not in docs/: those at the repository's root, and the list of modules.

Links are written as the repository has them. Here they are turned to where the site has the same thing: a
page, a picture, or the file itself, which then goes into the site. What is nowhere makes a strict build fail,
and so does a decision that the index of decisions leaves out.
"""

import ast
import posixpath
import re
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.plugins import get_plugin_logger
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

log = get_plugin_logger("site_pages")

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
ROOT_PAGES = {
    "README.md": "index.md",
    "ARCHITECTURE.md": "architecture.md",
    "CHANGELOG.md": "changelog.md",
    "examples/README.md": "examples.md",
    "examples/viscorig_example_plugin/README.md": "example-plugin.md",
    "examples/driver_template/README.md": "driver-template.md",
    "CONTRIBUTING.md": "contributing.md",
    "VISION.md": "vision.md",
}
"""Page of the repository's root -> page of the site."""
DECISIONS = "decisions"
MODULES = "modules.md"
MADE_HERE = "scripts/site_pages.py"
"""Where the repository links to this file, the site has the page that it makes: the modules."""
ROOMS = ("fitting", "drivers", "instrument", "gui", "viscorig", "campaign")

_SOURCES = {site: root for root, site in ROOT_PAGES.items()}
_LINK = re.compile(r"(?<=\]\()[^)\s]+(?=[)\s])")
_ELSEWHERE = re.compile(r"[a-z]+:|#")
_CODE_SPAN = re.compile(r"(`[^`]*`)")
_MARKUP = re.compile(r"[\\*_<>\[\]]")


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Put every decision into the navigation, in its order, where mkdocs.yml names their folder."""
    for section in config.nav or []:
        for title, item in section.items():
            if item == f"{DECISIONS}/":
                section[title] = [f"{DECISIONS}/README.md", *(f"{DECISIONS}/{p.name}" for p in _decisions())]
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages that are not in docs/."""
    for source, page in ROOT_PAGES.items():
        files.append(File.generated(config, page, abs_src_path=str(ROOT / source)))
    files.append(File.generated(config, MODULES, content=_list_of_modules()))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Turn links of the repository into links of the site."""
    here = page.file.src_uri
    source = _SOURCES.get(here, f"docs/{here}")
    if here == f"{DECISIONS}/README.md":
        for left_out in (p.name for p in _decisions() if f"]({p.name}) |" not in markdown):
            log.warning("%s does not list %s", source, left_out)

    def turned(link: re.Match[str]) -> str:
        if _ELSEWHERE.match(link[0]):
            return link[0]
        target, mark, anchor = link[0].partition("#")
        meant = posixpath.normpath(posixpath.join(posixpath.dirname(source), target))
        there = _on_site(meant, config, files)
        if there is None:
            log.warning("%s links to %s, which is not in the repository", source, target)
            return link[0]
        return posixpath.relpath(there, posixpath.dirname(here) or ".") + mark + anchor

    return _LINK.sub(turned, markdown)


def _on_site(meant: str, config: MkDocsConfig, files: Files) -> str | None:
    """Where the site has what the repository has at `meant`; a file it lacks is added."""
    if meant in ROOT_PAGES:
        return ROOT_PAGES[meant]
    if meant == f"docs/{DECISIONS}":
        return f"{DECISIONS}/README.md"
    if meant == MADE_HERE:
        return MODULES
    if meant.startswith("docs/"):
        return meant.removeprefix("docs/")
    if not (ROOT / meant).is_file():
        return None
    if files.get_file_from_path(meant) is None:
        files.append(File.generated(config, meant, abs_src_path=str(ROOT / meant)))
    return meant


def _decisions() -> list[Path]:
    return sorted((DOCS / DECISIONS).glob("[0-9]*.md"))


def _list_of_modules() -> str:
    """Every module of every room with the first line of its docstring, folder by folder."""
    files = sorted((f.relative_to(ROOT) for room in ROOMS for f in (ROOT / room).rglob("*.py")), key=_place)
    lines = ["# Modules", "", "Every module by the first line of its docstring, folder by folder.", ""]
    for folder, modules in groupby(files, key=lambda f: f.parent):
        lines += [f"{'##' if len(folder.parts) == 1 else '###'} {folder.as_posix()}", ""]
        lines += _of_folder(modules)
        lines.append("")
    return "\n".join(lines)


def _place(file: Path) -> tuple[int, tuple[str, ...], bool, str]:
    """In the order of rooms, then of folders; what a folder is as a whole comes before its modules."""
    return ROOMS.index(file.parts[0]), file.parent.parts, file.name != "__init__.py", file.name


def _of_folder(modules: Iterator[Path]) -> Iterator[str]:
    for module in modules:
        said = ast.get_docstring(ast.parse((ROOT / module).read_text(encoding="utf-8"))) or ""
        line = _escaped(said.partition("\n")[0])
        yield from (line, "") if module.name == "__init__.py" else (f"* `{module.name}`: {line}",)


def _escaped(line: str) -> str:
    """A line of a docstring as Markdown shows it unchanged; `code` stays code."""
    parts = _CODE_SPAN.split(line)
    return "".join(p if k % 2 else _MARKUP.sub(r"\\\g<0>", p) for k, p in enumerate(parts))
