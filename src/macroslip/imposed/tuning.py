"""Numbers that steer the integrator, each with the reason for its value.

None is physics: every result converges to the same value as the tolerance falls, whatever they are.
"Bundled histories" are 21 cases × 2 rows of 600 s, measured by `make bench`
(docs/notes/integrator.md has the tables). Where no measurement is known the number is a judgement
and called one.
"""

from __future__ import annotations

# --- Steps ----------------------------------------------------------------------------------------

#: First step of the history and first step after entering an edge of the load zone [s]. Judgement:
#: error control corrects either within three steps.
FIRST_STEP = 1e-2
EDGE_STEP = 1e-3
#: Largest part of an orbit turned in one step [rad], so that a step has stages under different
#: directions of gravity: in a coast, steps of a tenth of an orbit keep the tolerance.
LONGEST_TURN = 0.6
#: The same of rollers that skew. What skew adds to the power of a step is evaluated where the step
#: has its stages, and jumps where a roller leaves its spar for its stop, which the error of a step
#: does not see.
LONGEST_SKEWED_TURN = 0.018
#: The same of tapered rollers. Their rib's power follows the load of the rings, whose changes the
#: error of a step does not see; a step is then about as long as the samples of load series.
LONGEST_RIBBED_TURN = 0.06
#: Most growth of a step, its least part after an error, and its part after stages that were not
#: solved; the first two as in Hairer and Wanner's RADAU5, IV.8, the third a judgement.
GROWTH = 5.0
LEAST_PART = 0.2
UNSOLVED_PART = 0.25
#: The same after a held step that was not solved: mostly the cage's load passes zero in it, where its
#: friction has a cusp that three stages at once do not solve either. Judgement.
UNSOLVED_HELD_PART = 0.5
#: Safety factor on the step that the error allows (Hairer and Wanner, IV.8: 0.8 to 0.9).
SAFETY = 0.8
#: Part of the longest step above which steps end on the cusps of light contacts. Needed for slip in
#: coasts and peaks to converge on the bundled histories: a long step across the zero of the cage
#: force hid it from the embedded estimate.
CUSP_PART = 0.03
#: Part of a step next to its ends in which a zero of a force counts as lying on the end. Judgement.
AT_END = 0.02

# --- Error ----------------------------------------------------------------------------------------

#: Part of the cage's load that tractions may make up for steps of a held roller to cross samples,
#: at which they jump with the shaft's acceleration. Judgement: a roller with weight is below it.
#: With 0.1, steps of rollers whose cage holds them against drag alone crossed jumps of power of
#: 7 %, and peaks were off by 3 %; with 0.02 still by 2.3 to 3.4 % in 9 of 9,740 random cases, of
#: which 0.01 leaves 3. It costs the bundled histories no evaluations.
INERTIA_PART = 0.01
#: Parts of the tolerance that a step may spend on slip and on energy. Slip is remembered along a
#: coast and adds up; errors of energy are of either sign and their estimate is of low order, hence
#: far too large. With these, errors on the bundled histories stay below half of the tolerance from
#: 2e-4 on.
SLIP_SHARE = 0.1
ENERGY_SHARE = 10.0
#: Part of a roller's kinetic energy at the largest raceway speed below which a step's energy need
#: not be known better. Without it, a start from standstill fails at tolerances from 1e-6 on; a
#: million steps add up to 1e-8 J at 1e-6.
NO_ENERGY = 1e-9
#: Part of a sample interval below which energy is not controlled more finely: power jumps with the
#: shaft's acceleration at every sample. Judgement.
SHORT_PART = 0.05
#: Parts of a step between the stages at which the equation's defect is evaluated, and its weight as
#: an error. With them slip in coasts and peaks converge with the tolerance on all bundled
#: histories; without, not all do.
DEFECT_NODES = (0.83, 0.4)
DEFECT_WEIGHT = 0.25
#: Part of the allowed error of slip below which, without microslip, the embedded estimate is taken
#: at its word; where the paper's grip may cease, the first look at the defect is taken all the same.
#: The bundled histories take 8 % fewer evaluations by it under the paper's laws, with the same
#: errors; without that look spin would be off by 1.6e-4 in place of 6e-5. With microslip spin in the
#: middle of coasts would be off by up to 1.1e-3 in place of 9e-5, and with 0.02 still by 1.9e-4.
UNCHECKED = 0.2
#: Weight of the way that a step's quadrature misses as an error of energy. Friction grows with
#: speed to a power of up to 1.5, and the missed way is the error itself and no bound far above it,
#: as ENERGY_SHARE supposes: five times as much.
KINK_WEIGHT = 7.5
#: Part of the cage's load at one end of a step that is left at the other where power may have a
#: cusp there; where in the step power is evaluated, and the weight of what the cubic through the
#: stages misses. For (1 - x)^0.6 to (1 - x)^0.9 times lines, the error is half to once that.
FALLEN = 0.1
CUSP_LOOK = 0.4
CUSP_WEIGHT = 1.0
#: Weight of the step over the relaxation time at its end by which an error of slip with microslip
#: counts less. Judgement.
FORGOTTEN = 1.0

# --- Stage equations ------------------------------------------------------------------------------

