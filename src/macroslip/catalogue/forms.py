# shim
from macroslip.input.fields import Choice as Choice
from macroslip.input.fields import FORM_ONLY as FORM_ONLY
from macroslip.input.fields import Flag as Flag
from macroslip.input.fields import Form as Form
from macroslip.input.fields import Text as Text
from macroslip.input.fields import Texts as Texts
from macroslip.input.fields import Whole as Whole
