# shim
from macroslip.input.fields import MappingOf as MappingOf
from macroslip.input.fields import OrWord as OrWord
from macroslip.input.fields import Variants as Variants
from macroslip.input.fields import detail_of as detail_of
from macroslip.input.fields import details_inside as details_inside
from macroslip.input.section import fields_of as fields_of
from macroslip.input.fields import form_of as form_of
from macroslip.input.section import json_schema as json_schema
from macroslip.input.section import keys_of as keys_of
from macroslip.input.fields import word_of as word_of
