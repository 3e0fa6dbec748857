"""Studies that come with the package, by their names."""

from __future__ import annotations

from teeter.errors import StudyError
from teeter.study.sample import Study
from teeter.study.shipped.extraction import EXTRACTION
from teeter.study.shipped.loose import LOOSE
from teeter.study.shipped.removal import REMOVAL
from teeter.study.shipped.strength import STRENGTH

__all__ = ["STUDIES", "study_of"]

STUDIES: dict[str, Study] = {study.name: study for study in (REMOVAL, LOOSE, STRENGTH, EXTRACTION)}


def study_of(study: str | Study) -> Study:
    """Study of an argument: a Study, or the name of one that comes with the package. Raises StudyError."""
    if isinstance(study, Study):
        return study
    if not isinstance(study, str) or study not in STUDIES:
        raise StudyError(f"there is no study {study!r}, expected one of {', '.join(STUDIES)}", "study")
    return STUDIES[study]
