"""A profile comes back from a book as it went in, and is played only where its teacher is still the same."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec import structs

from gaitwright.control.learned.profile import BINS, ROW, Profile
from gaitwright.errors import BadFile
from gaitwright.learning.profile_books import in_book, notes_of, playable, profile_of
from gaitwright.learning.profile_lessons import OUT_OF_DATE, answers_of, taught
from gaitwright.model.robot import Robot
from gaitwright.signals import Gait, SkillCall
from gaitwright.skillbook import Skillbook
from gaitwright.skills.situation import FOREST
from oracles import robot_called

DOG = robot_called("dog")
SOURCE = "dog.skills"


@cache
def standing() -> Profile:
    return taught(DOG, "stand")


@cache
def trotting() -> Profile:
    return taught(DOG, "trot")


def book_of(*profiles: Profile, robot: Robot = DOG) -> Skillbook:
    book = Skillbook.new(FOREST, robot.name)
    return replace(book, profiles=tuple(notes_of(profile) for profile in profiles))


def same(one: Profile, other: Profile) -> bool:
    plain = ("gait", "command", "repeat", "edited")
    tables = ("table", "answers")
    return all(getattr(one, name) == getattr(other, name) for name in plain) and all(
        np.array_equal(getattr(one, name), getattr(other, name)) for name in tables
    )


@given(
    st.integers(0, 1 << 30),
    st.sampled_from([4, 6]),
    st.tuples(*[st.floats(-3.0, 3.0)] * 3),
    st.floats(0.1, 2.0),
    st.floats(0.05, 1.0),
)
@settings(max_examples=15)
def test_a_profile_comes_back_from_a_book_and_its_file_exactly(
    tmp_path_factory, seed, legs, command, period, duty
):
    rng, robot = np.random.default_rng(seed), DOG if legs == 4 else robot_called("hexapod")
    table, answers = (
        rng.normal(0.0, 100.0, shape).astype(np.float32).astype(np.float64)
        for shape in ((BINS, ROW.size(legs)), (8, 3 * legs))
    )
    gait = Gait("trot", period, duty, tuple(rng.uniform(size=legs).tolist()))
    profile = Profile(gait, command, table, float(rng.uniform()), answers, "a hip by +1 N·m")
    assert same(profile_of(notes_of(profile), robot, SOURCE), profile)
    path = book_of(profile, robot=robot).save(tmp_path_factory.mktemp("books") / SOURCE)
    assert same(in_book(Skillbook.load(path), robot, SOURCE)["trot"][0], profile)


def test_what_was_taught_comes_back_exactly():
    for profile in (standing(), trotting()):
        assert same(profile_of(notes_of(profile), DOG, SOURCE), profile)


def test_edited_profiles_stand_behind_what_they_were():
    edited, other = replace(standing(), edited="softer"), trotting()
    found = in_book(book_of(edited, other, standing()), DOG, SOURCE)
    assert [profile.edited for profile in found["stand"]] == ["", "softer"] and len(found["trot"]) == 1


def test_profiles_of_another_robot_are_refused():
    notes, six = notes_of(standing()), robot_called("hexapod")
    short = structs.replace(notes, table=notes.table[:-4])
    for wrong, robot in (
        (notes, six),
        (short, DOG),
        (structs.replace(notes, answers=notes.answers[:-4]), DOG),
        (structs.replace(notes, offsets=(0.0,) * 6), DOG),
    ):
        with pytest.raises(BadFile, match=r"dog\.skills: its profile stand .* of another robot than"):
            profile_of(wrong, robot, SOURCE)
    broken = np.frombuffer(notes.table, "<f4").copy()
    broken[7] = np.inf
    with pytest.raises(BadFile, match=r"dog\.skills: .* not finite"):
        profile_of(structs.replace(notes, table=broken.tobytes()), DOG, SOURCE)


# --- is it still true ------------------------------------------------------------------------------
def test_a_teacher_who_is_the_same_makes_them_playable():
    found = playable(book_of(standing(), trotting()), DOG, SOURCE)
    assert list(found.profiles) == ["stand", "trot"] and not found.outdated
    assert same(found.profiles["trot"][0], trotting())
    assert list(playable(book_of(standing(), trotting()), DOG, SOURCE, ("trot",)).profiles) == ["trot"]


@pytest.mark.parametrize(
    "changed",
    [
        {"base_mass": 1.1 * DOG.base_mass},
        {"base_com": np.add(DOG.base_com, [0.02, 0.0, 0.0])},
        {"nominal_feet": np.add(DOG.nominal_feet, [0.0, 0.0, 0.02])},
    ],
    ids=lambda changed: next(iter(changed)),
)
def test_of_another_body_they_are_out_of_date(changed):
    found = playable(book_of(standing(), trotting()), replace(DOG, **changed), SOURCE)
    assert not found.profiles and set(found.outdated) == {"stand", "trot"}
    assert found.outdated["trot"].startswith("the profiles of trot in dog.skills are out of date: the numeri")


def test_a_teacher_who_answers_otherwise_has_changed():
    """A hundredth is forgiven; by what share it is, is told."""
    for share, is_told in ((0.5 * OUT_OF_DATE, False), (0.1, True)):
        other = replace(trotting(), answers=trotting().answers / (1.0 + share))
        found = playable(book_of(standing(), other), DOG, SOURCE)
        assert ("trot" in found.outdated) == is_told and "stand" in found.profiles
        assert not is_told or "otherwise by 10% today" in found.outdated["trot"]


@pytest.mark.parametrize("changed", [{"duty": 0.7}, {"period": 0.5}, {"offsets": (0.0, 0.5, 0.0, 0.5)}])
def test_a_skill_of_another_gait_than_it_was_is_out_of_date(changed):
    other = taught_in(replace(trotting().gait, **changed))
    assert set(playable(book_of(other), DOG, SOURCE).outdated) == {"trot"}


def test_a_skill_that_the_robot_does_not_have_is_out_of_date():
    other = replace(trotting(), gait=replace(trotting().gait, name="stride"))
    assert set(playable(book_of(other), DOG, SOURCE).outdated) == {"stride"}


def taught_in(gait: Gait) -> Profile:
    """A profile as it would have been taught when the trot was that gait."""
    call = SkillCall("trot", gait, trotting().command[:2], trotting().command[2])
    return replace(trotting(), gait=gait, answers=answers_of(DOG, call))
