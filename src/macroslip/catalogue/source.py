# shim
from macroslip.input.files import MOST_BYTES as MOST_BYTES
from macroslip.input.files import MOST_LEVELS as MOST_LEVELS
from macroslip.input.files import MOST_NODES as MOST_NODES
from macroslip.input.files import Place as Place
from macroslip.input.files import Source as Source
from macroslip.input.files import parse as parse
from macroslip.input.files import read_text as read_text
