"""Contact of a roller with its pocket in a stage: push, friction, their derivatives, and the roller's part of the matrix."""

from __future__ import annotations

from typing import NamedTuple

from macroslip.compiled import jit_inline
from macroslip.whole_bearing.pocket import pocket_force
from macroslip.whole_bearing.space import (
    CAGE_SLIDING,
    FRICTION,
    POCKET_SPEED,
    PULL_INNER,
    PULL_OUTER,
    PUSH,
    SPIN_INNER,
    SPIN_OUTER,
)
from macroslip.whole_bearing.traction import INNER, OUTER, PULL_V, SPIN_V, cage_from


class Meeting(NamedTuple):
    """Contact of a roller with its pocket.

    Attributes
    ----------
    push, friction : float
        N and F_c [N].
    give : float
        Derivative of N by x', with the offset that follows from it in this stage [N s/m].
    by_sliding, by_push : float
        Derivatives of F_c by the slip against the cage [N s/m] and by N [-].
    arm : float
        Lever of N about the cage's own axis over the pitch radius [-].
    cage_turn : float
        Speed of the cage [rad/s].
    """

    push: float
    give: float
    by_sliding: float
    by_push: float
    friction: float
    arm: float
    cage_turn: float


@jit_inline
def meet(bearing, stage, moment, star, sheet, j):
    """Push and friction of the pocket of roller `j`; its offset follows from its speed."""
    v_in, v_out = moment.values.rollers[j, 0], moment.values.rollers[j, 1]
    cage = moment.values.cages[bearing.rollers.cage[j]]
    cosine, sine = moment.stations.cosine[j], moment.stations.sine[j]
    inner_radius, shaft_speed = bearing.rollers.inner_radius[j], stage.shaft_speed
    cage_turn = (cage[0] + 0.5 * shaft_speed * bearing.inner_radius) / bearing.pitch_radius
    off_axis = cage[4] * cosine + cage[5] * sine
    speed = 0.5 * (v_in - v_out) - cage[0] + cage[2] * sine - cage[3] * cosine + cage_turn * off_axis
    speed += 0.5 * shaft_speed * (inner_radius - bearing.inner_radius)
    offset = star.rollers[j, 2] + stage.step * speed
    moment.values.rollers[j, 2] = offset
    push, by_offset, by_speed = pocket_force(bearing.pocket, offset, speed)
    # r ω_z' = −(v_in + v_out + Ω_in r~_in)/2
    sliding = 0.5 * (v_in + v_out + shaft_speed * inner_radius) + bearing.lever * bearing.pitch_radius * cage_turn
    friction, by_sliding, by_push = cage_from(
        bearing.models.downwind.cage, bearing.films, sheet, push, sliding, stage.cage_reach
    )
    f = moment.force[j]
    f[FRICTION], f[PUSH], f[CAGE_SLIDING], f[POCKET_SPEED] = friction, push, sliding, speed
    give = by_speed + stage.step * by_offset
    return Meeting(push, give, by_sliding, by_push, friction, 1.0 - off_axis / bearing.pitch_radius, cage_turn)


@jit_inline
def write_block(inertia, stations, sheet, met, j, arrow):
    """Inverse of a roller's block, and the derivatives by which its pocket's forces follow."""
    inverse, slope = arrow.inverse[j], arrow.slope[j]
    slope[0], slope[1], slope[2] = met.give, met.by_sliding, met.by_push
    spin_in_v = sheet[INNER + SPIN_V] if stations.inner_load[j] > 0.0 else 0.0
    pull_in_v = sheet[INNER + PULL_V] if stations.inner_load[j] > 0.0 else 0.0
    spin_out_v = sheet[OUTER + SPIN_V] if stations.outer_load[j] > 0.0 else 0.0
    pull_out_v = sheet[OUTER + PULL_V] if stations.outer_load[j] > 0.0 else 0.0
    # Derivatives of 2 F_c and of N by v_in; those by v_out differ in the sign of the push's part.
    shared, tilted = met.by_sliding, met.by_push * met.give
    j11 = inertia + pull_in_v + 2.0 * spin_in_v + shared + tilted - 0.5 * met.give
    j12 = -pull_out_v + 2.0 * spin_out_v + shared - tilted + 0.5 * met.give
    j21 = -pull_in_v + 2.0 * spin_in_v + shared + tilted + 0.5 * met.give
    j22 = inertia + pull_out_v + 2.0 * spin_out_v + shared - tilted - 0.5 * met.give
    part = 1.0 / (j11 * j22 - j12 * j21)
    inverse[0], inverse[1] = j22 * part, -j12 * part
    inverse[2], inverse[3] = -j21 * part, j11 * part


