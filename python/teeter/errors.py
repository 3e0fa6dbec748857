"""Exceptions.

Each has a message of one line that says which block or field, its value, and what was expected.
``field`` is the name of that field, None where there is none::

    TeeterError
      SceneError       (ValueError)   a scene that cannot be read or simulated
      ParamError       (ValueError)   constants of a run
      InputError       (ValueError)   an argument, or a part of a step's input
      BodyError        (IndexError)   the index of a body that does not exist
      SnapshotError    (ValueError)   bytes that are no state of this world or game
      RulesError       (ValueError)   rules that cannot be played
      CommandError     (ValueError)   what is no command of a game
      RecordError      (ValueError)   bytes that are no record, or one that cannot be replayed
      StudyError       (ValueError)   a study, its parameters or its folder; a sample that failed
      WorkerError      (RuntimeError) a worker of a study that ended before its samples were done
      InterchangeError (ValueError)   a file of another program that has no counterpart here
      EngineError      (RuntimeError) an engine of the benchmark that is unknown or breaks its protocol
      UnavailableError (RuntimeError) a part of the package that was not installed or built
"""

from __future__ import annotations

__all__ = [
    "BodyError",
    "CommandError",
    "EngineError",
    "InputError",
    "InterchangeError",
    "ParamError",
    "RecordError",
    "RulesError",
    "SceneError",
    "SnapshotError",
    "StudyError",
    "TeeterError",
    "UnavailableError",
    "WorkerError",
]


class TeeterError(Exception):
    """Any error of this package. ``field``: name of the field it is about, or None."""

    def __init__(self, message: str, field: str | None = None) -> None:
        super().__init__(message)
        self.field = field

    def __reduce__(self) -> tuple[type[TeeterError], tuple[str, str | None]]:
        return type(self), (str(self.args[0]), self.field)


class SceneError(TeeterError, ValueError):
    """Scene that cannot be read, built or simulated."""


class ParamError(TeeterError, ValueError):
    """Constant of a run that is unknown or out of its range."""


class InputError(TeeterError, ValueError):
    """Argument, or part of a step's input, that is not expected."""


class BodyError(TeeterError, IndexError):
    """Index of a body that does not exist."""


class SnapshotError(TeeterError, ValueError):
    """Bytes that are no state of this world or game."""


class RulesError(TeeterError, ValueError):
    """Rules that cannot be played."""


class CommandError(TeeterError, ValueError):
    """Command that a game does not know. What it knows and refuses is an event, not an error."""


class RecordError(TeeterError, ValueError):
    """Bytes that are no record, or a record that cannot be replayed."""


class StudyError(TeeterError, ValueError):
    """Study, parameter of a study or folder of results that is not expected, or a sample that failed."""


class WorkerError(TeeterError, RuntimeError):
    """Worker of a study that ended before its samples were done."""


class InterchangeError(TeeterError, ValueError):
    """File of another program, or part of it, that cannot be read or has no counterpart here.

    ``field``: name of the element or attribute. ``line``: its line in the file, from 1, or None.
    """

    def __init__(self, message: str, field: str | None = None, line: int | None = None) -> None:
        super().__init__(message, field)
        self.line = line

    def __reduce__(self) -> tuple[type[TeeterError], tuple[str, str | None, int | None]]:  # type: ignore[override]
        return type(self), (str(self.args[0]), self.field, self.line)


class EngineError(TeeterError, RuntimeError):
    """Engine of the benchmark that is unknown, fails or breaks its protocol."""


class UnavailableError(TeeterError, RuntimeError):
    """Part of the package that was not installed or built. The message has the command to run."""
