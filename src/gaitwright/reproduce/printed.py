"""What the thesis prints in its tables 6.1 and 6.2, digit by digit."""

import numpy as np

X_6_1 = (-35.0, -34.984886, -34.969662)
"""Places of the body along x, row by row [m]; y is 0."""
Z_6_1 = -2.5
"""Its place along z, which points down [m]."""

TABLE_6_1 = np.array(
    [
        [
            [4.763295, 0.382518, -0.334318],
            [1.578295, 0.382518, -0.334318],
            [4.763295, 0.382518, -0.334318],
            [1.558295, 0.382518, -0.334318],
        ],
        [
            [4.697274, 0.382499, -0.334338],
            [1.585907, 0.382499, -0.334338],
            [4.697274, 0.382499, -0.334338],
            [1.585907, 0.382499, -0.334338],
        ],
        [
            [4.689609, 0.382476, -0.345732],
            [1.593572, 0.382476, -0.334318],
            [4.689609, 0.382476, -0.334318],
            [1.593572, 0.382476, -0.334318],
        ],
    ]
)
"""`(rows, legs 1 … 4, columns)` [rad], columns from left to right. Their heads are θ_k, θ_h, ψ, which is
the wrong way round (equations.md §6)."""

OTHER_SIDE = "2π − 1.578295, the angle of the other side, is 4.70489; rows 2 and 3 keep this symmetry"
MISPRINTS_6_1 = {
    (0, 0, 0): OTHER_SIDE,
    (0, 2, 0): OTHER_SIDE,
    (0, 3, 0): "leg 2 has 1.578295, and the two agree in every other row; one digit is wrong",
    (2, 0, 2): "the others have −0.334318; this would push the foot 1.5 mm into the ground and 34 mm inwards",
}
"""(row, leg, column) → why that entry cannot be meant."""

LEGS_6_2 = (0, 3, 1, 2)
"""The order of the legs in Table 6.2: 1, 4, 2, 3."""

TABLE_6_2 = np.array(
    [
        [
            [80.869167, 6.271701, 8.713732],
            [87.869370, 4.271897, -8.713579],
            [91.098686, 17.861366, 0.064282],
            [91.098495, 17.861319, -0.064332],
        ],
        [
            [82.699998, 5.029613, 9.655461],
            [82.698509, 5.029601, -9.655068],
            [90.629852, 17.862061, 0.063670],
            [90.631615, 17.862549, -0.061985],
        ],
        [
            [100.000000, 3.771859, 10.612420],
            [71.657433, 10.251559, -15.761279],
            [71.667000, 17.855803, 0.000000],
            [100.000007, 11.368942, -4.924666],
        ],
    ]
)
"""`(rows, legs 1, 4, 2, 3, columns)` [N·m]; columns τ_θ, τ_k, τ_ψ."""

MISREAD_6_2 = {(0, 1, 0): 80.869370, (0, 0, 1): 4.271701}
"""(row, line, column) → what it should read: one digit, as its partner's. Legs 1, 4 and 2, 3 agree to 0.002
N·m in all other entries of rows 1 and 2, and only so does row 1 carry what the others do."""

NET_TORQUE_6_2 = np.array(
    [[0.000000, 0.033646, 0.000005], [-0.000002, 0.037382, 0.000005], [-0.000004, 0.041225, 0.000005]]
)
"""Net torque on the body, row by row [N·m]."""
