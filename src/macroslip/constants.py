"""Constants that several rooms share."""

#: Acceleration of free fall [m/s²].
GRAVITY = 9.81
