"""Folder of results: a manifest, and part files that are only added.

``manifest.json`` says of which study, parameters, seed and engine the rows are. ``parts`` has one Parquet
file for each run of samples that were finished together, named by the first and past the last of them. Each
file is written under another name first, so it is there as a whole or not at all; so a study that was
killed goes on from what is there.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from teeter.errors import StudyError
from teeter.study.extra import needed
from teeter.study.sample import Plan, seed_of

__all__ = ["Folder", "manifest_of", "table_digest"]

FORMAT = 1
MANIFEST, UNFINISHED = "manifest.json", "manifest.unfinished"
PART = re.compile(r"part-(\d{12})-(\d{12})\.parquet")
IDENTITY, DIGEST = b"teeter.study", b"teeter.digest"


class Folder:
    """Results of a plan in a folder.

    writes: True to add to it; it is made where it is absent, and no other run can write to it until close().

    Raises StudyError for a folder of another study, a damaged one, or one that another run is writing to.
    """

    def __init__(self, path: str | os.PathLike[str], plan: Plan, writes: bool = True) -> None:
        self.path, self.plan = Path(path), plan
        self._pa = needed("pyarrow", "study")
        self._pq = needed("pyarrow.parquet", "study")
        self._parts: dict[range, Path] = {}
        self._lock: Any = None
        if writes:
            self._refuse_others()
            self._acquire()
        try:
            if writes:
                self._begin()
            self._open()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Lets other runs write."""
        if self._lock is not None:
            self._lock.release()

    @property
    def schema(self) -> Any:
        """Columns of the table, a schema of Arrow."""
        types = {
            "bool": self._pa.bool_(),
            "int": self._pa.int64(),
            "float": self._pa.float64(),
            "str": self._pa.string(),
            "floats": self._pa.list_(self._pa.float64()),
        }
        return self._pa.schema([(name, types[kind]) for name, kind in self.plan.kinds.items()])

    def missing(self, samples: int) -> list[range]:
        """Runs of samples below ``samples`` that are not there, in order."""
        gaps, start = [], 0
        for part in sorted(self._parts, key=lambda part: part.start):
            if part.start > start:
                gaps.append(range(start, part.start))
            start = part.stop
        gaps.append(range(start, samples))
        return [range(gap.start, min(gap.stop, samples)) for gap in gaps if gap.start < min(gap.stop, samples)]

    def append(self, start: int, rows: list[list[Any]]) -> None:
        """Writes the rows of the samples from ``start`` on."""
        stop = start + len(rows)
        columns = [list(column) for column in zip(*rows, strict=True)]
        schema = self.schema
        table = self._pa.Table.from_arrays(
            [self._pa.array(column, kind) for column, kind in zip(columns, schema.types, strict=True)], schema=schema
        )
        marks = {IDENTITY: self.plan.digest().encode(), DIGEST: table_digest(table).encode()}
        table = table.replace_schema_metadata(marks)
        path = self.path / "parts" / f"part-{start:012}-{stop:012}.parquet"
        unfinished = path.with_suffix(".unfinished")
        self._pq.write_table(table, unfinished, write_page_checksum=True)
        _finish(unfinished, path)
        self._parts[range(start, stop)] = path

    def table(self, samples: int) -> Any:
        """Rows of the first ``samples`` samples in order of their index, a table of Arrow."""
        ordered = sorted((part for part in self._parts if part.start < samples), key=lambda part: part.start)
        tables = [self._read(self._parts[part]).replace_schema_metadata(None) for part in ordered]
        joined = self._pa.concat_tables([self.schema.empty_table(), *tables])
        return joined.slice(0, samples).combine_chunks()

    def _refuse_others(self) -> None:
        """Refuses a folder with files of something else, before a file is added to it."""
        if not self.path.is_dir() or (self.path / MANIFEST).exists():
            return
        others = {entry.name for entry in self.path.iterdir()} - {"parts", ".lock", UNFINISHED}
        parts = self.path / "parts"
        others |= {entry.name for entry in parts.iterdir()} if parts.is_dir() else set()
        if others:
            raise StudyError(f"`{self.path}` has `{min(others)}` and no {MANIFEST}: it is no folder of a study", "out")

    def _acquire(self) -> None:
        """Makes the folder where it is absent, and keeps other runs out."""
        lock = needed("filelock", "study")
        try:
            (self.path / "parts").mkdir(parents=True, exist_ok=True)
            self._lock = lock.FileLock(self.path / ".lock", timeout=0)
            self._lock.acquire()
        except lock.Timeout:
            raise StudyError(f"`{self.path}` is being written by another run of a study", "out") from None
        except OSError as error:
            raise StudyError(f"`{self.path}` cannot be written: {error.strerror or error}", "out") from error

    def _begin(self) -> None:
        """Writes the manifest where there is none, and removes files that were not finished."""
        if not (self.path / MANIFEST).exists():
            unfinished = self.path / UNFINISHED
            unfinished.write_text(json.dumps({"format": FORMAT, **self.plan.identity()}, indent=1) + "\n")
            _finish(unfinished, self.path / MANIFEST)
        for path in (self.path / "parts").glob("*.unfinished"):
            path.unlink()

    def _open(self) -> None:
        """Reads what is there."""
        self._compare(manifest_of(self.path), {"format": FORMAT, **self.plan.identity()})
        parts = self.path / "parts"
        for path in sorted(parts.iterdir()) if parts.is_dir() else ():
            # Another run may be writing while this one reads.
            if path.suffix != ".unfinished":
                self._take(path)

    def _compare(self, found: dict[str, Any], expected: dict[str, Any]) -> None:
        for key in ("study", "params", "seed", "version", "engine", "columns", "format"):
            if found.get(key) == expected[key]:
                continue
            old, new, name = found.get(key), expected[key], key
            if isinstance(old, dict) and isinstance(new, dict):
                key = min(part for part in {*old, *new} if old.get(part) != new.get(part))
                old, new, name = old.get(key), new.get(key), f"{name}.{key}"
            raise StudyError(f"`{self.path}` has results with `{name}` {_short(old)}, expected {_short(new)}", key)

    def _take(self, path: Path) -> None:
        """Reads a part and checks that it is one of this study, whole and where it belongs."""
        match = PART.fullmatch(path.name)
        if match is None:
            raise StudyError(f"`{path}` is no part of a study", "out")
        part = range(int(match[1]), int(match[2]))
        table = self._read(path)
        if (table.schema.metadata or {}).get(IDENTITY) != self.plan.digest().encode():
            raise StudyError(f"`{path}` is a part of another study, expected one of `{self.plan.study.name}`", "out")
        if not table.schema.equals(self.schema) or table["index"].to_pylist() != list(part):
            raise self._damaged(path, "its columns or samples are not those of its name")
        if table["seed"].to_pylist() != [seed_of(self.plan.seed, index) for index in part]:
            raise self._damaged(path, "its seeds are not those of its samples")
        for other in self._parts:
            if max(other.start, part.start) < min(other.stop, part.stop):
                raise StudyError(f"`{path}` has samples that another part has as well", "out")
        self._parts[part] = path

    def _read(self, path: Path) -> Any:
        """Table of a part, with the values that were written. Checksums of pages find most damage, the digest all."""
        try:
            with self._pq.ParquetFile(path, page_checksum_verification=True) as file:
                table = file.read()
            digest = table_digest(table).encode()
        except (OSError, ValueError, self._pa.ArrowException) as error:
            raise self._damaged(path, str(error)) from error
        if (table.schema.metadata or {}).get(DIGEST) != digest:
            raise self._damaged(path, "its values are not those of its digest")
        return table

    def _damaged(self, path: Path, reason: str) -> StudyError:
        line = " ".join(reason.split())
        return StudyError(f"`{path}` is damaged ({line}): without it, its samples are computed again", "out")


