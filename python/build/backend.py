"""Build backend: maturin, with the page and the manual where they were built.

``teeter play`` of a wheel serves the page that `make page` put into web/dist. Where it is missing,
and node and npm are there, it is built, and the widget of notebooks with it; without them the wheel
has neither. The manual is that of `make site`: it needs the package, so it is not built here.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import maturin
from maturin import (
    build_sdist,
    get_requires_for_build_editable,
    get_requires_for_build_sdist,
    get_requires_for_build_wheel,
    prepare_metadata_for_build_editable,
    prepare_metadata_for_build_wheel,
)

__all__ = [
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
    "prepare_metadata_for_build_editable",
    "prepare_metadata_for_build_wheel",
]

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "web/dist/index.html"
WIDGET = ROOT / "python/teeter/notebook/static/widget.js"
MANUAL = ROOT / "python/teeter/manual/index.html"


def has_page() -> bool:
    """Returns True if there is a page to put into the wheel, and builds it where it can be built."""
    if not (PAGE.exists() and WIDGET.exists()) and shutil.which("node") and shutil.which("npm"):
        subprocess.run(["make", "page"], cwd=ROOT, check=False, stdout=sys.stderr)
    return PAGE.exists()


def with_page(settings: dict[str, Any] | None) -> dict[str, Any]:
    """Returns the settings of a build, with the feature `page` where there is one."""
    settings = dict(settings or {})
    if has_page():
        given = settings.get("build-args", "")
        given = " ".join(given) if isinstance(given, list) else given
        settings["build-args"] = f"{given} --features page".strip()
    else:
        print("teeter: web/dist has no page, so `teeter play` of this wheel has none", file=sys.stderr)
    if not MANUAL.exists():
        print("teeter: `make site` was not run, so `teeter docs` of this wheel has no manual", file=sys.stderr)
    return settings


def build_wheel(
    wheel_directory: str, config_settings: dict[str, Any] | None = None, metadata_directory: str | None = None
) -> str:
    """Builds a wheel."""
    return maturin.build_wheel(wheel_directory, with_page(config_settings), metadata_directory)


def build_editable(
    wheel_directory: str, config_settings: dict[str, Any] | None = None, metadata_directory: str | None = None
) -> str:
    """Builds an editable wheel."""
    return maturin.build_editable(wheel_directory, with_page(config_settings), metadata_directory)
