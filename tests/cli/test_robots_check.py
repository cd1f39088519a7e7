"""`gaitwright robots --check`: a robot that runs, one that does not, files that are none."""

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gaitwright.assess.suitability import (
    Finding,
    of_file,
    of_motors,
    of_stance,
    runs,
    suitability,
    summary,
    trials,
)
from gaitwright.cli import main
from gaitwright.description.load import load_robot
from gaitwright.model.robot import Robot
from gaitwright.skills.library import find_skill

GO2 = load_robot("go2")


def small_robot(torque: str = "") -> str:
    """A quadruped of 1.7 kg on legs of 16 cm as MJCF; `torque`: limit of its motors [N·m], if any."""

    def link(mass: float) -> str:
        return f'<inertial mass="{mass}" pos="0 0 -.03" diaginertia="2e-5 2e-5 1e-5"/>'

    legs, motors = "", ""
    for name, x, y in (("fl", 0.09, 0.04), ("fr", 0.09, -0.04), ("rl", -0.09, 0.04), ("rr", -0.09, -0.04)):
        aside = 0.02 if y > 0 else -0.02
        legs += f"""
        <body name="{name}1" pos="{x} {y} 0">{link(0.05)}<joint name="{name}a" axis="1 0 0"/>
          <body name="{name}2" pos="0 {aside} 0">{link(0.07)}<joint name="{name}b" axis="0 1 0"/>
            <body name="{name}3" pos="0 0 -.08">{link(0.03)}<joint name="{name}c" axis="0 1 0"/>
              <geom size=".01" pos="0 0 -.08"/></body></body></body>"""
        if torque:
            motors += "".join(f'<motor joint="{name}{j}" ctrlrange="-{torque} {torque}"/>' for j in "abc")
    trunk = (
        '<inertial mass="1.1" pos="0 0 0" diaginertia=".001 .004 .0045"/><geom type="box" size=".1 .04 .02"/>'
    )
    body = f'<body name="trunk"><freejoint/>{trunk}{legs}</body>'
    return f"<mujoco><worldbody>{body}</worldbody><actuator>{motors}</actuator></mujoco>"


def written(tmp_path: Path, text: str) -> str:
    path = tmp_path / "mouse.xml"
    path.write_text(text)
    return str(path)


# --- the command -----------------------------------------------------------------------------------
def checked(path: str) -> subprocess.CompletedProcess[str]:
    """The command as users run it: without the checks of shapes, which take most of the time here."""
    words = [sys.executable, "-m", "gaitwright", "robots", "--check", path, "--json", f"{path}.json"]
    return subprocess.run(words, capture_output=True, text=True, timeout=300, check=False)


def test_a_robot_that_runs(tmp_path: Path):
    path = written(tmp_path, small_robot())
    done = checked(path)
    assert done.returncode == 0
    told = " ".join(done.stdout.split())
    assert " mouse can stand, walk, trot" in told
    assert "no torque limit is given for 12 joints" in told
    report = json.loads(Path(f"{path}.json").read_text())
    assert report["robot"] == "mouse"
    assert report["runs"] is True
    assert {finding["kind"] for finding in report["findings"]} == {"file", "body", "motors", "trial"}
    assert report["summary"] in told
    assert len(report["notes"]) == 1


