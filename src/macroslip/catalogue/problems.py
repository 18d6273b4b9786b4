# shim
from macroslip.input.messages import shown as shown
from macroslip.input.messages import together as together
from macroslip.input.messages import unknown_key as unknown_key
