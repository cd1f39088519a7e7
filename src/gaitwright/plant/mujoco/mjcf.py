"""MJCF elements from plain numbers, every digit kept."""

from typing import Any
from xml.etree.ElementTree import Element, SubElement

import numpy as np


def child(parent: Element, tag: str, common: dict[str, str] | None = None, /, **attributes: Any) -> Element:
    """A new element under `parent`; attributes are texts, numbers or sequences of numbers."""
    own = {name: _text(value) for name, value in attributes.items()}
    return SubElement(parent, tag, (common or {}) | own)


def _text(value: Any) -> str:
    if isinstance(value, str):
        return value
    return " ".join(repr(float(number)) for number in np.ravel(value))