@jit_inline
def add_to_border(bearing, stage, stations, met, j, arrow):
    """What a roller adds to its cage's equations, and how the cage enters its own."""
    c = bearing.rollers.cage[j]
    border, rest, row, column = arrow.border[c], arrow.border_rest[c], arrow.row[j], arrow.column[j]
    lever, by_w = bearing.lever, -met.give
    rest[0] += met.push * met.arm + met.friction * lever
    half_push, half_friction = 0.5 * met.give, 0.5 * met.by_push * met.give
    row[0, 0] = half_push * met.arm + lever * (0.5 * met.by_sliding + half_friction)
    row[1, 0] = -half_push * met.arm + lever * (0.5 * met.by_sliding - half_friction)
    friction_by_w = met.by_sliding * lever + met.by_push * by_w
    column[0, 0], column[1, 0] = 2.0 * friction_by_w - by_w, 2.0 * friction_by_w + by_w
    border[0, 0] += met.arm * by_w + lever * friction_by_w
    if bearing.translates:
        cosine, sine = stations.cosine[j], stations.sine[j]
        rest[1] -= met.push * sine
        rest[2] += met.push * cosine
        by_p = met.give * (sine + stage.step * met.cage_turn * cosine)
        by_q = met.give * (-cosine + stage.step * met.cage_turn * sine)
        row[0, 1], row[1, 1] = -sine * half_push, sine * half_push
        row[0, 2], row[1, 2] = cosine * half_push, -cosine * half_push
        column[0, 1], column[1, 1] = (2.0 * met.by_push - 1.0) * by_p, (2.0 * met.by_push + 1.0) * by_p
        column[0, 2], column[1, 2] = (2.0 * met.by_push - 1.0) * by_q, (2.0 * met.by_push + 1.0) * by_q
        by_turn = met.arm + lever * met.by_push
        border[0, 1] += by_turn * by_p
        border[0, 2] += by_turn * by_q
        for k in range(3):
            by = by_w if k == 0 else (by_p if k == 1 else by_q)
            border[1, k] -= sine * by
            border[2, k] += cosine * by


@jit_inline
def follow_roller(bearing, stage, moment, sheet, j, arrow):
    """Forces and place of roller `j` to first order after the update of speeds that `arrow` holds."""
    stations, f, slope = moment.stations, moment.force[j], arrow.slope[j]
    c = bearing.rollers.cage[j]
    cage, border = moment.values.cages[c], arrow.border_rest[c]
    v_in, v_out = -arrow.rest[j, 0], -arrow.rest[j, 1]
    if stations.inner_load[j] > 0.0:
        f[SPIN_INNER] += sheet[INNER + SPIN_V] * v_in
        f[PULL_INNER] += sheet[INNER + PULL_V] * v_in
    if stations.outer_load[j] > 0.0:
        f[SPIN_OUTER] += sheet[OUTER + SPIN_V] * v_out
        f[PULL_OUTER] += sheet[OUTER + PULL_V] * v_out
    speed = 0.5 * (v_in - v_out) + border[0]
    if bearing.translates:
        turn = stage.step * (cage[0] + 0.5 * stage.shaft_speed * bearing.inner_radius) / bearing.pitch_radius
        cosine, sine = stations.cosine[j], stations.sine[j]
        speed -= (sine + turn * cosine) * border[1] + (turn * sine - cosine) * border[2]
    sliding = 0.5 * (v_in + v_out) - bearing.lever * border[0]
    push = slope[0] * speed
    f[PUSH] += push
    f[FRICTION] += slope[1] * sliding + slope[2] * push
    f[CAGE_SLIDING] += sliding
    f[POCKET_SPEED] += speed
    moment.values.rollers[j, 2] += stage.step * speed
