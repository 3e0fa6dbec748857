"""Plots of studies, by Matplotlib.

Each function takes a table of results and returns a figure. Bars and bands are intervals of 95 %.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from teeter.errors import StudyError
from teeter.study.extra import needed
from teeter.study.interval import summary
from teeter.study.sample import Study

__all__ = ["drawn", "heights", "loose_shares", "removals", "save", "sweep"]

#: Colours that are told apart without red and green.
BLUE, ORANGE, GREY = "#0072b2", "#d55e00", "#666666"


def removals(table: Any) -> Any:
    """Chance of collapse of each block of a tower: a map of rows and cells, and the chance over the row.

    table: results of the study ``removal``. Where other parameters are swept, all their values are joined.
    """
    lines = {line["block"]: line for line in summary(table, ["block"], ["fell", "fell_exact"])}
    rows = max(lines) // 3 + 1
    chance = np.full((rows, 3), np.nan)
    for block, line in lines.items():
        chance[block // 3, block % 3] = line["fell"]
    figure, (left, right) = _figure(8.0, 1.0 + 0.3 * rows, columns=2)
    left.imshow(chance, origin="lower", cmap="cividis", vmin=0.0, vmax=1.0, aspect="auto")
    for block, line in lines.items():
        colour = "black" if line["fell"] > 0.5 else "white"
        text = f"{100 * line['fell']:.0f} %"
        left.text(block % 3, block // 3, text, ha="center", va="center", color=colour, fontsize=8)
    left.set(xticks=range(3), xlabel="cell", ylabel="row from the floor", yticks=range(0, rows, 2))
    left.set_title("chance that taking the block fells the tower", fontsize=9)
    for cell, (colour, name) in enumerate(((BLUE, "outer"), (ORANGE, "middle"), (GREY, "other outer"))):
        own = [(block // 3 + 0.22 * (cell - 1), line) for block, line in sorted(lines.items()) if block % 3 == cell]
        _bars(right, own, "fell", colour, name, is_flat=True)
    right.set(xlim=(-0.02, 1.02), xlabel="chance of collapse", ylim=(-0.6, rows - 0.4), yticks=range(0, rows, 2))
    right.legend(fontsize=8)
    right.set_title(f"with intervals of 95 %, {table.num_rows} removals", fontsize=9)
    return figure


def loose_shares(table: Any) -> Any:
    """Share of loose blocks over the scatter of heights. table: results of the study ``loose``."""
    columns = ["loose_share", "loose_middle", "loose_outer"]
    lines = sorted(summary(table, ["height_sd"], columns), key=lambda line: float(line["height_sd"]))
    scatter = np.array([1e3 * line["height_sd"] for line in lines])
    figure, (axes,) = _figure(6.0, 4.0)
    names = ("all blocks below the top row", "middle blocks", "outer blocks")
    for column, colour, name in zip(columns, (BLUE, ORANGE, GREY), names, strict=True):
        axes.plot(scatter, [line[column] for line in lines], "o-", color=colour, ms=4, label=name)
        low, high = ([line[f"{column}_{end}"] for line in lines] for end in ("low", "high"))
        axes.fill_between(scatter, low, high, color=colour, alpha=0.2, lw=0)
    axes.axhline(0.5, color="black", lw=0.8, ls=":", label="half: the rule by heights")
    positive = scatter[scatter > 0]
    # Linear from zero to the first value, for a logarithm has no zero.
    first = float(positive.min()) if len(positive) else 1.0
    axes.set_xscale("symlog", linthresh=first)
    axes.set_xlim(left=-0.3 * first)
    axes.set(xlabel="scatter of the heights (standard deviation), mm", ylabel="share of loose blocks", ylim=(0, 0.8))
    axes.legend(fontsize=8)
    axes.set_title(f"{table.num_rows} towers, mean and its interval of 95 %", fontsize=9)
    return figure


def heights(table: Any) -> Any:
    """Rows that players of each strength reach. table: results of the study ``strength``."""
    lines = summary(table, ["strength"], ["height_rows"])
    figure, (axes,) = _figure(6.0, 4.0)
    names = table["strength"].to_pylist()
    for i, line in enumerate(lines):
        found = zip(names, table["height_rows"].to_pylist(), strict=True)
        own = [height for name, height in found if name == line["strength"]]
        offset = np.linspace(-0.15, 0.15, len(own)) if len(own) > 1 else [0.0]
        axes.plot(i + np.asarray(offset), own, "o", color=GREY, ms=3, alpha=0.6)
        _bars(axes, [(i + 0.3, line)], "height_rows", BLUE, "mean and its interval of 95 %" if i == 0 else None)
    axes.set_xticks(range(len(lines)), [f"{line['strength']}\n{line['samples']} games" for line in lines])
    axes.set(ylabel="rows of the tower at the end", xlim=(-0.5, len(lines) - 0.3))
    axes.legend(fontsize=8)
    return figure


def sweep(table: Any, x: str, y: str) -> Any:
    """Share or mean of a column over the values of a parameter.

    table: results of any study. x: the parameter. y: a column of flags or numbers.
    """
    for name in (x, y):
        if name not in table.column_names:
            raise StudyError(f"`{name}` is no column, expected one of {', '.join(table.column_names)}", name)
    lines = summary(table, [x], [y])
    if not isinstance(lines[0][x], str):
        lines.sort(key=lambda line: float(line[x]))
    figure, (axes,) = _figure(6.0, 4.0)
    _bars(axes, [(line[x], line) for line in lines], y, BLUE, None)
    axes.set(xlabel=x, ylabel=y)
    axes.set_title(f"{table.num_rows} samples, intervals of 95 %", fontsize=9)
    return figure


def drawn(study: Study, table: Any, swept: Sequence[str]) -> Any:
    """Figure of a study: its own, or its first column over the first parameter that is swept."""
    if table.num_rows == 0:
        raise StudyError("there is nothing to draw: no sample is done", "samples")
    if study.plot is not None:
        return study.plot(table)
    numeric = [name for name, kind in study.columns.items() if kind in ("bool", "int", "float")]
    if not (swept and numeric):
        raise StudyError(f"study `{study.name}` has no plot: no parameter is swept, or no column a number", "plot")
    return sweep(table, swept[0], numeric[0])


def save(figure: Any, path: str | os.PathLike[str]) -> None:
    """Writes a figure to a file; equal figures give equal bytes. Raises StudyError."""
    matplotlib = needed("matplotlib", "study")
    # Identifiers in SVG are hashed with the salt, and the date would be that of the clock. Texts as texts, in one
    # family, take a third of the bytes of their outlines.
    is_svg = str(path).endswith(".svg")
    with matplotlib.rc_context({"svg.hashsalt": "teeter", "svg.fonttype": "none", "font.sans-serif": ["DejaVu Sans"]}):
        try:
            figure.savefig(path, dpi=110, metadata={"Date": None} if is_svg else None)
        except (OSError, ValueError) as error:
            raise StudyError(f"`{path}` cannot be drawn: {error}", "plot") from error


def _figure(width: float, height: float, columns: int = 1) -> tuple[Any, list[Any]]:
    """Figure without a window, and its axes."""
    figure = needed("matplotlib.figure", "study").Figure(figsize=(width, height), layout="constrained")
    axes = [figure.add_subplot(1, columns, i + 1) for i in range(columns)]
    for one in axes:
        one.tick_params(labelsize=8)
        one.spines[["top", "right"]].set_visible(False)
    return figure, axes


def _bars(
    axes: Any, points: Sequence[tuple[Any, Any]], column: str, colour: str, label: str | None, is_flat: bool = False
) -> None:
    """Values with their intervals, over positions; is_flat: the value is along x."""
    positions = [position for position, _ in points]
    values = np.array([line[column] for _, line in points], np.float64)
    ends = np.array([[line[f"{column}_low"], line[f"{column}_high"]] for _, line in points], np.float64).T
    # A single sample has no interval of its mean.
    reach = np.where(np.isfinite(ends), np.abs(ends - values), 0.0)
    style: dict[str, Any] = {"fmt": "o", "ms": 4, "color": colour, "label": label, "lw": 1}
    if is_flat:
        axes.errorbar(values, positions, xerr=reach, **style)
    else:
        axes.errorbar(positions, values, yerr=reach, **style)
