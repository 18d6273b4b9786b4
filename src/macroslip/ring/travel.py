# shim
from macroslip.ring.orbit import orbit_times, travel
