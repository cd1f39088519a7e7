"""What each command does, as `gaitwright --help` and `gaitwright COMMAND --help` tell it."""

from typing import NamedTuple


class Command(NamedTuple):
    """A command as `gaitwright --help` shows it."""

    line: str
    more: str
    examples: tuple[str, ...]


COMMANDS = {
    "demo": Command(
        "the whole story: a robot crosses a field, learns, and crosses another one",
        "Without arguments and without network: go2 walks from (0, 0) to (6, 0) among blocks, over the low "
        "ones and around the high ones, by the numerical controller. Then it goes to school, which takes "
        "about a minute, and crosses another field by what it has learned. It has never been in either: it "
        "knows what its camera shows. Then a bay lies in its way to (12, 0), twice: the second time it goes "
        "by the map that it made the first time. Prints the figures of all trips and leaves pictures, "
        "recordings, reports, the skillbook and the map in a new folder runs/demo-NNN; --json tells of the "
        "second field. Exit code 0: it arrives every time; 1: it does not.",
        ("gaitwright demo", "gaitwright demo --seed 3 --out runs/three", "gaitwright demo --json -"),
    ),
    "mission": Command(
        "take a robot to a goal",
        "Takes a robot through a scene to a goal, or as a file says (--route, --velocity), and reports how "
        "it went. Exit code 0: it stands at the goal, or did as told; 1: it does not, and `stopped_because` "
        "says why. The scenes that come along are made for robots up to 0.6 m tall; for a taller one every "
        "length of the scene is multiplied by its height / 0.29 m, rounded (9 for `thesis`).",
        (
            "gaitwright mission --scene rough:0.03 --waypoints 2,1 4,-1 6,0 --speed 0.5 --out runs/rough",
            "gaitwright mission --sight camera --strategy thesis --scene bugtrap --goal 12 0",
            "gaitwright mission --scene flat --route rounds.csv     # or --velocity commands.csv",
        ),
    ),
    "skill": Command(
        "one skill for a time",
        "Holds one skill at one velocity for a time and reports how well. Exit code 0: it walked for that "
        "time; 1: it fell or stopped, and `stopped_because` says why. `gaitwright skills` lists the skills.",
        (
            "gaitwright skill --skill walk --lateral 0.1 --turn 0.3 --seconds 20 --json walk.json",
            "gaitwright skill --skill trot --speed 0.5 --push 0.5 90     # pushed to the left after 5 s",
            "gaitwright skill --robot thesis --skill walk --plant armstrong --check     # the thesis's plant",
        ),
    ),
    "robots": Command(
        "the robots that come along; --check: does it run mine?",
        "The built-in robots with their sizes. Other robots come from MJCF or URDF files: --robot FILE. With "
        "--check: what a robot's file leaves open, what its motors can do, and how it stands, walks, trots, "
        "turns and goes sideways in simulation; takes about a minute. Exit code 0: it stands, walks and "
        "trots; 1: it does not.",
        ("gaitwright robots", "gaitwright robots --check my_robot.urdf", "gaitwright robots --json -"),
    ),
    "scenes": Command(
        "the scenes that come along",
        "The built-in scenes. Some take a number after a colon. --plot draws scenes from above. Other scenes "
        "come from JSON files, --scene FILE.json, as "
        '{"boxes": [{"x": 2, "y": 0, "lx": 0.5, "ly": 0.4, "height": 0.3}], "shapes": [{"type": "cylinder", '
        '"x": 4, "y": 1, "radius": 0.2, "height": 0.8}], "holes": [{"outline": [[5, -1], [6, -1], [6, 1]], '
        '"depth": 0.3}], "goal": [7, 0]}; docs/scenes.md tells all that one may hold. A grey PNG is a '
        "height map: --scene FILE.png:ACROSS:RELIEF, metres from side to side and from black to white.",
        (
            "gaitwright scenes",
            "gaitwright scenes --plot forest maze:0.8 yard.json --seed 3 --out scenes.png",
            "gaitwright mission --scene stairs:0.08 --goal 6 0",
        ),
    ),
    "skills": Command(
        "the skills, with their speeds for a robot",
        "The skills with their gaits. Periods and speeds grow with the square root of a robot's height. "
        "--plot draws their leg cycles: the path of a foot as points, and when which foot is down. --cycle "
        "checks a leg cycle in each skill, or in the one it is named after, and names the point and the leg "
        "that are wrong. --profile draws the torques that a skillbook holds for a skill, or writes them as a "
        "table. Exit code 1: the robot can walk a leg cycle in no skill.",
        (
            "gaitwright skills",
            "gaitwright skills --robot hexapod --plot     # --cycle mine.json: your own",
            "gaitwright skills --profile trot --skillbook go2.skills --out trot.csv",
        ),
    ),
    "teach": Command(
        "makes a skillbook for a robot: a school, or you in the middle of a mission",
        "A pupil drives trip after trip; a scripted teacher, or your own rules (--policy), says what is "
        "right where she is wrong or unsure. Trips are situations along a way, without physics; what was "
        "learned drives real ones. With --live you are the teacher, on a mission in physics or on a "
        "recording: stop, say what would be right, see what that changes, keep it or not. Every lesson is in "
        "the file before the next, an interrupt keeps it, and the same command goes on. --lesson profiles "
        "takes the torques of every skill from the numerical controller, for drivers learned and hybrid; "
        "--lesson practice drives trips in physics by both.",
        (
            "gaitwright teach --lesson all --robot go2 --out go2.skills",
            "gaitwright teach --live --scene slippery:0.3 --goal 4 0 --out go2.skills",
            "gaitwright mission --driver hybrid --skillbook go2.skills --scene stairs --goal 6.5 0",
        ),
    ),
    "explain": Command(
        "why a rule fires or not, and what moved its marks",
        "Tells what a rulebook knows: its rules in order, each in a sentence. With a situation: which rule "
        "fires, why, why not another, what would have to be different, and which lessons moved its marks. "
        "A tree that is left out of the situation is taken as the last lesson had it, and that is said; a "
        "value may be a number where the tree has intervals. --recording takes what it can from a recorded "
        "moment.",
        (
            "gaitwright explain garden.json",
            "gaitwright explain garden.json --situation ground=gravel speed=0.8 --not trot",
            "gaitwright explain garden.json --rule trot --plot     # its trees as a picture",
        ),
    ),
    "books": Command(
        "skillbooks: two joined to one; one as text, and back; lessons taken back",
        "merge: teaches OURS what THEIRS was taught since they went apart, into a new book; what the two "
        "teach differently is told in a sentence each. export: a skillbook as text, "
        "one thing a line, the same text for the same book, for reading, diff and version control. import: "
        "a skillbook from such a text, or one that begins with a rulebook as JSON. No file is ever written "
        "over by these. confirm, undo and forget change BOOK itself, and say what changed: confirm takes in "
        "a skill that `gaitwright teach` proposed by analogy, undo forgets the last lesson that counts (what "
        "was confirmed together counts as one), forget a lesson, or an edited profile, by its name, edit "
        "takes in what you changed in a profile's table (`gaitwright skills --profile`). trust shows how far "
        "the learned controller is trusted with each skill, and sets it. map shows what is known of places.",
        (
            "gaitwright books merge mine.skills yours.skills --out both.skills",
            "gaitwright books confirm mine.skills walk-backward     # `books undo` takes it back",
            "gaitwright books trust mine.skills trot partner     # without a skill: all of them",
        ),
    ),
    "operators": Command(
        "how legs get over obstacles: rules with what is added to a swing",
        "The terrain operators of a skillbook, in the order in which they are tried: what is ahead of a leg, "
        "and how its foot and its torques differ then, for every leg and skill. --size teaches one from "
        "one edit on one leg: the path of a foot over an obstacle of that size, by a leg cycle of yours or "
        "as the numerical controller raises it. It is shown in physics on every leg; --accept takes it in. "
        "What no operator is for is left to the numerical controller.",
        (
            "gaitwright operators go2.skills",
            "gaitwright operators go2.skills --size 0.06 --leg FL --cycle over.json --accept",
            "gaitwright operators go2.skills --recording run.npz     # which legs were under which",
        ),
    ),
    "balance": Command(
        "rules that answer what is off while torque profiles are played",
        "Height, roll, pitch, velocity and turn are compared with the profile's ideal traces, each coded "
        "-1, 0 or +1. Shows the rules that answer such patterns, in the order in which they are asked, with "
        "what they did in pushed runs. --learn makes them: each run is tried with every action from the "
        "moment on at which something is off, and what saves more than it loses becomes a rule; with 160 "
        "runs that takes about ten minutes on two cores. --forget takes one out.",
        (
            "gaitwright balance mine.json --learn go2.skills",
            "gaitwright balance mine.json --json -",
            "gaitwright skill --driver learned --skillbook go2.skills --balance mine.json --push 1.5 90",
        ),
    ),
    "scanner": Command(
        "what the terrain scanner held at a moment of a recorded run",
        "Supporting feet, the support polygon and the coming one, the centre of gravity from above, where "
        "each foot could be put, feet that may not be lifted, pitch and roll, and slope and height of the "
        "ground ahead of each foot, as far as the robot knew it. With --out, `mission` and `skill` record it "
        "20 times a second: in recording.npz under names that begin with scanner_, in recording.mcap as "
        "/gaitwright/scanner.",
        (
            "gaitwright scanner runs/walk/recording.npz",
            "gaitwright scanner runs/walk/recording.npz --at 4.2 --plot --out scanner.png",
            "gaitwright scanner runs/walk/recording.npz --at 4.2 --json -",
        ),
    ),
    "bench": Command(
        "every claim, measured",
        "Measures what this project claims about itself, on this machine. Without names: everything.",
        ("gaitwright bench", "gaitwright bench --quick", "gaitwright bench tick --json bench.json"),
    ),
    "reproduce": Command(
        "tables and figures of the thesis",
        "Computes tables and figures of the thesis anew and holds them against what it says: what agrees, "
        "what does not, and what cannot. Prints them and leaves each as Markdown, the figures as PNG too, "
        "over those of an earlier run. Names: table-6.1, table-6.2, figure-6.5, figure-6.6, figure-6.9, "
        "figure-6.10, figure-6.11; without names: all. Figures 6.9 to 6.11 are walked anew in physics, which "
        "takes up to a minute each. Exit code 0: every claim agrees that can; 1: one does not.",
        (
            "gaitwright reproduce",
            "gaitwright reproduce table-6.1 figure-6.6 --out here",
            "gaitwright reproduce figure-6.11 --json -     # its paths and maps as numbers",
        ),
    ),
    "studio": Command(
        "watch, drive and teach a robot in the browser",
        "Opens a page on this machine: a robot in 3-D that goes where you click, by keys or a game-pad, over "
        "obstacles that you drag; its curves, its rules and why it follows them, its map. What you teach is "
        "in the book at once, what you record in the folder. The address holds a token: who has it may "
        "watch, and one may drive. On a machine far away: `ssh -L 8737:localhost:8737 there`, then the same "
        "address. Ctrl-C closes it.",
        (
            "gaitwright studio",
            "gaitwright studio --robot go2 --scene maze --sight camera --seed 3",
            "gaitwright studio --skillbook runs/demo-001/school.skills --no-browser --port 0 --json -",
        ),
    ),
    "replay": Command(
        "a recording as one page that opens by a double click",
        "Writes a page with a recording in it: robot and ground in 3-D, plots, who drove, the rules lit, and "
        "a scrubber. It needs no server and no network, and can be sent to a colleague. Recordings are what "
        "`gaitwright mission --out DIR`, `demo` and the studio leave. Several of them, up to 20, run on one "
        "ground, each from its beginning: many starts at once.",
        (
            "gaitwright replay runs/demo-001/first/recording.npz --open",
            "gaitwright replay trip.npz --out trip.html --scene yard.json",
            "gaitwright replay runs/*/recording.npz --out all.html",
        ),
    ),
    "doctor": Command(
        "what is installed, what is missing, how to mend it",
        "Looks at Python, the packages and the folder, and names the one command that mends what is missing. "
        "Exit code 0: everything needed is there; 1: something is not.",
        ("gaitwright doctor", "gaitwright doctor --json -"),
    ),
}