#: Most iterations of Newton at a step; it takes one or two.
ITERATIONS = 12
#: Part of the sum of force magnitudes that may stay unbalanced at a stage, over the tolerance of the
#: integration, and its bounds. What is left is an error of slip of the same relative size, and of
#: twice that in power: at 2e-4, errors of energy on the bundled histories are 1.4e-5 with it as with
#: 1e-9. Ten times as much would show at rollers without weight, whose cage carries the difference of
#: two tractions: their peaks were off by 7e-5.
FORCE_SHARE = 5e-3
FORCE_TOLERANCE = 1e-9
LARGEST_FORCE_TOLERANCE = 1e-6
#: The same with microslip, whose power does not depend on the balance of two large forces: half of
#: the integration's tolerance, and at most this. At 2e-4, errors of energy on the bundled histories
#: are 1e-5 with it.
MICROSLIP_FORCE_SHARE = 0.5
MICROSLIP_FORCE_TOLERANCE = 1e-4
#: Rounding of a position in a table, as part of a cell. Asked for less than rounding leaves, rollers
#: that cold oil without heating grips at 1e-17 m/s stop in steps of nanoseconds.
PLACE_ROUNDING = 5e-16
#: Safety factor on the residual predicted from the curvature of the forces in earlier steps, and
#: what is left of that curvature when a newer one is smaller. With them a held roller takes 3.7
#: evaluations a step on average, not 6.
BEND_SAFETY = 3.0
FORGET = 0.5
#: Bounds of the curvature of the paper's traction, see `macroslip.imposed.root.left_by_curvature`: by
#: heating, largest at low pressure (4.15), and by the film, both up to the part `UNHEATED` of the slip
#: at which the hottest point of a contact passes its peak, and of the ring's speed.
HEATED_CURVATURE = 5.0
FILM_CURVATURE = 0.5
UNHEATED = 0.5
#: Part of the sum of force magnitudes up to which the second of two residuals may be left to a last
#: correction without an evaluation. A larger one is no sign of convergence, however much larger the
#: first was: but for the forces the stage equations are linear in slip, so a correction removes
#: most of a residual that a poor guess made; and where the forces are at their limit on the wrong
#: side, what it leaves is twice their magnitude.
LAST_RESIDUAL = 0.5
#: Step over relaxation time from which on a held roller's step has two stages, and the part of the
#: sum of force magnitudes up to which it counts as being at its balance. Judgement: FIRM rollers at
#: the bundled 20 Hz have 50 and more.
QUASI_STATIC = 30.0
SETTLED_FORCE = 0.02
#: Most iterations of a held step; where they are not enough, the step is tried with three stages.
HELD_ITERATIONS = 4
#: Step over relaxation time from which on a roller with microslip is taken to follow its loads, for
#: a first guess. Judgement; a poor guess costs an evaluation and no accuracy.
GRIPPED = 10.0
#: Step over the one before, up to which the polynomial of that is a first guess. Judgement.
MOST_AHEAD = 3.0
#: Power of the load with which the middle of a held contact slips where stress is at its limit:
#: that of the drop of the contour at the end of the ellipse.
LIMIT_EXPONENT = 2.0 / 3.0
#: Change of ln Q below which a step does not give the exponent, and the largest exponent that is
#: accepted. Judgement.
LEAST_CHANGE = 1e-3
STEEPEST = 3.0
#: Largest change of speed in a step, as a factor, over which slip is taken to be in proportion to
#: it. Out of standstill the slip before the step is the tolerance of its balance and not in
#: proportion to speed.
MOST_QUICKENING = 5.0
#: Most iterations of the secant method of backward Euler; it is held in a bracket that halves.
SECANT_ITERATIONS = 200

# --- Roots ----------------------------------------------------------------------------------------

#: Largest relative change of slip in a step taken where traction may fall with slip, and the
#: change, as part of the raceway speed, that is always small. Skids of 0.36 m/s follow SciPy's
#: Radau with them.
HOT_CHANGE = 0.2
SMALL_CHANGE = 1e-6

# --- Load zone ------------------------------------------------------------------------------------

#: Relaxation rate of slip [1/s] from which on a roller counts as firmly held. Accelerations of a
#: shaft are far below 1 m/s² at the raceway, so what slip lags behind balance is below 1e-4 m/s
#: divided by this rate in 1e4/s.
FIRM_RATE = 1e4
#: The same with microslip, where balance is at a slip of some millimetres per second and power is
#: stationary in it.
FIRM_RATE_MICROSLIP = 1e3
#: Change of slip, as part of the raceway speed, up to which a firmly held roller counts as settled.
#: Judgement.
SETTLED = 1e-6
#: Relative change of a held roller's slip by Newton's method after which it is balanced, and most
#: iterations. Judgement: the change is quadratic in the one before, so that what is left is about its
#: square.
BALANCED = 1e-3
BALANCE_ITERATIONS = 3

# --- Peaks and records ----------------------------------------------------------------------------

#: Parts into which a step is divided to find a peak of power in it, and how many slip tolerances a
#: slip between stages must be for the power there to be meaningful. With them peaks on the bundled
#: histories are good to 0.6 % at 2e-4; ten parts find none that six do not, but where the film ends
#: in the step.
PEAK_PARTS = 6
CUSP_PARTS = 10
RESOLVED = 3.0
#: Part of its slip that a roller keeps, at most, over a step in which it snaps back. Judgement.
SNAP = 0.7
#: Power between the stages over that at the stages, by the cubic through these, above which a step is
#: sampled where a roller does not snap back. With it an eighth fewer evaluations find the same peaks;
#: without the other condition, one at a tolerance of 1e-2 is off by 13 % in place of 4 %.
HIGHER_BETWEEN = 1.001
