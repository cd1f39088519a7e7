"""A brain with what a skillbook holds beside its rules."""

from collections.abc import Mapping, Sequence

from gaitwright.control.learned.profile import Profile
from gaitwright.knowledge.trust import grades_in
from gaitwright.learning.operator_books import operators_in
from gaitwright.locomotion import Brain
from gaitwright.skillbook.book import Skillbook


def equipped(brain: Brain, book: Skillbook, profiles: Mapping[str, Sequence[Profile]], source: str) -> Brain:
    """The same brain with a book's terrain operators, and with profiles of it as far as it is trusted with
    them; of a book of another robot neither. `profiles`: those that may be played. Raises `BadFile`."""
    brain = brain.with_operators(operators_in(book, brain.robot, source))
    if not profiles:
        return brain
    return brain.with_profiles(profiles, grades_in(book.trust) if book.robot == brain.robot.name else {})
