"""What a plant can be asked for, by name. Imports nothing: the command line's help reads it."""

PLANTS = {
    "mujoco": "hinges and contacts by MuJoCo",
    "armstrong": "the thesis's: ball joints held by springs, by Armstrong's recursion",
    "kinematic": "no mechanics: the robot is where its coordinator puts it",
}
"""Simulated worlds: name → what it is."""

INTEGRATORS = {
    "euler": "the thesis's, order 1, positions and velocities at once",
    "semi-implicit": "order 1, velocities first, then positions: gains less energy than euler",
    "rk4": "order 4, four evaluations a step, whose longest safe steps are little longer",
    "adaptive": "order 3, step by step as long as the accuracy allows",
}
"""How plant `armstrong` steps through time: name → what it is."""

FAULTS = {
    "motor-dead": "a motor gives no torque",
    "leg-dead": "the three motors of a leg give no torque",
    "motor-stuck": "a joint does not turn any more",
    "encoder-frozen": "a joint's sensor keeps its reading",
    "encoder-offset": "a joint's sensor reads 0.2 rad too much",
    "foot-off": "a foot's sensor feels nothing",
    "foot-on": "a foot's sensor always feels a quarter of the weight",
    "imu-frozen": "attitude and rates of the body keep their reading",
    "imu-tilted": "the attitude reads 0.2 rad too much of roll",
    "frozen": "all readings stay as they are",
    "late": "all readings come 40 ms late",
}
"""What can be made to fail on a simulated robot: kind → what it is."""

SENSORS = {
    "exact": "no noise at all",
    "go2": "as good as those of a Go2",
    "legged-gym": "as noisy as policies of legged_gym are trained with",
}
"""How good the sensors of a simulated robot are: name → what that means."""

OF_A_JOINT = ("motor-dead", "motor-stuck", "encoder-frozen", "encoder-offset")
"""Kinds that name a leg and a joint."""
OF_A_LEG = ("leg-dead", "foot-off", "foot-on")
"""Kinds that name a leg; the others name nothing."""
JOINTS = ("hip1", "hip2", "knee")
"""The joints of a leg, from the body on."""
