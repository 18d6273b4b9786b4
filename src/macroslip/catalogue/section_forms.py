# shim
from macroslip.input.fields import *
from macroslip.input.section import *
from macroslip.input.section import form_of, word_of, keys_of, fields_of, json_schema, MappingOf, OrWord, Variants, read_all
from macroslip.input.section import Field as Field
