"""MJCF elements from plain numbers, every digit kept."""

import sys
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
    return " ".join(repr(whole(float(number))) for number in np.ravel(value))


def whole(number: float) -> float:
    """A number that MuJoCo reads: it refuses those that have lost digits to their smallness."""
    return 0.0 if 0.0 < abs(number) < sys.float_info.min else number
