"""Samples: a study is a pure function of a sample, and a sample follows from its index alone.

The seed of sample i is drawn from (master seed, i), so any subset of the samples, in any order and on any
machine, gives the same rows.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import math
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

import numpy as np

from teeter import __version__
from teeter.errors import StudyError

__all__ = ["Params", "Plan", "Row", "Sample", "Scalar", "Study", "seed_of"]

Scalar: TypeAlias = bool | int | float | str
Params: TypeAlias = Mapping[str, Any]
Row: TypeAlias = Mapping[str, Any]
Kind: TypeAlias = Literal["bool", "int", "float", "str", "floats"]

#: Types of Python that a column of each kind takes. A list is a column of numbers of variable length.
KINDS: dict[str, tuple[type, ...]] = {
    "bool": (bool, np.bool_),
    "int": (int, np.integer),
    "float": (float, int, np.floating, np.integer),
    "str": (str,),
    "floats": (list, tuple, np.ndarray),
}
#: Largest seed of a study, and number of samples that it may have.
MAX_SEED, MAX_SAMPLES = 2**63 - 1, 10**12 - 1
#: Largest number of workers of this machine.
MAX_WORKERS = 1024


def seed_of(master: int, index: int) -> int:
    """Returns the seed of a sample, an integer from 0 to 2**63 - 1.

    master: seed of the study. index: of the sample. Both are integers from 0 to 2**63 - 1.
    """
    # A spawn key pads the master seed, so that no two pairs are the same sequence of words.
    words = np.random.SeedSequence(master, spawn_key=(index,)).generate_state(1, np.uint64)
    return int(words[0]) >> 1


@dataclass(frozen=True)
class Sample:
    """One evaluation of a study. params: one value of each parameter. seed: of all that is drawn by lot."""

    index: int
    seed: int
    params: Params

    def rng(self) -> np.random.Generator:
        """Random numbers of the sample."""
        return np.random.default_rng(self.seed)


@dataclass(frozen=True)
class Study:
    """A pure function of a sample, with its parameters and the columns of its rows.

    name: lower case letters, digits and hyphens. measure: takes a Sample and returns a dict with a value for
    each of ``columns``, or None. columns: name and kind of each: "bool", "int", "float", "str" or "floats", a
    list of numbers. params: default of each parameter, a scalar; a tuple is swept, one combination of values a
    sample; a function is called with the other parameters and returns one of both. version: to be raised where
    ``measure`` changes, so that old results are not mixed with new ones. about: a line on it, and one on each
    parameter and column. plot: draws a table of results.
    """

    name: str
    measure: Callable[[Sample], Row]
    columns: Mapping[str, Kind]
    params: Mapping[str, Any] = field(default_factory=dict)
    version: int = 1
    about: str = ""
    plot: Callable[[Any], Any] | None = None

    def __post_init__(self) -> None:
        if not (isinstance(self.name, str) and re.fullmatch(r"[a-z0-9][a-z0-9-]*", self.name)):
            raise StudyError(f"`name` is {self.name!r}, expected lower case letters, digits and hyphens", "name")
        if not callable(self.measure):
            raise StudyError(f"`measure` is {self.measure!r}, expected a function of a sample", "measure")
        if not self.columns:
            raise StudyError("`columns` is empty, expected at least one column", "columns")
        for column, kind in self.columns.items():
            if kind not in KINDS:
                raise StudyError(f"`columns.{column}` is {kind!r}, expected one of {', '.join(KINDS)}", "columns")
            if column in (*self.params, "index", "seed"):
                raise StudyError(f"`columns.{column}` has the name of a parameter, the index or the seed", "columns")


class Plan:
    """A study with values for its parameters and a seed: all that its rows follow from.

    study: the study. seed: master seed, an integer from 0 to 2**63 - 1. params: values that replace the
    defaults; a list or tuple is swept.

    Raises StudyError.
    """

    def __init__(self, study: Study, seed: int = 0, params: Mapping[str, Any] | None = None) -> None:
        if not isinstance(study, Study):
            raise StudyError(f"`study` is {study!r}, expected a Study", "study")
        self.study = study
        self.seed = checked_count("seed", seed, 0, MAX_SEED)
        self.params = _merged(study, params or {})
        self.swept = [name for name, value in self.params.items() if isinstance(value, tuple)]
        values = [value if isinstance(value, tuple) else (value,) for value in self.params.values()]
        self.combinations: list[Params] = [
            dict(zip(self.params, combination, strict=True)) for combination in itertools.product(*values)
        ]

    def sample(self, index: int) -> Sample:
        """Sample of an index, from 0. Sample i has combination i mod n, so any first samples are balanced."""
        return Sample(index, seed_of(self.seed, index), self.combinations[index % len(self.combinations)])

    def row(self, index: int) -> list[Any]:
        """Values of the row of a sample, in the order of ``kinds``. Raises StudyError at a wrong row."""
        sample = self.sample(index)
        try:
            measured = self.study.measure(sample)
        except Exception as error:
            raise StudyError(
                f"sample {index} of study `{self.study.name}` failed: {type(error).__name__}: {_one_line(error)}",
                "measure",
            ) from error
        if not isinstance(measured, Mapping):
            raise StudyError(f"sample {index} returned {_shown(measured)}, expected a dict", "measure")
        values = [_checked(name, kind, measured, index) for name, kind in self.study.columns.items()]
        unknown = set(measured) - set(self.study.columns)
        if unknown:
            raise StudyError(f"sample {index} returned `{min(unknown)}`, which is no column of the study", min(unknown))
        return [index, sample.seed, *(sample.params[name] for name in self.params), *values]

    @property
    def kinds(self) -> dict[str, str]:
        """Kind of each column of a table: index, seed, parameters, and what is measured."""
        kind = {bool: "bool", int: "int", float: "float", str: "str"}
        params = {name: kind[type(self.combinations[0][name])] for name in self.params}
        return {"index": "int", "seed": "int", **params, **self.study.columns}

    def identity(self) -> dict[str, Any]:
        """Plain data that two runs share whose rows may stand in one table."""
        return {
            "study": self.study.name,
            "version": self.study.version,
            "engine": __version__,
            "seed": self.seed,
            "params": {name: list(value) if isinstance(value, tuple) else value for name, value in self.params.items()},
            "columns": dict(self.study.columns),
        }

    def digest(self) -> str:
        """SHA-256 of the identity."""
        return hashlib.sha256(json.dumps(self.identity(), sort_keys=True).encode()).hexdigest()


def checked_count(name: str, value: Any, low: int, high: int) -> int:
    """Integer of a range, checked. Raises StudyError."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or not low <= value <= high:
        raise StudyError(f"`{name}` is {_shown(value)}, expected an integer from {low} to {high}", name)
    return int(value)


