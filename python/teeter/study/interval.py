"""Intervals of confidence: how far a share or a mean of few samples may be from the truth."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from teeter.errors import StudyError

__all__ = ["mean_interval", "summary", "wilson"]

#: Quantile of the normal distribution for an interval of 95 %.
Z95 = 1.959963984540054


def wilson(count: int, tries: int, z: float = Z95) -> tuple[float, float]:
    """Interval of a probability of which ``count`` of ``tries`` were seen (Wilson, 1927): a pair, 0 to 1.

    Its ends are the probabilities p with ``|count / tries - p| = z sqrt(p (1 - p) / tries)``. z: quantile of
    the normal distribution, for 95 % by default. Without a try, the pair is (0, 1).

    Raises StudyError.
    """
    if not 0 <= count <= tries:
        raise StudyError(f"`count` is {count}, expected 0 to {tries}", "count")
    if tries == 0:
        return 0.0, 1.0
    share = count / tries
    middle = share + z * z / (2 * tries)
    reach = z * math.sqrt(share * (1 - share) / tries + (z / (2 * tries)) ** 2)
    scale = 1 + z * z / tries
    # At none and at all the end is exact, which the rounded root misses.
    low = 0.0 if count == 0 else (middle - reach) / scale
    high = 1.0 if count == tries else (middle + reach) / scale
    return low, high


def mean_interval(values: Sequence[float], z: float = Z95) -> tuple[float, float]:
    """Interval of the mean of a distribution from independent values: the mean less and plus z standard errors.

    Of a single value it is (-inf, inf).
    """
    numbers = np.asarray(values, np.float64)
    if len(numbers) < 2:
        return -math.inf, math.inf
    mean, error = float(numbers.mean()), float(numbers.std(ddof=1)) / math.sqrt(len(numbers))
    return mean - z * error, mean + z * error


def summary(table: Any, by: Sequence[str], columns: Sequence[str]) -> list[dict[str, Any]]:
    """Shares and means of columns for each combination of the values of others.

    table: a table of Arrow. by: columns whose values are told apart; none for the whole table. columns: of
    flags, whose share has Wilson's interval, or of numbers. Rows without a value are left out.

    Returns a list of dicts: the values of ``by``, samples, and for each column x its share or mean as x, the
    ends of its interval of 95 % as x_low and x_high, and the number of its values as x_count.
    """
    groups: dict[tuple[Any, ...], list[int]] = {}
    keys = [table[name].to_pylist() for name in by]
    for i in range(table.num_rows):
        groups.setdefault(tuple(key[i] for key in keys), []).append(i)
    found = []
    for values, rows in groups.items():
        line: dict[str, Any] = {**dict(zip(by, values, strict=True)), "samples": len(rows)}
        some = table.take(rows)
        for column in columns:
            kept = [value for value in some[column].to_pylist() if value is not None]
            line[column], line[f"{column}_low"], line[f"{column}_high"] = _interval(kept)
            line[f"{column}_count"] = len(kept)
        found.append(line)
    return found


def _interval(values: Sequence[Any]) -> tuple[float, float, float]:
    """Share or mean of values, and the ends of its interval."""
    if not values:
        return math.nan, math.nan, math.nan
    is_flag = isinstance(values[0], bool)
    low, high = wilson(sum(values), len(values)) if is_flag else mean_interval(values)
    return sum(values) / len(values), low, high
