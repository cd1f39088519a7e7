"""A policy of reinforcement learning, of usual size, in onnxruntime: a standalone script for its interpreter.

A perceptron 48-512-256-128-12 with ELU, as legged_gym trains them; its weights are drawn, which costs what
trained ones do. Timed is what a controller does with it: 48 numbers of the state into an array, one run on
one thread, and twelve numbers out.

    python policy_tick.py robot.urdf states.npz [--serve] [--answers out.npz]
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import onnx
import onnxruntime
from onnx import TensorProto, helper, numpy_helper
from tick_protocol import Answer, States, arguments, main, read_states, rotation

SIZES = (48, 512, 256, 128, 12)
OPSET, IR = 17, 9
STANDS = 0.25  # rad: an action of 1 moves a joint so far


def perceptron() -> bytes:
    """The network as an ONNX file."""
    rng = np.random.default_rng(0)
    nodes, numbers, last = [], [], "state"
    for k, (before, after) in enumerate(pairwise(SIZES)):
        weights = (rng.normal(size=(before, after)) / np.sqrt(before)).astype(np.float32)
        numbers.append(numpy_helper.from_array(weights, f"w{k}"))
        numbers.append(numpy_helper.from_array(np.zeros(after, np.float32), f"b{k}"))
        nodes.append(helper.make_node("Gemm", [last, f"w{k}", f"b{k}"], [f"y{k}"]))
        last = f"y{k}"
        if k < len(SIZES) - 2:
            nodes.append(helper.make_node("Elu", [last], [f"x{k}"]))
            last = f"x{k}"
    ends = [
        helper.make_tensor_value_info(name, TensorProto.FLOAT, [1, size])
        for name, size in (("state", SIZES[0]), (last, SIZES[-1]))
    ]
    graph = helper.make_graph(nodes, "policy", ends[:1], ends[1:], numbers)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", OPSET)])
    model.ir_version = IR
    onnx.checker.check_model(model)
    return model.SerializeToString()


class PolicyTick:
    """The policy on one set of states."""

    peer = "RL policy"
    note = f"a perceptron {'-'.join(map(str, SIZES))} in onnxruntime, one thread; it gives joint angles"

    def __init__(self, states: States) -> None:
        self.version = onnxruntime.__version__
        self.states = states
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = options.inter_op_num_threads = 1
        self.session = onnxruntime.InferenceSession(perceptron(), options, ["CPUExecutionProvider"])
        self.outputs = [self.session.get_outputs()[0].name]
        self.seen = np.zeros((1, SIZES[0]), np.float32)
        self.last = np.zeros(SIZES[-1], np.float32)
        self.up = np.array([rotation(quat)[2] for quat in states.quat])
        self.turned = np.array(
            [rotation(quat).T @ v for quat, v in zip(states.quat, states.velocity_w, strict=True)]
        )

    def prepare(self, state: int) -> None:
        """Not timed: nothing to set."""

    def step(self, state: int) -> bool:
        """Timed: the state into a row, the network, the angles."""
        seen, states = self.seen[0], self.states
        seen[0:3], seen[3:6] = self.turned[state], states.angular_velocity_b[state]
        seen[6:9], seen[9:12] = self.up[state], (0.4, 0.0, 0.0)
        seen[12:24] = (states.q[state] - states.posture).ravel()
        seen[24:36], seen[36:48] = states.qd[state].ravel(), self.last
        self.last = self.session.run(self.outputs, {"state": self.seen})[0][0]
        self.angles = states.posture + STANDS * self.last.reshape(-1, 3)
        return bool(np.isfinite(self.last).all())

    def answer(self) -> Answer:
        """It gives neither torques nor forces."""
        return Answer(np.zeros(self.states.posture.shape), np.zeros(self.states.posture.shape))


if __name__ == "__main__":
    options = arguments("A policy's control tick in onnxruntime, timed")
    states = read_states(options.states)
    main(PolicyTick(states), states, options)