def worker_count(workers: int | None) -> int:
    """Number of workers of this machine, one for each core where None is given. Raises StudyError."""
    return os.cpu_count() or 1 if workers is None else checked_count("workers", workers, 1, MAX_WORKERS)


def _merged(study: Study, given: Mapping[str, Any]) -> dict[str, Any]:
    """Parameters in the order of the study: those given, and the defaults of the others."""
    for name in given:
        if name not in study.params:
            known = ", ".join(study.params) or "none"
            raise StudyError(f"study `{study.name}` has no parameter `{name}`, expected one of {known}", name)
    merged = {name: given.get(name, default) for name, default in study.params.items()}
    checked = {name: _param(name, value) for name, value in merged.items() if not callable(value)}
    derived = {name: _param(name, value(checked)) for name, value in merged.items() if callable(value)}
    return {name: _of_type(name, (checked | derived)[name], default) for name, default in study.params.items()}


def _param(name: str, value: Any) -> Any:
    if isinstance(value, list | tuple | range | np.ndarray):
        values = tuple(_scalar(name, one) for one in value)
        if not values:
            raise StudyError(f"`{name}` is swept over no value, expected at least one", name)
        if len({type(one) for one in values}) > 1:
            values = tuple(_as_float(name, one) for one in values)
        if len(set(values)) < len(values):
            raise StudyError(f"`{name}` has a value twice, expected different ones", name)
        return values
    return _scalar(name, value)


def _scalar(name: str, value: Any) -> Scalar:
    value = value.item() if isinstance(value, np.generic) else value
    if isinstance(value, float) and not math.isfinite(value):
        raise StudyError(f"`{name}` is {value}, expected a finite number", name)
    if isinstance(value, int) and not isinstance(value, bool) and not -(2**63) <= value < 2**63:
        raise StudyError(f"`{name}` is an integer of more than 64 bits", name)
    if isinstance(value, str) and not value.isprintable():
        raise StudyError(f"`{name}` is {_shown(value)}, expected printable text", name)
    if not isinstance(value, bool | int | float | str):
        raise StudyError(f"`{name}` is {_shown(value)}, expected a number, a text, or a list of them", name)
    return value


def _as_float(name: str, value: Scalar) -> float:
    if isinstance(value, bool | str):
        raise StudyError(f"`{name}` has values of several types, expected one", name)
    return float(value)


def _of_type(name: str, value: Any, default: Any) -> Any:
    """Value in the type of its default, which a function has not. Raises StudyError for another type."""
    if callable(default):
        return value
    if isinstance(value, tuple):
        return tuple(_of_type(name, one, default) for one in value)
    wanted = type(default[0] if isinstance(default, tuple | list) else default)
    if wanted is float and type(value) is int:
        return float(value)
    if type(value) is not wanted:
        expected = {bool: "true or false", int: "an integer", float: "a number", str: "a text"}[wanted]
        raise StudyError(f"`{name}` is {_shown(value)}, expected {expected}", name)
    return value


def _checked(name: str, kind: str, row: Row, index: int) -> Any:
    """Value of a column in plain types, None where it is absent."""
    value = row.get(name)
    if value is None:
        return None
    expected = kind
    is_flag = isinstance(value, bool | np.bool_)
    if isinstance(value, KINDS[kind]) and (not is_flag or kind == "bool"):
        plain: Any = value.item() if isinstance(value, np.generic) else value
        if kind == "floats" and np.ndim(plain) == 1:
            return [float(number) for number in plain]
        if kind == "float":
            return float(plain)
        if kind in ("bool", "str") or (kind == "int" and -(2**63) <= plain < 2**63):
            return plain
        expected = "an integer of 64 bits" if kind == "int" else "a list of numbers"
    raise StudyError(f"sample {index} returned {_shown(value)} for `{name}`, expected {expected}", name)


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _one_line(error: BaseException) -> str:
    return " ".join(str(error).split()) or "no message"
