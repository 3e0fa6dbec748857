"""XML of other programs, with the line of each element.

A document may not declare a type or entities, so that a short one cannot grow to gigabytes nor name
files of this machine (defusedxml); and it has limits of size and depth.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any
from xml.sax import SAXParseException
from xml.sax.handler import ContentHandler

from teeter.errors import InterchangeError

__all__ = ["Element", "parse"]

MAX_BYTES = 64_000_000
MAX_DEPTH = 100


@dataclass(slots=True)
class Element:
    """Element of a document: its name, attributes and children, and its line, from 1."""

    name: str
    attributes: dict[str, str]
    line: int
    children: list[Element] = field(default_factory=list)

    def all(self, name: str) -> list[Element]:
        """Children of a name."""
        return [child for child in self.children if child.name == name]

    def first(self, name: str) -> Element | None:
        """First child of a name, or None."""
        return next((child for child in self.children if child.name == name), None)

    def walk(self) -> Iterator[Element]:
        """Yields the element and all within it, in the order of the file."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            yield element
            waiting.extend(reversed(element.children))

    def error(self, message: str, attribute: str | None = None) -> InterchangeError:
        """Exception about this element, or an attribute of it."""
        name = self.attributes.get("name")
        called = f"`{self.name}`" + (f" '{name}'" if name else "")
        return InterchangeError(f"line {self.line}: {called} {message}", attribute or self.name, self.line)

    def numbers(self, attribute: str, count: int) -> list[float] | None:
        """Numbers of an attribute, or None where it is absent. Raises InterchangeError."""
        text = self.attributes.get(attribute)
        if text is None:
            return None
        try:
            numbers = [float(part) for part in text.split()]
        except ValueError:
            numbers = []
        if len(numbers) != count or any(not abs(number) < 1e300 for number in numbers):
            raise self.error(f"has {attribute}='{text[:60]}', expected {count} finite numbers", attribute)
        return numbers


def parse(text: str | bytes, root: str) -> Element:
    """Reads a document whose outermost element has a name.

    Raises InterchangeError for what is no such document, or a hostile one.
    """
    data = text.encode("utf-8", "surrogatepass") if isinstance(text, str) else text
    if len(data) > MAX_BYTES:
        raise InterchangeError(f"a document of {len(data)} bytes, expected at most {MAX_BYTES}", root)
    document = _parsed(data)
    if document.name != root:
        raise document.error(f"is no document of this format, expected <{root}>")
    return document


def _parsed(data: bytes) -> Element:
    try:
        from defusedxml import DefusedXmlException
        from defusedxml.sax import make_parser
    except ImportError as error:
        raise InterchangeError("reading XML needs defusedxml: pip install 'teeter[interchange]'") from error
    builder = _Builder()
    parser = make_parser()
    parser.forbid_dtd = True
    parser.setContentHandler(builder)
    try:
        parser.parse(io.BytesIO(data))
    except SAXParseException as error:
        line = error.getLineNumber()
        raise InterchangeError(f"line {line}: no XML, {error.getMessage()}", None, line) from error
    except DefusedXmlException as error:
        line = builder.line
        message = f"line {line}: a document type or entities, which are not read"
        raise InterchangeError(message, "DOCTYPE", line) from error
    except (UnicodeError, LookupError, ValueError) as error:
        raise InterchangeError(f"no XML, {' '.join(str(error).split())}") from error
    if builder.root is None:
        raise InterchangeError("no XML, it is empty")
    return builder.root


class _Builder(ContentHandler):
    """Builds elements without recursion."""

    def __init__(self) -> None:
        super().__init__()
        self.root: Element | None = None
        self._open: list[Element] = []
        self._locator: Any = None

    @property
    def line(self) -> int:
        """Line that is being read."""
        return int(self._locator.getLineNumber()) if self._locator else 1

    def setDocumentLocator(self, locator: Any) -> None:  # noqa: N802
        """Keeps the position in the text."""
        self._locator = locator

    def startElement(self, name: str, attrs: Any) -> None:  # noqa: N802
        """Opens an element."""
        element = Element(name, dict(attrs.items()), self.line)
        if len(self._open) >= MAX_DEPTH:
            raise element.error(f"is more than {MAX_DEPTH} elements deep")
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element
        self._open.append(element)

    def endElement(self, name: str) -> None:  # noqa: N802
        """Closes it."""
        self._open.pop()