def test_a_robot_too_weak_to_stand_is_exit_code_1(tmp_path: Path):
    path = written(tmp_path, small_robot("0.05"))
    done = checked(path)
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    report = json.loads(Path(f"{path}.json").read_text())
    assert report["runs"] is False
    cannot = "mouse can do nothing that was tried; it cannot reliably stand: 0 of 3"
    assert report["summary"].startswith(cannot)
    stand = next(f for f in report["findings"] if f["what"] == "stand" and f["kind"] == "motors")
    assert stand["verdict"] == "no"
    assert "N·m at the knee of" in stand["sentence"]
    assert "the motor gives 0.05" in stand["sentence"]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("hello", "not XML"),
        ("<mujoco><worldbody/></mujoco>", "no floating body"),
        (
            '<mujoco><worldbody><body><freejoint/><geom size="1"/></body></worldbody></mujoco>',
            "has no joints",
        ),
    ],
)
def test_a_file_that_is_no_robot_is_exit_code_3(
    text: str, found: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    assert main(["robots", "--check", written(tmp_path, text)]) == 3
    out, err = capsys.readouterr()
    assert out == ""
    assert found in err
    assert "needed: an MJCF or URDF file with one floating body" in err


def test_a_name_that_is_none_is_exit_code_2(capsys: pytest.CaptureFixture[str]):
    assert main(["robots", "--check", "go3"]) == 2
    assert "did you mean 'go2'?" in capsys.readouterr().err


# --- what is found ---------------------------------------------------------------------------------
def test_every_trial_is_told_and_judged():
    told: list[str] = []
    hexapod = load_robot("hexapod")
    findings = suitability(hexapod, (), told.append, starts=1, seconds=1.0)
    assert "what turn-in-place needs" in told
    assert "trot sideways: start 1 of 1" in told
    names = ["stand", "walk", "trot", "turn in place", "trot sideways"]
    assert [finding.what for finding in trials(findings)] == names
    assert summary(hexapod, findings).startswith("hexapod can stand")
    assert "fall short" not in summary(hexapod, findings)  # what it does in spite of its motors is not told
    assert not runs([replace(finding, verdict="no") for finding in findings])


def finding(kind, what: str, verdict, sentence: str, lacks: bool = False) -> Finding:
    return Finding(kind, what, verdict, sentence, lacks)


TRIED = [finding("trial", what, "ok", "3 of 3 starts") for what in ("stand", "walk", "trot")]


def test_what_the_motors_cannot_do_is_not_said_to_be_possible():
    """A trial may go well by what simulated motors do beyond their limits; the summary goes by both."""
    missing = "trot at 0.4 m/s turns the knee of FL 40° beyond its limit"
    findings = [finding("motors", "trot", "no", missing, True), *TRIED]
    assert not runs(findings)
    assert summary(GO2, findings).startswith(
        f"go2 can stand and walk; it cannot reliably trot, though it did in simulation: {missing}"
    )
    strained = [finding("motors", "trot", "limited", "trot needs 40 N·m", True), *TRIED]
    assert runs(strained)
    assert summary(GO2, strained) == "go2 can stand, walk and trot (at the limits of its motors)"


def test_motors_that_turn_too_slowly_are_told():
    skill = find_skill("trot", GO2)
    quick = of_motors(replace(GO2, rate_max=np.full((4, 3), 30.0)), skill)
    assert "% of its speed" in quick.sentence
    slow = of_motors(replace(GO2, rate_max=np.full((4, 3), 1.5)), skill)
    assert slow.verdict == "limited"
    assert slow.lacks
    assert "rad/s; the motor turns 1.5" in slow.sentence


def test_a_package_is_a_name_and_a_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    path = written(tmp_path, small_robot())
    assert main(["robots", "--check", path, "--package", "pip"]) == 2
    assert "'pip' is not a package; write NAME=FOLDER" in capsys.readouterr().err
    assert main(["skill", "--robot", path, "--package", f"pip={tmp_path}/no"]) == 2
    assert "package pip: " in capsys.readouterr().err


def verdicts(findings: list[Finding]) -> dict[str, str]:
    return {finding.what: finding.verdict for finding in findings}


def test_what_a_file_leaves_open_is_limited():
    assert set(verdicts(list(of_file(GO2, ()))).values()) == {"ok"}
    lame = GO2.mass.copy()
    lame[1] *= 1.5
    bare = replace(
        GO2,
        q_min=np.full((4, 3), -np.pi),
        q_max=np.full((4, 3), np.pi),
        armature=np.zeros((4, 3)),
        mass=lame,
    )
    found = list(of_file(bare, ("no torque limit is given",)))
    assert set(verdicts(found).values()) == {"limited"}
    assert "none at hip 1, hip 2, knee" in found[1].sentence
    assert "FL weighs" in found[-1].sentence


def stance_with(robot: Robot, **changed: np.ndarray) -> Finding:
    return of_stance(replace(robot, **changed))


def test_a_stance_beyond_its_limits_is_told():
    assert of_stance(GO2).verdict == "ok"
    low = GO2.q_min.copy()
    low[2, 2] = -1.0
    assert stance_with(GO2, q_min=low).verdict == "no"
    assert "the knee of RL stands" in stance_with(GO2, q_min=low).sentence
    feet = GO2.nominal_feet.copy()
    feet[:2, 2] -= 0.03
    assert "0.030 m from being level" in stance_with(GO2, nominal_feet=feet).sentence


def test_motors_are_judged_by_how_much_is_missing():
    trot = find_skill("trot", GO2)
    by_share = {
        share: of_motors(replace(GO2, tau_max=GO2.tau_max * share), trot) for share in (1, 0.4, 0.25, 0.1)
    }
    assert [finding.verdict for finding in by_share.values()] == ["ok", "limited", "limited", "no"]
    assert "at most" in by_share[0.4].sentence
    assert "N·m at the" in by_share[0.25].sentence