def manifest_of(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Manifest of a folder of results. Raises StudyError where there is none, or where it is damaged."""
    file = Path(path) / MANIFEST
    try:
        manifest = json.loads(file.read_text())
    except OSError as error:
        raise StudyError(f"`{file}` cannot be read: {error.strerror or error}", "out") from error
    except ValueError as error:
        raise StudyError(f"`{file}` is damaged: {error}", "out") from error
    if not isinstance(manifest, dict) or not isinstance(manifest.get("params"), dict):
        raise StudyError(f"`{file}` is damaged: it is no manifest of a study", "out")
    return manifest


def table_digest(table: Any) -> str:
    """SHA-256 of all values of a table and the names of its columns. Equal digests, equal bits."""
    whole = hashlib.sha256()
    for name in table.column_names:
        column = table[name].combine_chunks()
        whole.update(f"{name} {len(column)}\n".encode())
        whole.update(column.is_null().to_numpy(zero_copy_only=False).tobytes())
        for values in _values(column):
            whole.update(values)
    return whole.hexdigest()


def _values(column: Any) -> Iterable[bytes]:
    kind = str(column.type)
    if kind.startswith("list"):
        yield json.dumps([None if one is None else len(one) for one in column.to_pylist()]).encode()
        yield from _values(column.flatten())
    elif kind == "string":
        yield json.dumps(column.to_pylist()).encode()
    else:
        yield f"{kind}\n".encode()
        yield column.fill_null(False if kind == "bool" else 0).to_numpy(zero_copy_only=False).tobytes()


def _finish(unfinished: Path, path: Path) -> None:
    """Gives a file that is written its name, once its bytes are on the disk."""
    with unfinished.open("rb") as file:
        os.fsync(file.fileno())
    unfinished.replace(path)


def _short(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 80 else f"{text[:77]}..."
