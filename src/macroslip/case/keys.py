# shim
from macroslip.case.case import Case as CaseFile
from macroslip.case.load_source import LoadSource as LoadsKeys
from macroslip.case.parts import INTEGRATORS
from macroslip.mechanisms import Laws as LawsKeys
