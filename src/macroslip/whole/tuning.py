"""Numbers that steer the integration of the whole bearing, each with the reason for its value.

None is physics: every result converges to the same value as the tolerance falls, whatever they are.
"The page's cases" are those of docs/notes/whole-bearing.md, whose tables `docs/whole_bearing.py`
makes. Where no measurement is known the number is a judgement and called one.
"""

from __future__ import annotations

# --- Steps ----------------------------------------------------------------------------------------

#: First step [s]. Judgement: error control corrects it within a few steps.
FIRST_STEP = 1e-4
#: Most growth of a step. Judgement, near Hairer and Wanner's RADAU5, IV.8.
GROWTH = 3.0
#: Least part of a step after an error. Judgement, near Hairer and Wanner's RADAU5, IV.8.
LEAST_PART = 0.2
#: Part of a step after stages that were not solved. Judgement.
UNSOLVED_PART = 0.25
#: Safety factor on the step that the error allows. Judgement (Hairer and Wanner, IV.8: 0.8 to 0.9).
SAFETY = 0.85
#: Longest step [s]. The error of a step does not see which of the rollers that no ring presses
#: carry the cage: at 0.05 s, the sample interval of the bundled loads, rows of such rollers were
#: off by up to 4 %, at a quarter of it by 0.4 %.
LONGEST_STEP = 0.0125
#: Part of the deepest indentation below which a dry impact has just begun. Judgement.
BEGUN = 0.1
#: Part of the deepest indentation in the first step of an impact. Judgement.
IMPACT_PART = 0.5

# --- Error ----------------------------------------------------------------------------------------

# Energies of the page's cases are good to 1e-3 with the next three at the default tolerance, 2e-4,
# with squeeze films and dry impacts under either set of laws.
#: Error of speed that a step may make, in tolerances of the raceway speed.
SPEED_SHARE = 5.0
#: Relative error of power where slopes predict it, in tolerances.
POWER_SHARE = 3.0
#: Force that may be left unbalanced, in tolerances [N]. A third of it takes 4 % more iterations and 5 %
#: more evaluations (14B and 24A, physical, squeeze film), and the energies are as good.
FORCE_SHARE = 3.0
#: Factor on the error of speed with dry impacts: most of it is made while spars ring after a touch,
#: where its sign is random. With it the energies above are as good for dry impacts too.
RINGING = 2.0
#: Factor on the tolerance without microslip: rollers that grip wander through their pockets, and
#: which of them touch depends on small errors. At 1/4 the rows of one random case in twenty are off
#: by 0.3 to 0.5 % at the default tolerance, with it by 0.1 %.
GRIPPED = 1.0 / 16.0
#: The same with dry impacts, whose steps are short already: `GRIPPED` would take seven times as
#: long.
GRIPPED_DRY = 1.0 / 4.0
#: Slowest raceway speed [m/s] by which errors are measured, so that a shaft at rest has a scale.
#: Judgement.
LEAST_SPEED = 1e-3
#: Time [s] in which an error of speed becomes one of position. Judgement.
PLACE_TIME = 0.02

# --- Stage equations ------------------------------------------------------------------------------

#: Newton iterations before a step counts as unsolved. Judgement.
ITERATIONS = 12
#: Tolerances by which the slopes may be off at the last evaluation, for Newton's next update is far
#: smaller. Judgement.
PREDICTED = 10.0
#: Least part of a residual that is taken to be left by the next update. Newton's iteration squares
#: it, but slopes of contacts are those of a state nearby. Judgement.
PREDICTED_RESIDUAL = 1e-3
#: Step over relaxation time from which on the slip of a raceway contact is first guessed to stay what
#: it is. Without microslip gripped contacts, at 1e6 and more, slip by nanometres per second; what
#: their rates predict across a sample of the loads, where the shaft's acceleration jumps, lies beyond
#: the peak of traction, from where Newton's method does not return: half of all samples cost a
#: cascade of shorter steps. Contacts with microslip lie below. Judgement.
GRIPPED_GUESS = 1e4
#: Part of the speed of approach to a spar from which a roller left it again in an earlier iteration,
#: at which the next approach begins. Judgement.
APPROACH_PART = 0.25

# --- Tractions between evaluations ----------------------------------------------------------------

#: Longest time between evaluations of a roller's tractions [s], the sample interval of the bundled
#: loads. Judgement.
LONGEST_INTERVAL = 0.05
#: Most factor by which the time between evaluations changes. Judgement.
INTERVAL_GROWTH = 2.0
#: Least factor by which the time between evaluations changes. Judgement.
INTERVAL_PART = 0.3
#: Safety factor on the time between evaluations. Judgement.
INTERVAL_SAFETY = 0.8
#: How many times its allowance a predicted force may be off before no slopes serve in the repeated
#: or next step. Judgement.
FAR_OFF = 30.0
#: Relative change of a raceway's load over which the time between evaluations shortens. Judgement.
LOAD_CHANGE = 0.2
#: Relative change of a raceway's load beyond which slopes no longer serve. Judgement.
LOAD_REACH = 0.25
#: Change of a raceway's force by slip over its load beyond which its slopes no longer serve, at a
#: tolerance of 2e-4. It has to be far below the coefficients of friction, where tractions bend: at
#: 0.03, through a fall of the shaft's speed within 20 ms, gripped rollers followed their slopes
#: past the bend until their next evaluation was due, and a row was off by 7 %. From 0.01 down to
#: 0.0003 it is off by 2e-4, and the bundled cases take as many evaluations. Beyond a peak of
#: traction slopes are negative, and rollers ran away by them to speeds that no ring has.
SLIP_REACH = 0.004
#: Reach of the slopes of a cage's contact at a tolerance of 2e-4; friction is then off by 1e-3 of
#: itself at most.
CAGE_REACH = 0.1
#: Force of the cage that never matters [N]. Judgement.
LIGHT = 1e-7
